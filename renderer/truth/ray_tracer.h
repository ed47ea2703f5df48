// Rays through triangles, by Embree. Nothing of Embree leaves ray_tracer.cpp.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/truth/world_mesh.h"

namespace stairstep {

/// Where a ray meets a surface first.
struct SurfaceHit {
    /// Index into the meshes.
    size_t mesh = 0;
    /// Of that mesh.
    size_t triangle = 0;
    /// In lengths of the ray's direction.
    double distance = 0;
};

/// Directions of rays that are traced together: quickest when they are close to one another.
struct RayPacket {
    static constexpr int kSize = 16;

    /// How many of them there are; the rest is ignored.
    int count = 0;
    alignas(64) std::array<float, kSize> x{};
    alignas(64) std::array<float, kSize> y{};
    alignas(64) std::array<float, kSize> z{};

    void add(const glm::dvec3& direction);
};

/// Made once for a scene at a moment, asked by any number of threads at once.
class RayTracer {
  public:
    /// Throws FailureError where Embree or the memory fails. The meshes are copied.
    explicit RayTracer(const std::vector<WorldMesh>& meshes);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// The first triangle of any mesh at origin + t·direction for t in [near, far]; none has an area of zero.
    std::optional<SurfaceHit> nearest(const glm::dvec3& origin, const glm::dvec3& direction, double near,
                                      double far) const;

    /// How many of the packet's rays meet no mesh that casts at origin + t·direction for t in [0, length]; length may be
    /// infinite.
    int unoccluded(const glm::dvec3& origin, const RayPacket& packet, double length) const;

    /// Whether all of the packet's rays, at least one, meet the same triangle of a mesh that casts before any other. It then
    /// stops every ray between them, too, as a triangle is convex. False is no promise.
    bool one_triangle_stops_all(const glm::dvec3& origin, const RayPacket& packet, double length) const;

  private:
    struct Scenes;
    std::unique_ptr<Scenes> scenes_;
};

}  // namespace stairstep
