// Percentage-closer soft shadows (Fernando 2005): percentage-closer filtering whose radius is, in each pixel, the penumbra
// that the mean depth of what blocks the light there would throw.
#include <algorithm>
#include <cmath>

#include "embedded/shaders.h"
#include "renderer/map_levels.h"
#include "renderer/techniques/taps.h"

namespace stairstep {
namespace {

/// Blocker searches are this far at most, in texels of the level they are done on; with the half texel more that they look
/// at: 3 × 3 gathers.
constexpr double kSearchRadius = 2;
/// A pixel that finds nothing looks once more near by, on a level with texels a quarter as large.
constexpr int kNearerLevels = 4;
/// Depths change less over a penumbra than visibility does: texels this much larger than the filter's do for their mean.
constexpr double kEstimateTexel = 2;
/// ShadowTechnique::lighting_cost on levels: most pixels need one look.
constexpr double kLevelsCost = 7.6;

void set_softness(const gl::Program& program, const ShadowMap& map) {
    gl::set_uniform(program, "softness", glm::vec2(map.shape.frustum.softness / map.shape.texel()));
}

/// Blockers of the farthest receiver may lie at the map's near end, depth 0.
double search_reach(const LightFrustum& frustum) {
    return frustum.softness * frustum.receiver_depth;
}

class PcssSampled final : public ShadowTechnique {
  public:
    PcssSampled(FilterMode filter, const TechniqueSettings& settings)
        : filter_(filter, settings.filter_taps, "--taps"),
          search_(filter, settings.search_taps, "--search-taps"),
          slope_(settings.law_slope) {}

    bool measures_need() const override { return true; }

    std::vector<std::string_view> shader(const ShadowMap&) const override {
        return {embedded::taps_glsl, embedded::pcss_glsl};
    }

    double reach(const LightFrustum& frustum, double) const override { return search_.reach() * search_reach(frustum); }

    void bind(const gl::Program& program, const ShadowMap& map) const override {
        set_softness(program, map);
        gl::set_uniform(program, "law_slope", static_cast<float>(slope_));
        filter_.bind(program, 0);
        search_.bind(program, 1);
    }

    Lookups lookups(const ShadowMap&) const override { return {search_.count(), filter_.count(), false}; }

    double lighting_cost(const ShadowMap&) const override {
        return kUnshadowedCost + kReceiverCost + kTapCost * (search_.count() + filter_.count());
    }

  private:
    TapSet filter_;
    TapSet search_;
    double slope_;
};

class PcssLevels final : public ShadowTechnique {
  public:
    explicit PcssLevels(const TechniqueSettings& settings)
        : levels_(settings.skip_even_texels), slope_(settings.law_slope) {}

    std::vector<std::string_view> shader(const ShadowMap&) const override {
        return {embedded::ranges_glsl, embedded::box_filter_glsl, embedded::pcss_levels_glsl};
    }

    bool measures_need() const override { return true; }

    ShadowMap reserve(int capacity, DepthFormat format) const override {
        return reserve_map_with_levels(capacity, format);
    }

    double reach(const LightFrustum& frustum, double) const override { return search_reach(frustum); }

    void prepare(const ShadowMap& map) override { levels_.fill(map); }

    void bind(const gl::Program& program, const ShadowMap& map) const override {
        set_softness(program, map);
        gl::set_uniform(program, "law_slope", static_cast<float>(slope_));
        gl::set_uniform(program, "search_radius", static_cast<float>(kSearchRadius));
        gl::set_uniform(program, "nearer_levels", kNearerLevels);
        gl::set_uniform(program, "estimate_texel", static_cast<float>(kEstimateTexel));
        levels_.bind(program, map);
    }

    Lookups lookups(const ShadowMap&) const override {
        const auto gathers = [](double radius) {
            const int side = static_cast<int>(std::ceil((2 * radius + 1) / 2));
            return side * side;
        };
        // Levels are a factor of 2 apart at most. A look near by may be followed by a second estimate.
        const int search = 2 * gathers(kSearchRadius + 0.5) + 2 * gathers(2 * slope_ / kEstimateTexel + 0.5);
        return {search, gathers(2 * slope_), true};
    }

    double lighting_cost(const ShadowMap&) const override { return kLevelsCost; }

  private:
    MapLevels levels_;
    double slope_;
};

std::unique_ptr<ShadowTechnique> make_pcss(const TechniqueSettings& settings, const ShadowMap&, bool by_law) {
    FilterMode filter = settings.filter;
    if (filter == FilterMode::automatic) filter = by_law ? FilterMode::exact : FilterMode::rotated;
    if (filter == FilterMode::exact) return std::make_unique<PcssLevels>(settings);
    return std::make_unique<PcssSampled>(filter, settings);
}

}  // namespace

TechniqueEntry pcss_technique() {
    return {"pcss", "percentage-closer soft shadows of an area light", make_pcss};
}

}  // namespace stairstep
