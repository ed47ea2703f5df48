#include "renderer/imported_views.h"

#include <assimp/commonMetaData.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace stairstep {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
/// The widest cone that a spot has.
constexpr double kWidestCone_deg = 85;
/// Beyond this squares wouldn't be finite in float.
constexpr double kLargestCoordinate = 1e12;

glm::dvec3 vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

/// Written so that NaN fails.
bool usable(const glm::dvec3& v) {
    return glm::all(glm::lessThanEqual(glm::abs(v), glm::dvec3(kLargestCoordinate)));
}

/// A direction of length 1; nullopt for none.
std::optional<glm::dvec3> unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!usable(v) || !(length > 1e-12)) return std::nullopt;
    return v / length;
}

/// A transform of Assimp's, which has rows, in double precision.
struct Placement {
    glm::dmat3 linear{1};
    glm::dvec3 origin{0};

    glm::dvec3 point(const aiVector3D& v) const { return linear * vector_of(v) + origin; }
    glm::dvec3 direction(const aiVector3D& v) const { return linear * vector_of(v); }
    /// The factor that lengths grow by, the geometric mean over directions.
    double scale() const { return std::cbrt(std::abs(glm::determinant(linear))); }
};

Placement of(const aiMatrix4x4& m) {
    return {glm::dmat3(m.a1, m.b1, m.c1, m.a2, m.b2, m.c2, m.a3, m.b3, m.c3), {m.a4, m.b4, m.c4}};
}

/// Where the node of this name is; as the world where there is none.
Placement placement_of(const aiScene& source, const aiString& name) {
    Placement placement;
    const aiNode* node = source.mRootNode ? source.mRootNode->FindNode(name) : nullptr;
    for (; node; node = node->mParent) {
        const Placement parent = of(node->mTransformation);
        placement.origin = parent.linear * placement.origin + parent.origin;
        placement.linear = parent.linear * placement.linear;
    }
    return placement;
}

/// The basis that looks against `back`, upright along `up` where that isn't parallel.
Basis basis_from(const glm::dvec3& back, const glm::dvec3& up) {
    const std::optional<glm::dvec3> right = unit(glm::cross(unit(up).value_or(back), back));
    return right ? Basis{*right, glm::cross(back, *right), back} : basis_towards(direction_of(back));
}

std::string quoted(const std::string& kind, const aiString& name) {
    return kind + " \"" + name.C_Str() + "\" ";
}

/// Assimp 5.2 keeps two things of glTF differently: a spot's angles are from its axis, not across, and a camera's
/// position repeats its node's translation, where glTF has it at the node's origin.
bool comes_from_gltf(const aiScene& source) {
    aiString format;
    return source.mMetaData && source.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format) &&
           std::string(format.C_Str()).starts_with("glTF");
}

/// The camera, or a text that says what is wrong with it.
std::optional<Camera> camera_of(const aiCamera& source, const Placement& place, const Bounds& bounds, bool is_gltf,
                                std::string& problem) {
    if (source.mOrthographicWidth != 0) {
        problem = "is orthographic";
        return std::nullopt;
    }
    const std::optional<glm::dvec3> ahead = unit(place.direction(source.mLookAt));
    const glm::dvec3 eye = place.point(is_gltf ? aiVector3D() : source.mPosition);
    if (!ahead || !usable(eye)) {
        problem = "has no place or direction";
        return std::nullopt;
    }
    const double aspect = source.mAspect > 0 && std::isfinite(source.mAspect) ? source.mAspect : 1;
    const double half_tangent = std::tan(source.mHorizontalFOV / 2.0) / aspect;
    const double vertical_fov_deg = 2 * std::atan(half_tangent) * kDegrees;
    if (!(source.mHorizontalFOV > 0 && source.mHorizontalFOV < std::numbers::pi && vertical_fov_deg > 0.01 &&
          vertical_fov_deg < 179)) {
        problem = "has an impossible field of view";
        return std::nullopt;
    }
    Camera camera;
    camera.eye = eye;
    camera.basis = basis_from(-*ahead, place.direction(source.mUp));
    camera.vertical_fov_deg = vertical_fov_deg;
    const double scale = place.scale();
    camera.near = source.mClipPlaneNear * scale;
    camera.far = source.mClipPlaneFar * scale;
    if (!(camera.far > 0 && camera.far < kLargestCoordinate && camera.far > camera.near)) {
        // All of the model, and as much again.
        double reach = 0;
        for (int i = 0; i < 8; ++i) reach = std::max(reach, glm::length(bounds.corner(i) - eye));
        camera.far = 2 * reach;
    }
    if (!(camera.near > 0 && camera.near < camera.far)) camera.near = camera.far * 1e-4;
    return camera;
}

