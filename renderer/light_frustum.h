// What a directional light's shadow map covers, and how many texels it has.
//
// Light space: x along basis.right, y along basis.up, depth away from the light; world units. Texel space: x
// and y in texels of the map, texel (i, j) covering [i, i + 1) × [j, j + 1), and depth scaled to [0, 1).
#pragma once

#include <glm/glm.hpp>

#include "analysis/law/sizing.h"
#include "renderer/scene.h"
#include "renderer/view.h"

namespace stairstep {

/// A box in light space.
struct LightFrustum {
    /// basis.back points to the light.
    Basis basis;
    glm::dvec2 low;
    glm::dvec2 high;
    /// The casters lie strictly between; an empty texel stores `farthest`.
    double nearest = 0;
    double farthest = 1;

    glm::dvec2 extent() const { return high - low; }
};

/// The tightest box around all casters, widened sideways by `margin` (the filter's radius), so that a filter
/// that leaves the map finds no caster there: outside, everything is lit. Receivers may lie beyond its far
/// end: their depth is clamped to it, which leaves every comparison as it was, so they cost the depth no
/// precision.
LightFrustum fit_light_frustum(const Scene& scene, const Direction& light, double margin);

/// A map: what it covers, and its texels along each axis.
struct ShadowMapShape {
    LightFrustum frustum;
    int width = 1;
    int height = 1;
    /// What decided the size; fixed where a user did.
    enum class Limit { fixed, law, screen, largest_size } limit = Limit::fixed;

    /// Sides of a texel, world units.
    glm::dvec2 texel() const { return frustum.extent() / glm::dvec2(width, height); }
    size_t texel_count() const { return static_cast<size_t>(width) * height; }
};

std::string_view name(ShadowMapShape::Limit limit);

/// A map of side × side texels, whatever the frustum's proportions.
ShadowMapShape map_of_size(const LightFrustum& frustum, int side);

/// The smallest map that the law allows, each axis by its own extent. `request` gives all but the extent. The
/// frustum is widened by less than a texel so that the texel is exactly r/c (or the smallest texel) on both
/// axes: the filter's footprint is then the same number of texels, whatever the scene. Throws as
/// shadow_map_size.
ShadowMapShape map_by_law(const LightFrustum& frustum, const SizeRequest& request);

/// World space to texel space.
glm::mat4 texel_from_world(const ShadowMapShape& shape);

}  // namespace stairstep
