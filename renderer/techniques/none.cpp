#include "embedded/shaders.h"
#include "renderer/techniques/technique.h"

namespace stairstep {
namespace {

class None final : public ShadowTechnique {
  public:
    std::vector<std::string_view> shader(const ShadowMap&) const override { return {embedded::none_glsl}; }
    bool reads_map() const override { return false; }
    bool takes_warp() const override { return true; }
    double reach(const LightFrustum&, double) const override { return 0; }
    Lookups lookups(const ShadowMap&) const override { return {}; }
    double lighting_cost(const ShadowMap&) const override { return kUnshadowedCost; }
};

}  // namespace

TechniqueEntry none_technique() {
    return {"none", "no shadows",
            [](const TechniqueSettings&, const ShadowMap&, bool) -> std::unique_ptr<ShadowTechnique> {
                return std::make_unique<None>();
            }};
}

}  // namespace stairstep