/// A cone in [1°, 85°] of this half-angle; 85° where it is none.
double cone_of(double half_angle_deg) {
    return half_angle_deg > 0 ? std::clamp(half_angle_deg, 1.0, kWidestCone_deg) : kWidestCone_deg;
}

/// The narrowest cone around the direction to the bounds' middle that holds all of them.
double cone_around(const Bounds& bounds, const glm::dvec3& position) {
    const glm::dvec3 axis = glm::normalize(bounds.centre() - position);
    double cosine = 1;
    for (int i = 0; i < 8; ++i) {
        const std::optional<glm::dvec3> corner = unit(bounds.corner(i) - position);
        cosine = std::min(cosine, corner ? glm::dot(axis, *corner) : -1.0);
    }
    return cone_of(std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees + 1);
}

struct LightContext {
    const Bounds& bounds;
    /// Whether a spot's angle is from its axis, not across.
    bool half_angles;
};

/// The light, or a text that says what is wrong with it.
std::optional<Light> light_of(const aiLight& source, const Placement& place, const LightContext& context,
                              std::string& problem) {
    const bool placed = source.mType != aiLightSource_DIRECTIONAL;
    const bool directed = source.mType != aiLightSource_POINT;
    Light light;
    light.kind = placed ? Light::Kind::spot : Light::Kind::directional;
    light.position = placed ? place.point(source.mPosition) : glm::dvec3(0);
    const std::optional<glm::dvec3> ahead =
        unit(directed ? place.direction(source.mDirection) : context.bounds.centre() - light.position);
    if (!ahead || !usable(light.position)) {
        problem = directed ? "has no place or direction" : "has no place, or is in the model's middle";
        return std::nullopt;
    }
    light.basis = basis_from(-*ahead, directed ? place.direction(source.mUp) : glm::dvec3(0, 1, 0));
    if (source.mType == aiLightSource_SPOT) {
        light.cone_deg = cone_of(source.mAngleOuterCone * kDegrees / (context.half_angles ? 1 : 2));
    } else if (source.mType == aiLightSource_POINT) {
        light.cone_deg = cone_around(context.bounds, light.position);
    } else if (source.mType == aiLightSource_AREA) {
        light.cone_deg = kWidestCone_deg;
        const double side = std::sqrt(static_cast<double>(source.mSize.x) * source.mSize.y) * place.scale();
        if (!(side >= 0 && side < kLargestCoordinate)) {
            problem = "has an impossible size";
            return std::nullopt;
        }
        light.half_side = side / 2;
    }
    return light;
}

}  // namespace

std::vector<Camera> imported_cameras(const aiScene& source, const Bounds& bounds, std::vector<std::string>& warnings) {
    const bool is_gltf = comes_from_gltf(source);
    std::vector<Camera> cameras;
    for (unsigned i = 0; i < source.mNumCameras; ++i) {
        const aiCamera& camera = *source.mCameras[i];
        std::string problem;
        if (const auto made = camera_of(camera, placement_of(source, camera.mName), bounds, is_gltf, problem)) {
            cameras.push_back(*made);
        } else {
            warnings.push_back(quoted("camera", camera.mName) + problem + ", so it is left out");
        }
    }
    return cameras;
}

std::vector<Light> imported_lights(const aiScene& source, const Bounds& bounds, std::vector<std::string>& warnings) {
    const bool is_gltf = comes_from_gltf(source);
    std::vector<Light> lights;
    for (unsigned i = 0; i < source.mNumLights; ++i) {
        const aiLight& light = *source.mLights[i];
        if (light.mType == aiLightSource_AMBIENT || light.mType == aiLightSource_UNDEFINED) {
            warnings.push_back(quoted("light", light.mName) + "comes from nowhere, so it is left out");
            continue;
        }
        std::string problem;
        const auto made = light_of(light, placement_of(source, light.mName), {bounds, is_gltf}, problem);
        if (!made) {
            warnings.push_back(quoted("light", light.mName) + problem + ", so it is left out");
            continue;
        }
        lights.push_back(*made);
        if (light.mType == aiLightSource_POINT) {
            warnings.push_back(quoted("light", light.mName) +
                               "shines all around; it becomes a spot towards the model's middle");
        }
    }
    return lights;
}

}  // namespace stairstep
