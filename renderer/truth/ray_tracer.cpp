#include "renderer/truth/ray_tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

#include "stimuli/error.h"

namespace stairstep {
namespace {

template <auto release>
struct Release {
    template <typename T>
    void operator()(T* object) const {
        release(object);
    }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>>;
using TracedScene = std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>>;

void throw_on_error(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
        throw FailureError("ray tracing", "there is not enough memory for the scene", "take a smaller one");
    }
    throw FailureError("ray tracing", "Embree fails with error " + std::to_string(error),
                       "install Embree 3 for this processor");
}

void attach(RTCDevice device, RTCScene scene, const WorldMesh& mesh, unsigned id) {
    const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    throw_on_error(device);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), mesh.triangle_count()));
    throw_on_error(device);
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    std::copy_n(mesh.indices.begin(), 3 * mesh.triangle_count(), indices);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
}

TracedScene make_scene(RTCDevice device, const std::vector<WorldMesh>& meshes, bool casters_only) {
    TracedScene scene(rtcNewScene(device));
    throw_on_error(device);
    // Without it rays slip through the edge that two triangles share.
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].triangle_count() == 0 || (casters_only && !meshes[i].casts)) continue;
        attach(device, scene.get(), meshes[i], static_cast<unsigned>(i));
    }
    rtcCommitScene(scene.get());
    throw_on_error(device);
    return scene;
}

std::optional<SurfaceHit> nearest_in(RTCScene scene, const glm::vec3& origin, const glm::vec3& direction, double near,
                                     double far) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tnear = static_cast<float>(near);
    ray.ray.tfar = static_cast<float>(far);
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return SurfaceHit{ray.hit.geomID, ray.hit.primID, ray.ray.tfar};
}

}  // namespace

void RayPacket::add(const glm::dvec3& direction) {
    assert(count < kSize);
    x[count] = static_cast<float>(direction.x);
    y[count] = static_cast<float>(direction.y);
    z[count] = static_cast<float>(direction.z);
    ++count;
}

struct RayTracer::Scenes {
    Device device;
    TracedScene all;
    /// A scene of its own, so that rays to the light don't visit what can't stop them.
    TracedScene casters;
};

RayTracer::RayTracer(const std::vector<WorldMesh>& meshes) : scenes_(std::make_unique<Scenes>()) {
    // One thread builds the same tree every time, so that of two triangles in one place the same is hit.
    scenes_->device.reset(rtcNewDevice("threads=1"));
    throw_on_error(scenes_->device.get());
    scenes_->all = make_scene(scenes_->device.get(), meshes, false);
    scenes_->casters = make_scene(scenes_->device.get(), meshes, true);
}

RayTracer::~RayTracer() = default;

std::optional<SurfaceHit> RayTracer::nearest(const glm::dvec3& origin, const glm::dvec3& direction, double near,
                                             double far) const {
    return nearest_in(scenes_->all.get(), glm::vec3(origin), glm::vec3(direction), near, far);
}

bool RayTracer::one_triangle_stops_all(const glm::dvec3& origin, const RayPacket& packet, double length) const {
    assert(packet.count > 0);
    const auto stop_of = [&](int i) {
        return nearest_in(scenes_->casters.get(), glm::vec3(origin), {packet.x[i], packet.y[i], packet.z[i]}, 0,
                          length);
    };
    const auto first = stop_of(0);
    if (!first) return false;
    for (int i = 1; i < packet.count; ++i) {
        const auto other = stop_of(i);
        if (!other || other->mesh != first->mesh || other->triangle != first->triangle) return false;
    }
    return true;
}

int RayTracer::unoccluded(const glm::dvec3& origin, const RayPacket& packet, double length) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) std::array<int, RayPacket::kSize> valid{};
    RTCRay16 rays{};
    for (int i = 0; i < packet.count; ++i) {
        valid[i] = -1;
        rays.org_x[i] = static_cast<float>(origin.x);
        rays.org_y[i] = static_cast<float>(origin.y);
        rays.org_z[i] = static_cast<float>(origin.z);
        rays.dir_x[i] = packet.x[i];
        rays.dir_y[i] = packet.y[i];
        rays.dir_z[i] = packet.z[i];
        rays.tfar[i] = static_cast<float>(length);
        rays.mask[i] = ~0u;
    }
    rtcOccluded16(valid.data(), scenes_->casters.get(), &context, &rays);
    // Embree marks an occluded ray by an end at −∞.
    constexpr float kOccluded = -std::numeric_limits<float>::infinity();
    return packet.count - static_cast<int>(std::count(rays.tfar, rays.tfar + packet.count, kOccluded));
}

}  // namespace stairstep
