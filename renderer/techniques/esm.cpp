// Exponential shadow maps (Annen et al. 2008): the step that asks whether a caster's height is above the receiver's becomes
// an exponential, whose mean over the filter separates.
//
//     V = 1 − a + a·min(1, exp(k h)·E)     E: mean of exp(−k h') over the casters
//
// a is the filter's share that holds casters, h' their heights above the map's far end, h the receiver's. A single caster d
// above the receiver leaks exp(−k d). The larger k the less, but the more, too, a lit surface that slopes makes up for its own
// shadow: its lower parts count by exp(k·their depth below h).
#include <algorithm>
#include <cmath>

#include "embedded/shaders.h"
#include "renderer/prefiltered_map.h"
#include "renderer/techniques/prefiltered.h"

namespace stairstep {
namespace {

/// Over the map's whole depth: exp(−80) is 2e-35, a hundred times the least normal float times the filter's least share.
constexpr double kLargestExponent = 80;
/// k times the filter's half-width, in world units along the light: a caster a half-width above the receiver leaks
/// exp(−1) = 0.37, one three of them above 0.05. Of crane, clutter and colonnade, less leaks several times as much and more
/// has no lower error.
constexpr double kExponentTimesRadius = 1;

/// k for heights in [0, 1]: kExponentTimesRadius a filter's half-width, for a spot at the map's far end, where stored depth
/// changes least.
double exponent_of(const ShadowMap& map) {
    const LightFrustum& frustum = map.shape.frustum;
    double depth_per_height = frustum.farthest - frustum.nearest;
    double radius = map.filter_radius;
    if (frustum.kind == Light::Kind::spot) {
        depth_per_height *= frustum.farthest / frustum.nearest;
        radius *= frustum.farthest;
    }
    return std::min(kExponentTimesRadius * depth_per_height / std::max(radius, 1e-9 * depth_per_height),
                    kLargestExponent);
}

class Esm final : public ShadowTechnique {
  public:
    explicit Esm(double margin) : margin_(margin) {}

    std::vector<std::string_view> shader(const ShadowMap&) const override {
        return {embedded::prefiltered_glsl, embedded::esm_glsl};
    }

    double reach(const LightFrustum&, double filter_radius) const override {
        return prefiltered_reach(filter_radius, margin_);
    }

    void prepare(const ShadowMap& map) override {
        gl::set_uniform(means_.program(), "exponent", static_cast<float>(exponent_of(map)));
        means_.fill(map);
    }

    void bind(const gl::Program& program, const ShadowMap& map) const override {
        gl::set_uniform(program, "exponent", static_cast<float>(exponent_of(map)));
        means_.bind(program);
    }

    Lookups lookups(const ShadowMap&) const override { return kPrefilteredLookups; }
    double lighting_cost(const ShadowMap&) const override { return kPrefilteredCost; }

  private:
    double margin_;
    PrefilteredMap means_{"esm", embedded::esm_texels_glsl, GL_RG32F};
};

std::unique_ptr<ShadowTechnique> make_esm(const TechniqueSettings& settings, const ShadowMap& first, bool by_law) {
    return std::make_unique<Esm>(prefilter_margin(settings, first, by_law));
}

}  // namespace

TechniqueEntry esm_technique() {
    return {"esm", "exponential shadow maps, prefiltered with a constant radius", make_esm};
}

}  // namespace stairstep
