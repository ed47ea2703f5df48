#include "embedded/shaders.h"
#include "renderer/techniques/technique.h"

namespace stairstep {
namespace {

class Hard final : public ShadowTechnique {
  public:
    std::vector<std::string_view> shader(const ShadowMap&) const override { return {embedded::hard_glsl}; }
    bool takes_warp() const override { return true; }
    bool takes_linear_depth() const override { return true; }
    double reach(const LightFrustum&, double) const override { return 0; }
    Lookups lookups(const ShadowMap&) const override { return {0, 1, false}; }
    double lighting_cost(const ShadowMap&) const override { return kUnshadowedCost + kReceiverCost; }
};

}  // namespace

TechniqueEntry hard_technique() {
    return {"hard", "one texel, unfiltered",
            [](const TechniqueSettings&, const ShadowMap&, bool) -> std::unique_ptr<ShadowTechnique> {
                return std::make_unique<Hard>();
            }};
}

}  // namespace stairstep
