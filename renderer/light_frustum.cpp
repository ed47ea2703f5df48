#include "renderer/light_frustum.h"

#include <algorithm>

namespace stairstep {
namespace {

ShadowMapShape::Limit limit_of(SizeLimit limit) {
    switch (limit) {
        case SizeLimit::law: return ShadowMapShape::Limit::law;
        case SizeLimit::screen: return ShadowMapShape::Limit::screen;
        case SizeLimit::largest_size: return ShadowMapShape::Limit::largest_size;
    }
    return ShadowMapShape::Limit::law;
}

}  // namespace

std::string_view name(ShadowMapShape::Limit limit) {
    switch (limit) {
        case ShadowMapShape::Limit::fixed: return "fixed";
        case ShadowMapShape::Limit::law: return "law";
        case ShadowMapShape::Limit::screen: return "screen";
        case ShadowMapShape::Limit::largest_size: return "largest_size";
    }
    return "";
}

LightFrustum fit_light_frustum(const Scene& scene, const Direction& light, double margin) {
    const Basis basis = basis_towards(light);
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        for (const uint32_t index : mesh.indices) {
            const glm::dvec3 p = mesh.vertices[index].position;
            bounds.add({glm::dot(p, basis.right), glm::dot(p, basis.up), -glm::dot(p, basis.back)});
        }
    }
    // Casters stay clear of both ends, also when all lie in one plane across the light: rounding must not
    // clip the first, nor make the last as deep as an empty texel.
    const double clearance = 1e-3 * bounds.diagonal() + 1e-3 * margin;
    return {basis, glm::dvec2(bounds.low) - margin, glm::dvec2(bounds.high) + margin, bounds.low.z - clearance,
            bounds.high.z + clearance};
}

ShadowMapShape map_of_size(const LightFrustum& frustum, int side) {
    return {frustum, side, side, ShadowMapShape::Limit::fixed};
}

ShadowMapShape map_by_law(const LightFrustum& frustum, const SizeRequest& request) {
    const double texel = std::max(request.radius / request.slope, request.smallest_texel);
    ShadowMapShape shape{frustum, 1, 1, ShadowMapShape::Limit::law};
    for (const int axis : {0, 1}) {
        SizeRequest along = request;
        along.extent = frustum.extent()[axis];
        const MapSize size = shadow_map_size(along);
        (axis == 0 ? shape.width : shape.height) = size.texels;
        shape.limit = std::max(shape.limit, limit_of(size.limit));
        if (size.limit != SizeLimit::largest_size) {
            const double missing = size.texels * texel - along.extent;
            shape.frustum.low[axis] -= missing / 2;
            shape.frustum.high[axis] += missing / 2;
        }
    }
    return shape;
}

glm::mat4 texel_from_world(const ShadowMapShape& shape) {
    const auto& [right, up, back] = shape.frustum.basis;
    const glm::dvec3 scale(1 / shape.texel().x, 1 / shape.texel().y,
                           1 / (shape.frustum.farthest - shape.frustum.nearest));
    const glm::dvec3 origin(shape.frustum.low, shape.frustum.nearest);
    glm::dmat4 matrix(1);
    for (int column = 0; column < 3; ++column) {
        matrix[column] = glm::dvec4(scale * glm::dvec3(right[column], up[column], -back[column]), 0);
    }
    matrix[3] = glm::dvec4(-scale * origin, 1);
    return glm::mat4(matrix);
}

}  // namespace stairstep
