// Triangles whose last vertex tells the facet: what a shader reads as a flat input is the same over a whole triangle.
//
// Interpolated normals would tilt a receiver's plane out of its surface, and derivatives of interpolated positions are off by
// some 1e-4: enough for acne over a filter of 70 texels. So each triangle's own plane is computed once, and rides on the vertex
// that OpenGL takes flat inputs from, its last. A triangle is turned until a vertex that is free, or has that very plane already,
// comes last; only where there is none a vertex is doubled: boxes need no more vertices, smooth meshes up to twice as many.
#pragma once

#include <span>
#include <vector>

#include "renderer/scene.h"

namespace stairstep {

struct FacetVertex {
    Vertex vertex;
    /// Unit normal of the triangles that this vertex ends, counter-clockwise seen from its tip; 0 where they have no area.
    glm::vec3 facet{0};
};

struct FacetMesh {
    std::vector<FacetVertex> vertices;
    /// Three a triangle; triangles in the mesh's order, each with its own winding, but those that aren't finite (scene.h).
    std::vector<uint32_t> indices;
};

FacetMesh facet_mesh(const Mesh& mesh);

}  // namespace stairstep
