// How many texels a shadow map has, and where they lie.
//
// Texel space: x and y in texels of the map, texel (i, j) covering [i, i + 1) × [j, j + 1), and depth scaled to [0, 1]:
// linear in depth along a directional light, in its reciprocal for a spot, and divided by w of a warp (light_warp.h), so that
// planes stay planes. A spot's map may store linear depths (depth_encoding.h); that is up to who draws and who compares.
#pragma once

#include <string_view>

#include "analysis/law/sizing.h"
#include "renderer/light_frustum.h"

namespace stairstep {

struct ShadowMapShape {
    LightFrustum frustum;
    int width = 1;
    int height = 1;
    /// What decided the size; fixed where a user did.
    enum class Limit { fixed, law, screen, largest_size } limit = Limit::fixed;

    /// Sides of a texel in the light plane; of a warped map, of its largest.
    glm::dvec2 texel() const { return frustum.extent() / glm::dvec2(width, height); }
    /// Of a warped map's smallest.
    glm::dvec2 smallest_texel() const { return frustum.warp.warps() ? texel() / frustum.warp.texel_ratio() : texel(); }
    size_t texel_count() const { return static_cast<size_t>(width) * height; }
    /// Whether both have the same texels, and store depth alike.
    bool texels_equal(const ShadowMapShape& other) const;
};

std::string_view name(ShadowMapShape::Limit limit);

/// A map of side × side texels, whatever the frustum's proportions; of one where the frustum is shadowless.
ShadowMapShape map_of_size(const LightFrustum& frustum, int side);

/// The largest number of at most 12 significant bits that is not above `texel` > 0: short enough for a texel's place, a
/// whole number of up to 2^41 texels from the origin, to be exact.
double representable_texel(double texel);

/// A map of square texels of this size whose borders are whole numbers of texels from the light's origin: as the frustum
/// moves, its texels stay where they are, and shadows don't swim. It covers the frustum with at most two texels to spare
/// along each axis; where that takes over `largest_size` texels, the texels are made larger (and limit says so). Of a warped map
/// it is the largest texel that is of this size or less, and texels don't stay where they are.
ShadowMapShape map_of_texels(const LightFrustum& frustum, double texel, int largest_size, ShadowMapShape::Limit limit);

/// The smallest map that the law allows: texels of r/c, or the smallest that is of use where that is larger, rounded down
/// to a representable one. `request` gives all but the extent. Under a warp none of the texels on what is seen may be larger:
///
///     N = ⌈c·(1 + kd)·L/r⌉,    L = d along the view and right − left (at w = 1) across it
///
/// (light_warp.h), along the view never less than without one: a filter of one radius everywhere needs as fine texels everywhere.
/// Throws as shadow_map_size.
ShadowMapShape map_by_law(const LightFrustum& frustum, const SizeRequest& request);

/// World space to texel space; homogeneous for a spot and under a warp, whose w is 1 at the near end.
glm::dmat4 texel_from_world(const ShadowMapShape& shape);

}  // namespace stairstep
