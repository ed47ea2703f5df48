// What techniques over a prefiltered map have in common: how far they look, and how often.
#pragma once

#include <algorithm>

#include "renderer/techniques/technique.h"

namespace stairstep {

/// How far beyond the filter interpolation between the map's texels looks, light plane, where the map's sides are known to
/// be those of the first, or to follow the law: a texel.
inline double prefilter_margin(const TechniqueSettings& settings, const ShadowMap& first, bool by_law) {
    const glm::dvec2 texel = first.shape.texel();
    const double side = std::max(texel.x, texel.y);
    return by_law ? std::max(side, first.filter_radius / settings.law_slope) : side;
}

/// Blocks of texels are an eighth of the filter's half-width at most.
inline double prefiltered_reach(double filter_radius, double margin) {
    return filter_radius + std::max(margin, filter_radius / 8);
}

/// ShadowTechnique::lighting_cost.
inline constexpr double kPrefilteredCost = 2;

inline constexpr ShadowTechnique::Lookups kPrefilteredLookups{.search = 0, .filter = 1, .prefiltered = true};

}  // namespace stairstep
