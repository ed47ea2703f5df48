// Scenes made in memory whose shadows are known, and cameras that see them square on.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/frame.h"
#include "renderer/scene.h"
#include "renderer/techniques/techniques.h"
#include "renderer/view.h"

namespace stairstep::made {

/// A convex polygon, its corners in order.
inline Mesh polygon(const std::vector<glm::vec3>& corners, bool casts) {
    Mesh mesh;
    mesh.casts = casts;
    for (const glm::vec3& corner : corners) mesh.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    for (uint32_t i = 2; i < corners.size(); ++i) mesh.indices.insert(mesh.indices.end(), {0, i - 1, i});
    return mesh;
}

inline Mesh ground(float y, float half_side) {
    const float s = half_side;
    return polygon({{-s, y, -s}, {-s, y, s}, {s, y, s}, {s, y, -s}}, false);
}

inline Mesh sphere(float radius, int rings) {
    Mesh mesh;
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = std::numbers::pi * ring / rings;
        for (int i = 0; i < 2 * rings; ++i) {
            const double around = std::numbers::pi * i / rings;
            const glm::vec3 normal(std::sin(polar) * std::cos(around), std::cos(polar),
                                   std::sin(polar) * std::sin(around));
            mesh.vertices.push_back({radius * normal, normal, {0, 0}});
        }
    }
    const auto at = [&](int ring, int i) { return static_cast<uint32_t>(ring * 2 * rings + i % (2 * rings)); };
    for (int ring = 0; ring < rings; ++ring) {
        for (int i = 0; i < 2 * rings; ++i) {
            mesh.indices.insert(mesh.indices.end(), {at(ring, i), at(ring, i + 1), at(ring + 1, i), at(ring, i + 1),
                                                     at(ring + 1, i + 1), at(ring + 1, i)});
        }
    }
    return mesh;
}

/// The six sides of a box.
inline std::vector<Mesh> box(const glm::vec3& low, const glm::vec3& high) {
    std::vector<Mesh> sides;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const float at : {low[axis], high[axis]}) {
            std::vector<glm::vec3> corners(4);
            for (int i = 0; i < 4; ++i) {
                corners[i][axis] = at;
                corners[i][u] = i == 0 || i == 3 ? low[u] : high[u];
                corners[i][v] = i < 2 ? low[v] : high[v];
            }
            sides.push_back(polygon(corners, true));
        }
    }
    return sides;
}

inline Scene scene_of(std::vector<Mesh> meshes) {
    Scene scene;
    scene.meshes = std::move(meshes);
    scene.materials.emplace_back();
    return scene;
}

/// A camera that looks from `eye` against `direction`.
inline Camera camera_at(const glm::dvec3& eye, const Direction& direction, double near = 0.01, double far = 50) {
    return {basis_towards(direction), eye, 60, near, far};
}

/// Straight down from `eye`: picture right is +x, picture up is −z.
inline Camera camera_down(const glm::dvec3& eye) {
    return camera_at(eye, {0, 90});
}

/// The point at height y that a pixel's centre shows under `camera_down`.
inline glm::dvec3 point_below(const Camera& camera, int column, int row, int width, int height, double y) {
    const double pixel = pixel_footprint(camera, camera.eye.y - y, height);
    return {camera.eye.x + (column + 0.5 - width / 2.0) * pixel, y, camera.eye.z + (row + 0.5 - height / 2.0) * pixel};
}

inline std::vector<float> draw_visibility(const Scene& scene, const Camera& camera, const std::string& technique,
                                          const TechniqueSettings& settings, const ShadowMapShape& shape, int width,
                                          int height) {
    const GpuScene gpu = upload(scene);
    const FrameTarget target = make_frame_target(Show::visibility, width, height, 1);
    const ShadowRenderer renderer = make_shadow_renderer(technique_named(technique), settings, shape);
    gl::PassTimer timer;
    draw_frame(gpu, {camera, glm::dvec3(0), 1}, renderer, target, timer);
    return read_visibility(target);
}

}  // namespace stairstep::made
