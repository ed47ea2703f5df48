// Percentage-closer filtering (Reeves et al. 1987) with a box: the share of the box around the receiver, in
// the plane across the light, whose texels leave it lit.
#include <algorithm>
#include <cmath>
#include <vector>

#include "embedded/shaders.h"
#include "renderer/techniques/technique.h"
#include "stimuli/error.h"
#include "stimuli/kernel.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// A box this narrow, in texels, looks like a single texel; a narrower one's area would drown in rounding.
constexpr double kNarrowestExact = 1e-3;
/// Exact filtering beyond this many texels a side takes seconds a frame.
constexpr double kWidestExact = 128;

class PcfExact final : public ShadowTechnique {
  public:
    explicit PcfExact(const glm::dvec2& radius_texels)
        : radius_texels_(glm::max(radius_texels, glm::dvec2(kNarrowestExact))) {
        // A box of width 2r touches at most floor(2r) + 2 texels, and no more than 2r + 1 where 2r is whole.
        // The law gives 2r = 6.94: 8 texels. The slack keeps rounding in 2r from costing a gather.
        const double width = 2 * std::max(radius_texels_.x, radius_texels_.y);
        gathers_per_side_ = static_cast<int>(std::ceil((width + 1) / 2 - 1e-6));
    }

    std::string_view shader() const override { return embedded::pcf_exact_glsl; }

    void bind(const gl::Program& program) const override {
        gl::set_uniform(program, "filter_radius", glm::vec2(radius_texels_));
        gl::set_uniform(program, "gathers_per_side", gathers_per_side_);
    }

    std::string_view lookup_kind() const override { return "gathers"; }
    int lookups() const override { return gathers_per_side_ * gathers_per_side_; }

  private:
    glm::dvec2 radius_texels_;
    int gathers_per_side_;
};

class PcfSampled final : public ShadowTechnique {
  public:
    PcfSampled(const glm::dvec2& radius_texels, int side) : radius_texels_(radius_texels), side_(side) {
        std::vector<glm::vec4> taps;
        for (const KernelTap& tap : box_taps(side)) taps.emplace_back(tap.x, tap.y, tap.weight, 0);
        taps_ = gl::make_buffer(std::as_bytes(std::span(taps)));
    }

    std::string_view shader() const override { return embedded::pcf_sampled_glsl; }

    void bind(const gl::Program& program) const override {
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, taps_.id());
        gl::set_uniform(program, "filter_radius", glm::vec2(radius_texels_));
        gl::set_uniform(program, "tap_count", lookups());
        gl::set_uniform(program, "cell", 2.0f / static_cast<float>(side_));
    }

    std::string_view lookup_kind() const override { return "taps"; }
    int lookups() const override { return side_ * side_; }

  private:
    glm::dvec2 radius_texels_;
    int side_;
    gl::Buffer taps_;
};

std::unique_ptr<ShadowTechnique> make_pcf(const TechniqueSettings& settings, const ShadowMapShape& shape) {
    const glm::dvec2 radius_texels = settings.radius / shape.texel();
    const double width = 2 * std::max(radius_texels.x, radius_texels.y);
    const bool exact = settings.mode == FilterMode::exact ||
                       (settings.mode == FilterMode::automatic && width <= kWidestAutomaticExact);
    if (exact) {
        if (width > kWidestExact) {
            throw InputError("--filter exact", "the filter is " + format_fixed(width, 0) + " texels wide",
                             "use --filter sampled, a smaller map or a smaller --radius");
        }
        return std::make_unique<PcfExact>(radius_texels);
    }
    const int side = static_cast<int>(std::lround(std::sqrt(std::clamp(settings.taps, 0, 4096))));
    if (settings.taps < 1 || side * side != settings.taps) {
        throw InputError("--taps " + std::to_string(settings.taps), "isn't a square number from 1 to 4096",
                         "use for example 25 or 64");
    }
    return std::make_unique<PcfSampled>(radius_texels, side);
}

}  // namespace

TechniqueEntry pcf_technique() {
    return {"pcf", "percentage-closer filtering with the law's box", make_pcf};
}

}  // namespace stairstep
