#include "embedded/shaders.h"
#include "renderer/techniques/technique.h"

namespace stairstep {
namespace {

class Hard final : public ShadowTechnique {
  public:
    std::string_view shader() const override { return embedded::hard_glsl; }
    std::string_view lookup_kind() const override { return "taps"; }
    int lookups() const override { return 1; }
};

}  // namespace

TechniqueEntry hard_technique() {
    return {"hard", "one texel, unfiltered",
            [](const TechniqueSettings&, const ShadowMapShape&) -> std::unique_ptr<ShadowTechnique> {
                return std::make_unique<Hard>();
            }};
}

}  // namespace stairstep
