// A scene as a plain value: triangles, what they are made of, and nothing of OpenGL. Triangles that never move are in
// world space; those that do are in the space of their mover (scene_state.h).
//
// World space is right-handed with y up; its unit is whatever the model's author chose. Colours are linear.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stimuli/io/image_file.h"

namespace stairstep {

struct Vertex {
    glm::vec3 position{0};
    /// Unit length.
    glm::vec3 normal{0, 1, 0};
    /// (0, 0) is the corner of the texture's first pixel, v runs down.
    glm::vec2 uv{0};
};

struct Material {
    /// Linear, [0, 1] a channel; multiplies the texture's colour.
    glm::vec3 base_colour{0.8f};
    /// Index into Scene::textures.
    std::optional<size_t> texture;
};

struct Mesh {
    std::vector<Vertex> vertices;
    /// Three a triangle, each below vertices.size().
    std::vector<uint32_t> indices;
    /// Index into Scene::materials.
    size_t material = 0;
    /// Whether it throws shadows. All meshes receive them.
    bool casts = true;
    /// Index into SceneState::movers for a mesh that moves; others stand where their vertices are.
    std::optional<size_t> mover;
    /// Whether it fades into the background far from the scene's middle, as a ground without an end does.
    bool fades = false;
};

struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    /// sRGB-encoded, 1 or 3 channels.
    std::vector<Image> textures;
};

/// An axis-aligned box; empty (low > high) until it holds a point.
struct Bounds {
    glm::dvec3 low{INFINITY};
    glm::dvec3 high{-INFINITY};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool empty() const { return low.x > high.x; }
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double diagonal() const { return glm::length(high - low); }
    /// Corner i in 0 … 7.
    glm::dvec3 corner(int i) const { return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; }
};

/// Whether the corners of the triangle that begins at this index are finite. One with a corner that isn't has no place: it is
/// not drawn and casts nothing.
bool is_finite_triangle(const Mesh& mesh, size_t first_index);

/// Bounds of all that casts shadows.
Bounds caster_bounds(const Scene& scene);

/// Triangles of all meshes.
size_t triangle_count(const Scene& scene);

/// Adds a horizontal square at the casters' lowest point, `reach` diagonals of their bounds to each side. It
/// receives shadows, casts none and fades.
void add_ground(Scene& scene, double reach);

}  // namespace stairstep
