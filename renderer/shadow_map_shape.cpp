#include "renderer/shadow_map_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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

ShadowMapShape map_of_size(const LightFrustum& frustum, int side) {
    // A map without shadows is empty at any size.
    if (frustum.shadowless) side = 1;
    return {frustum, side, side, ShadowMapShape::Limit::fixed};
}

double representable_texel(double texel) {
    assert(texel > 0);
    int exponent = 0;
    const double mantissa = std::frexp(texel, &exponent);
    return std::ldexp(std::floor(std::ldexp(mantissa, 12)), exponent - 12);
}

ShadowMapShape map_of_texels(const LightFrustum& frustum, double texel, int largest_size, ShadowMapShape::Limit limit) {
    const double longest = std::max(frustum.extent().x, frustum.extent().y);
    // Two texels may be lost to whole borders; a map of one or two can't spare them.
    const double largest_extent = texel * std::max(largest_size - 2, 1);
    if (longest > largest_extent) {
        // Some bits to spare for rounding down.
        texel = representable_texel(longest / std::max(largest_size - 2, 1) * (1 + 0x1p-10));
        limit = ShadowMapShape::Limit::largest_size;
    }
    ShadowMapShape shape{frustum, 1, 1, limit};
    if (frustum.warp.warps()) {
        const glm::dvec2 count = glm::ceil(frustum.extent() / texel);
        shape.width = static_cast<int>(std::clamp(count.x, 1.0, static_cast<double>(largest_size)));
        shape.height = static_cast<int>(std::clamp(count.y, 1.0, static_cast<double>(largest_size)));
        return shape;
    }
    for (const int axis : {0, 1}) {
        const double first = std::floor(frustum.low[axis] / texel);
        const double last = std::ceil(frustum.high[axis] / texel);
        const double count = std::clamp(last - first, 1.0, static_cast<double>(largest_size));
        (axis == 0 ? shape.width : shape.height) = static_cast<int>(count);
        shape.frustum.low[axis] = first * texel;
        shape.frustum.high[axis] = (first + count) * texel;
    }
    return shape;
}

ShadowMapShape map_by_law(const LightFrustum& frustum, const SizeRequest& request) {
    SizeRequest along = request;
    along.extent = std::max(frustum.extent().x, frustum.extent().y);
    const MapSize size = shadow_map_size(along);
    const double texel = std::max(request.radius / request.slope, request.smallest_texel);
    return map_of_texels(frustum, representable_texel(std::max(texel, along.extent * 1e-12)), request.largest_size,
                         limit_of(size.limit));
}

bool ShadowMapShape::texels_equal(const ShadowMapShape& other) const {
    const LightFrustum& a = frustum;
    const LightFrustum& b = other.frustum;
    return width == other.width && height == other.height && a.kind == b.kind && a.position == b.position &&
           a.basis.right == b.basis.right && a.basis.up == b.basis.up && a.basis.back == b.basis.back &&
           a.low == b.low && a.high == b.high && a.nearest == b.nearest && a.farthest == b.farthest && a.encoding == b.encoding && a.warp == b.warp;
}

glm::dmat4 texel_from_world(const ShadowMapShape& shape) {
    const LightFrustum& frustum = shape.frustum;
    const auto& [right, up, back] = frustum.basis;
    const glm::dvec2 scale = 1.0 / shape.texel();
    const double near = frustum.nearest;
    const double far = frustum.farthest;
    // Rows: what becomes of world x, y, z and 1.
    glm::dvec4 x;
    glm::dvec4 y;
    glm::dvec4 depth;
    glm::dvec4 w(0, 0, 0, 1);
    const auto along = [&](const glm::dvec3& axis, double offset) {
        return glm::dvec4(axis, -glm::dot(axis, frustum.position) + offset);
    };
    if (const LightWarp& warp = frustum.warp; warp.warps()) {
        const glm::dvec4 from_first = along(up, -warp.first);
        w += warp.curvature * from_first;
        x = shape.width / (warp.right - warp.left) * (along(right, -warp.middle) - warp.left * w);
        y = shape.height * (1 / warp.length + warp.curvature) * from_first;
        depth = along(-back, -near) / (far - near);
    } else if (frustum.kind == Light::Kind::directional) {
        x = scale.x * along(right, -frustum.low.x);
        y = scale.y * along(up, -frustum.low.y);
        depth = along(-back, -near) / (far - near);
    } else {
        w = along(-back, 0);
        x = scale.x * (along(right, 0) - frustum.low.x * w);
        y = scale.y * (along(up, 0) - frustum.low.y * w);
        depth = (far * w - glm::dvec4(0, 0, 0, far * near)) / (far - near);
    }
    return glm::transpose(glm::dmat4(x, y, depth, w));
}

}  // namespace stairstep
