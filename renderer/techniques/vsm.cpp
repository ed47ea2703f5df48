// Variance shadow maps (Donnelly & Lauritzen 2006): mean and variance of the casters' depths over the filter bound, by
// Chebyshev's inequality, the share of them that leaves a receiver lit.
//
//     V = 1 − a + a·σ²/(σ² + (μ − h)²)     where μ > h, else 1
//
// a is the filter's share that holds casters, μ and σ² mean and variance of their heights above the map's far end, h the
// receiver's height. What a filter holds beside casters lights any receiver, also one that stands higher than the map's far
// end: taken for casters at that end, as usual, it would make up for shadows on all that isn't in the map. Where a sloping
// surface ends within the filter its upper part alone is there; h is raised by as much as this part's mean may be above it
// (shaders/prefiltered.glsl), so that it doesn't shade itself, at the cost of light at contacts.
//
// As an upper bound of the box filter's V it leaks light: where a caster shades another's shadow, and where
// a caster's own depth varies. Over casters of one depth it is the box filter's V itself, 1 − a.
//
// Heights are floats in [0, 1] counted from the far end, near which most receivers lie; second moments know a variance to
// some 1e-7 of the height's square. A variance is at least that of the receiver's tolerance (shaders/receiver.glsl): as far
// as depths are known, given a texel's size and the surface's slope.
#include <algorithm>

#include "embedded/shaders.h"
#include "renderer/prefiltered_map.h"
#include "renderer/techniques/prefiltered.h"
#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

class Vsm final : public ShadowTechnique {
  public:
    Vsm(double bleeding_reduction, double margin) : bleeding_reduction_(bleeding_reduction), margin_(margin) {}

    std::vector<std::string_view> shader(const ShadowMap&) const override {
        return {embedded::prefiltered_glsl, embedded::vsm_glsl};
    }

    double reach(const LightFrustum&, double filter_radius) const override {
        return prefiltered_reach(filter_radius, margin_);
    }

    void prepare(const ShadowMap& map) override { moments_.fill(map); }

    void bind(const gl::Program& program, const ShadowMap&) const override {
        gl::set_uniform(program, "bleeding_reduction", static_cast<float>(bleeding_reduction_));
        moments_.bind(program);
    }

    Lookups lookups(const ShadowMap&) const override { return kPrefilteredLookups; }
    double lighting_cost(const ShadowMap&) const override { return kPrefilteredCost; }

  private:
    double bleeding_reduction_;
    double margin_;
    PrefilteredMap moments_{"vsm", embedded::vsm_texels_glsl, GL_RGBA32F};
};

std::unique_ptr<ShadowTechnique> make_vsm(const TechniqueSettings& settings, const ShadowMap& first, bool by_law) {
    const double reduction = settings.bleeding_reduction;
    // Written so that NaN fails.
    if (!(reduction >= 0 && reduction <= kMostBleedingReduction)) {
        throw InputError("--bleeding " + format_number(reduction),
                         "must be from 0 to " + format_number(kMostBleedingReduction), "use for example 0.2");
    }
    return std::make_unique<Vsm>(reduction, prefilter_margin(settings, first, by_law));
}

}  // namespace

TechniqueEntry vsm_technique() {
    return {"vsm", "variance shadow maps, prefiltered with a constant radius", make_vsm};
}

}  // namespace stairstep
