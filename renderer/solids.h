// Solids: parts of a mesh whose triangles close a volume and face outwards.
//
// Seen from outside all solids, the nearest surface is never a back face of theirs: a ray enters a solid before it leaves it. So
// their back faces needn't be drawn, by a camera or by a light, and no picture or shadow map changes.
//
// Triangles belong together where they have a corner in common, by its place (to within roundings) and not by its index, as smooth
// and textured meshes have several vertices in a place. A part is a solid if each of its edges is gone along as often one way as
// the other, and the volume that it encloses is positive. Not found, and drawn whole, is what meets other triangles in the middle
// of an edge. Not checked is that the volume is positive everywhere: a part that goes through itself and turns inside out is
// taken for one.
#pragma once

#include <span>
#include <vector>

#include "renderer/facet_vertices.h"

namespace stairstep {

struct Solids {
    /// Of each triangle, whether it is a solid's.
    std::vector<bool> has_triangle;
    /// Around each solid.
    std::vector<Bounds> bounds;
};

/// A box of 12 outward triangles is one; the same without its lid, or turned inside out, isn't.
Solids find_solids(const FacetMesh& mesh);

/// Whether a solid may hold some of the hull of these points, which are in the mesh's space. With slack for rounding.
bool may_hold(std::span<const Bounds> solids, std::span<const glm::dvec3> points);

}  // namespace stairstep
