// Scenes made in memory whose shadows are known, and cameras that see them square on.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "renderer/scene.h"
#include "renderer/shadow_renderer.h"
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

/// A constant filter.
struct Filter {
    /// World units.
    double radius = 0.1;
    FilterMode mode = FilterMode::automatic;
    int taps = 25;
};

/// A frustum around all casters of a scene that stands still, for a camera that sees everything.
inline LightFrustum fitted(const Scene& scene, const Light& light, Fit fit = Fit::axis_aligned, double reach = 1e3) {
    SceneState state;
    state.camera = camera_at({0, 0, 1000}, {0, 0}, 0.1, 1e5);
    state.light = light;
    return fit_light_frustum(extents_of(scene), state, 1, fit, [&](const LightFrustum&) { return reach; });
}

inline LightFrustum fitted(const Scene& scene, const Direction& direction) {
    return fitted(scene, directional_light(direction, 0));
}

inline std::vector<float> draw_visibility(const Scene& scene, const SceneState& state, const std::string& technique,
                                          const ShadowSettings& settings, const ShadowMapShape& shape, int width,
                                          int height) {
    const GpuScene gpu = upload(scene);
    const FrameTarget target = make_frame_target(Show::visibility, width, height, 1);
    ShadowSettings roomy = settings;
    roomy.fixed_size = std::max(shape.width, shape.height);
    ShadowRenderer renderer(technique_named(technique), roomy, gpu, state, static_cast<double>(width) / height);
    gl::PassTimer timer;
    renderer.draw_with(shape, gpu, state, target, timer);
    return read_visibility(target);
}

inline ShadowSettings settings_of(const Filter& filter) {
    ShadowSettings settings;
    settings.technique.filter = filter.mode;
    settings.technique.filter_taps = filter.taps;
    settings.radius = filter.radius;
    return settings;
}

/// Under the directional light that the shape was made for.
inline std::vector<float> draw_visibility(const Scene& scene, const Camera& camera, const std::string& technique,
                                          const Filter& filter, const ShadowMapShape& shape, int width, int height) {
    SceneState state;
    state.camera = camera;
    state.light.basis = shape.frustum.basis;
    return draw_visibility(scene, state, technique, settings_of(filter), shape, width, height);
}

/// How sampled visibility differs from the exact one, over the pixels of the penumbra.
struct SamplingError {
    int pixels = 0;
    double mean = 0;
    double deviation = 0;
};

inline SamplingError sampling_error(const std::vector<float>& sampled, const std::vector<float>& exact) {
    SamplingError error;
    double sum = 0;
    double squares = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        if (exact[i] <= 0 || exact[i] >= 1) continue;
        const double difference = sampled[i] - exact[i];
        sum += difference;
        squares += difference * difference;
        ++error.pixels;
    }
    if (error.pixels == 0) return error;
    error.mean = sum / error.pixels;
    error.deviation = std::sqrt(squares / error.pixels);
    return error;
}

/// Visibility of the box by adding up, texel by texel, what casts no shadow: `covers` says whether the caster
/// covers a point of the light plane.
template <typename Covers>
double box_over_texels(const ShadowMapShape& shape, double radius, const glm::dvec2& p, Covers covers) {
    const glm::dvec2 texel = shape.texel();
    double dark = 0;
    for (int j = 0; j < shape.height; ++j) {
        const double y = shape.frustum.low.y + j * texel.y;
        const double height = std::min(y + texel.y, p.y + radius) - std::max(y, p.y - radius);
        if (height <= 0) continue;
        for (int i = 0; i < shape.width; ++i) {
            const double x = shape.frustum.low.x + i * texel.x;
            const double width = std::min(x + texel.x, p.x + radius) - std::max(x, p.x - radius);
            if (width > 0 && covers(glm::dvec2(x, y) + 0.5 * texel)) dark += width * height;
        }
    }
    return 1 - dark / (4 * radius * radius);
}

/// Pixels of two pictures of three channels of which some channel differs by more than a level of 255.
inline int pixels_apart(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int count = 0;
    for (size_t i = 0; i < a.size(); i += 3) {
        int most = 0;
        for (size_t channel = i; channel < i + 3; ++channel) most = std::max(most, std::abs(a[channel] - b[channel]));
        count += most > 1;
    }
    return count;
}

}  // namespace stairstep::made
