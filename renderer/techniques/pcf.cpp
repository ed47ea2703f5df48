// Percentage-closer filtering (Reeves et al. 1987): the share of a box or a disk around the receiver, in
// the plane across the light, whose texels leave it lit.
#include <algorithm>
#include <cmath>

#include "embedded/shaders.h"
#include "renderer/depth_ranges.h"
#include "renderer/techniques/taps.h"
#include "renderer/texel_quads.h"
#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// A box this narrow, in texels, looks like a single texel; a narrower one's area would drown in rounding.
constexpr double kNarrowestExact = 1e-3;

/// Finding the ranges of more takes as long as they save.
constexpr size_t kMostTexelsForRanges = size_t{4} << 20;

/// Packing a texel takes as long as four or five gathers save that find it packed. Maps are packed that have no more texels than
/// this for each gather of a pixel: 2^17 pixels in penumbrae, a seventh of 1280 × 720, then make up for it.
constexpr size_t kTexelsAGather = size_t{1} << 15;
/// However wide the filter is: 16 MiB, in memory that grows by doubling.
constexpr size_t kMostTexelsForQuads = size_t{1} << 20;

/// What a gather adds to ShadowTechnique::lighting_cost, where the ranges of most windows tell that none is needed.
constexpr double kGatherCost = 0.12;

/// Of a warped map, where its texels are smallest.
glm::dvec2 radius_texels(const ShadowMap& map) {
    return map.filter_radius / map.shape.smallest_texel();
}

double width_texels(const ShadowMap& map) {
    const glm::dvec2 radius = radius_texels(map);
    return 2 * std::max(radius.x, radius.y);
}

void require_narrow(const ShadowMap& map) {
    if (width_texels(map) <= kWidestExact) return;
    throw InputError("--filter exact", "the filter is " + format_fixed(width_texels(map), 0) + " texels wide",
                     "use another filter, a smaller map or a smaller --radius");
}

class PcfExact final : public ShadowTechnique {
  public:
    explicit PcfExact(bool skip_even_texels) : skip_even_texels_(skip_even_texels) {}

    std::vector<std::string_view> shader(const ShadowMap& map) const override {
        return {embedded::ranges_glsl, embedded::box_filter_glsl,
                has_quads(map) ? embedded::texel_quads_glsl : embedded::texel_gather_glsl, embedded::pcf_exact_glsl};
    }

    void prepare(const ShadowMap& map) override {
        const glm::ivec2 size = glm::ivec2(map.shape.width, map.shape.height) + 2 * kGuardTexels;
        if (has_ranges(map)) ranges_.fill(map.memory.depth.id(), size);
        if (has_quads(map)) quads_.fill(map.memory.depth.id(), size);
    }

    bool takes_warp() const override { return true; }
    bool takes_linear_depth() const override { return true; }

    double reach(const LightFrustum&, double filter_radius) const override { return filter_radius; }

    void bind(const gl::Program& program, const ShadowMap& map) const override {
        require_narrow(map);
        const glm::dvec2 radius = glm::max(radius_texels(map), glm::dvec2(kNarrowestExact));
        gl::set_uniform(program, "filter_radius", glm::vec2(radius));
        gl::set_uniform(program, "gathers_per_side", gathers_per_side(map));
        gl::set_uniform(program, "with_ranges", has_ranges(map) ? 1 : 0);
        ranges_.bind(program);
        if (has_quads(map)) quads_.bind();
    }

    Lookups lookups(const ShadowMap& map) const override {
        return {0, gathers_per_side(map) * gathers_per_side(map), true};
    }

    double lighting_cost(const ShadowMap& map) const override {
        return kUnshadowedCost + kReceiverCost + kGatherCost * lookups(map).filter;
    }

  private:
    /// Whether windows hold the box, and finding them costs less than they save.
    bool has_ranges(const ShadowMap& map) const {
        // Ranges are planes of what is stored.
        return map.shape.frustum.stores_planes() && skip_even_texels_ &&
               2 * gathers_per_side(map) + kWindowStep - 1 <= kWindowWidth &&
               map.shape.texel_count() <= kMostTexelsForRanges;
    }

    static bool has_quads(const ShadowMap& map) {
        const size_t gathers = static_cast<size_t>(gathers_per_side(map)) * gathers_per_side(map);
        return map.shape.texel_count() <= std::min(gathers * kTexelsAGather, kMostTexelsForQuads);
    }

    static int gathers_per_side(const ShadowMap& map) {
        // A box of width 2r touches at most floor(2r) + 2 texels, and no more than 2r + 1 where 2r is whole.
        // The law gives 2r = 6.94: 8 texels. The slack keeps rounding in 2r from costing a gather.
        const double width = std::max(width_texels(map), 2 * kNarrowestExact);
        return static_cast<int>(std::ceil((width + 1) / 2 - 1e-6));
    }

    bool skip_even_texels_;
    DepthRanges ranges_;
    TexelQuads quads_;
};

class PcfSampled final : public ShadowTechnique {
  public:
    PcfSampled(FilterMode filter, int taps) : taps_(filter, taps, "--taps") {}

    std::vector<std::string_view> shader(const ShadowMap&) const override {
        return {embedded::taps_glsl, embedded::pcf_sampled_glsl};
    }

    bool takes_warp() const override { return true; }
    bool takes_linear_depth() const override { return true; }

    double reach(const LightFrustum&, double filter_radius) const override { return filter_radius * taps_.reach(); }

    void bind(const gl::Program& program, const ShadowMap& map) const override {
        gl::set_uniform(program, "filter_radius", glm::vec2(radius_texels(map)));
        taps_.bind(program, 0);
    }

    Lookups lookups(const ShadowMap&) const override { return {0, taps_.count(), false}; }

    double lighting_cost(const ShadowMap&) const override {
        return kUnshadowedCost + kReceiverCost + kTapCost * taps_.count();
    }

  private:
    TapSet taps_;
};

std::unique_ptr<ShadowTechnique> make_pcf(const TechniqueSettings& settings, const ShadowMap& first, bool) {
    FilterMode filter = settings.filter;
    if (filter == FilterMode::automatic) {
        filter = width_texels(first) <= kWidestAutomaticExact ? FilterMode::exact : FilterMode::jittered;
    }
    if (filter == FilterMode::exact) {
        require_narrow(first);
        return std::make_unique<PcfExact>(settings.skip_even_texels);
    }
    return std::make_unique<PcfSampled>(filter, settings.filter_taps);
}

}  // namespace

TechniqueEntry pcf_technique() {
    return {"pcf", "percentage-closer filtering with a constant radius", make_pcf};
}

}  // namespace stairstep
