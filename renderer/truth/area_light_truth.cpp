#include "renderer/truth/area_light_truth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/truth/caster_tree.h"
#include "renderer/truth/ray_tracer.h"
#include "stimuli/parallel.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// Rays of a packet go to neighbouring cells of the square.
constexpr int kBlock = 4;
static_assert(kBlock * kBlock == RayPacket::kSize);

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// A point of a surface and its facet's normal, which faces the viewer; zero for a triangle without one.
struct SurfacePoint {
    glm::dvec3 position;
    glm::dvec3 normal;
};

/// The rays through pixels' centres, 1 along the view a unit.
struct PixelRays {
    Camera camera;
    int width;
    int height;

    glm::dvec3 direction(int column, int row) const {
        const double up = std::tan(radians(camera.vertical_fov_deg) / 2);
        const double right = up * width / height;
        const double x = (column + 0.5) / width * 2 - 1;
        const double y = 1 - (row + 0.5) / height * 2;
        return x * right * camera.basis.right + y * up * camera.basis.up - camera.basis.back;
    }
};

/// Embree finds the triangle, in floats; where the ray meets its plane is worked out in doubles.
SurfacePoint surface_point(const WorldMesh& mesh, const SurfaceHit& hit, const Camera& camera,
                           const glm::dvec3& direction) {
    const auto [a, b, c] = mesh.triangle(hit.triangle);
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double length = glm::length(across);
    const glm::dvec3 normal = length > 0 ? across / length : glm::dvec3(0);
    const double facing = glm::dot(normal, direction);
    const double met = facing != 0 ? glm::dot(normal, a - camera.eye) / facing : hit.distance;
    const double distance = std::clamp(met, camera.near, camera.far);
    return {camera.eye + distance * direction, facing > 0 ? -normal : normal};
}

/// How far a ray starts above its surface, world units: beyond what float coordinates of this size are off by when a ray is
/// put against triangles among them, some 10 units in the last place.
double ray_offset(const glm::dvec3& point, double largest_coordinate) {
    const glm::dvec3 size = glm::abs(point);
    return std::ldexp(std::max({size.x, size.y, size.z, largest_coordinate}), -19);
}

class AreaLight {
  public:
    AreaLight(const Light& light, const RayTracer& tracer, const CasterTree& casters, int samples)
        : light_(light),
          tracer_(tracer),
          casters_(casters),
          // All rays to a point are one.
          side_(light.half_side > 0 ? static_cast<int>(std::lround(std::sqrt(samples))) : 1),
          least_cosine_(std::cos(radians(light.cone_deg))),
          length_(light.kind == Light::Kind::spot ? 1 : std::numeric_limits<double>::infinity()) {}

    float visibility(const SurfacePoint& point, Random random) const {
        if (!reaches(point)) return 0;
        const double offset = ray_offset(point.position, casters_.largest_coordinate());
        // The ray starts at `offset`: triangles up to half of it can't be met.
        if (!casters_.may_hide_light(point.position, point.normal, offset)) return 1;
        const glm::dvec3 origin = point.position + offset * point.normal;
        RayPacket corners;
        for (const double u : {-1, 1}) {
            for (const double v : {-1, 1}) corners.add(way_to(u, v, origin));
        }
        if (tracer_.one_triangle_stops_all(origin, corners, length_)) return 0;
        int seen = 0;
        for (int row = 0; row < side_; row += kBlock) {
            for (int column = 0; column < side_; column += kBlock) seen += seen_in_block(origin, column, row, random);
        }
        return static_cast<float>(seen) / static_cast<float>(side_ * side_);
    }

  private:
    /// Whether the light's middle shines on the facet, and within the cone.
    bool reaches(const SurfacePoint& point) const {
        if (light_.kind == Light::Kind::directional) return glm::dot(point.normal, light_.basis.back) > 0;
        const glm::dvec3 to_light = light_.position - point.position;
        return glm::dot(point.normal, to_light) > 0 &&
               glm::dot(light_.basis.back, to_light) >= least_cosine_ * glm::length(to_light);
    }

    int seen_in_block(const glm::dvec3& origin, int first_column, int first_row, Random& random) const {
        RayPacket packet;
        for (int row = first_row; row < std::min(first_row + kBlock, side_); ++row) {
            for (int column = first_column; column < std::min(first_column + kBlock, side_); ++column) {
                // 32 bits each, of one draw.
                const uint64_t bits = random.bits();
                const double u = (column + static_cast<double>(bits >> 32) * 0x1p-32) / side_ * 2 - 1;
                const double v = (row + static_cast<double>(bits & 0xffffffff) * 0x1p-32) / side_ * 2 - 1;
                packet.add(way_to(u, v, origin));
            }
        }
        return tracer_.unoccluded(origin, packet, length_);
    }

    /// The way to a point of the square, u and v in [−1, 1].
    glm::dvec3 way_to(double u, double v, const glm::dvec3& origin) const {
        const glm::dvec3 across = u * light_.half_side * light_.basis.right + v * light_.half_side * light_.basis.up;
        return light_.kind == Light::Kind::spot ? light_.position + across - origin
                                                : light_.basis.back + across / light_.distance;
    }

    Light light_;
    const RayTracer& tracer_;
    const CasterTree& casters_;
    int side_;
    double least_cosine_;
    /// Of a ray to the light, in ways.
    double length_;
};

[[maybe_unused]] bool is_square(int number) {
    const auto root = static_cast<int>(std::lround(std::sqrt(number)));
    return root >= 1 && root * root == number;
}

}  // namespace

std::vector<float> area_light_visibility(const Scene& scene, const SceneState& state, int width, int height,
                                         int samples, int jobs) {
    assert(width >= 1 && height >= 1 && is_square(samples));
    const std::vector<WorldMesh> meshes = world_meshes(scene, state);
    const RayTracer tracer(meshes);
    const CasterTree casters(meshes, state.light);
    const AreaLight light(state.light, tracer, casters, samples);
    const PixelRays rays{state.camera, width, height};
    const Random random(1);
    std::vector<float> visibility(static_cast<size_t>(width) * height, 1);
    run_in_parallel(height, jobs, [&](size_t row) {
        for (int column = 0; column < width; ++column) {
            const glm::dvec3 direction = rays.direction(column, static_cast<int>(row));
            const auto hit = tracer.nearest(state.camera.eye, direction, state.camera.near, state.camera.far);
            if (!hit) continue;
            const size_t pixel = row * width + column;
            visibility[pixel] =
                light.visibility(surface_point(meshes[hit->mesh], *hit, state.camera, direction), random.stream(pixel));
        }
    });
    return visibility;
}

}  // namespace stairstep
