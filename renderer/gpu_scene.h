// A scene on the GPU: all meshes in one vertex and one index buffer, and a list of what to draw from them.
#pragma once

#include <vector>

#include "renderer/clusters.h"
#include "renderer/gl/objects.h"
#include "renderer/scene_extents.h"
#include "renderer/scene_state.h"
#include "renderer/solids.h"

namespace stairstep {

struct GpuScene {
    /// Different for each upload: tells whether what was made of a scene was made of this one.
    uint64_t serial = 0;
    struct Draw {
        size_t first_index = 0;
        std::vector<Cluster> clusters;
        /// Boxes around the solids that its triangles are of, model space; of none, if they don't all belong to one.
        std::vector<Bounds> solids;
        Material material;
        bool casts = true;
        bool fades = false;
        /// As Mesh::mover.
        std::optional<size_t> mover;
    };

    gl::Buffer vertices;
    gl::Buffer indices;
    /// Attributes 0 position, 1 normal, 2 uv, 3 facet (facet_vertices.h).
    gl::VertexArray vertex_array;
    /// As Scene::textures; sRGB with mipmaps.
    std::vector<gl::Texture> textures;
    std::vector<Draw> draws;
    SceneExtents extents;
    /// Of the casters as they stand in the model, world units: where a ground without an end fades.
    glm::dvec3 middle{0};
    double diagonal = 1;
};

/// Where a draw's vertices are now.
glm::dmat4 world_from_model(const GpuScene::Draw& draw, const SceneState& state);

/// Copies the scene to the GPU; an empty one draws nothing. Throws FailureError.
GpuScene upload(const Scene& scene);

}  // namespace stairstep
