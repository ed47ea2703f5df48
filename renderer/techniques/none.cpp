#include "embedded/shaders.h"
#include "renderer/techniques/technique.h"

namespace stairstep {
namespace {

class None final : public ShadowTechnique {
  public:
    std::string_view shader() const override { return embedded::none_glsl; }
    bool reads_map() const override { return false; }
    std::string_view lookup_kind() const override { return "taps"; }
    int lookups() const override { return 0; }
};

}  // namespace

TechniqueEntry none_technique() {
    return {"none", "no shadows",
            [](const TechniqueSettings&, const ShadowMapShape&) -> std::unique_ptr<ShadowTechnique> {
                return std::make_unique<None>();
            }};
}

}  // namespace stairstep
