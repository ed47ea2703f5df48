// What a shadow technique is: a piece of GLSL that turns a receiver into its visibility, and the numbers it
// needs.
//
// To add one: a file here with its TechniqueEntry, its shader, and a line in techniques.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl/program.h"
#include "renderer/shadow_map.h"

namespace stairstep {

/// How a filter is evaluated.
enum class FilterMode {
    /// exact where the first map's filter covers at most kWidestAutomaticExact texels, else jittered.
    automatic,
    /// The box; every texel weighed by its area.
    exact,
    /// The box; taps in the middle of equal cells.
    regular,
    /// The box; the regular taps, shifted in each pixel by a random part of a cell.
    jittered,
    /// The disk; Poisson-disk taps.
    poisson,
    /// The disk; Poisson-disk taps turned by a random angle in each pixel.
    rotated,
};

std::string_view name(FilterMode mode);
/// Throws InputError that lists the names there are; `sampled` is another name of jittered.
FilterMode filter_mode_named(const std::string& name);

inline constexpr double kWidestAutomaticExact = 16;
/// Exact filtering beyond this many texels a side takes seconds a frame.
inline constexpr double kWidestExact = 128;

inline constexpr double kMostBleedingReduction = 0.95;

struct TechniqueSettings {
    FilterMode filter = FilterMode::automatic;
    /// Of a filter that takes taps, in [1, 4096]; a square number for regular and jittered.
    int filter_taps = 25;
    /// Of a blocker search that takes taps, likewise.
    int search_taps = 25;
    /// c > 0 of a box, half-width in texels: what filters that choose their own texels, and maps sized by the law, go by.
    double law_slope = 3.47;
    /// Of vsm, in [0, kMostBleedingReduction]: of the casters' share that Chebyshev's bound leaves lit, what counts as none;
    /// the rest is stretched over [0, 1]. Of crane and clutter, 0.1 to 0.2 have the lowest error of the penumbra (more eats into
    /// it), and 0.2 a third of the bleeding that 0 has.
    double bleeding_reduction = 0.2;
    /// Whether one look at a window of texels that all agree stands for the rest of them.
    bool skip_even_texels = true;
};

/// What lighting a fragment takes where no shadow is computed, and what finding its place in the map adds: see lighting_cost.
inline constexpr double kUnshadowedCost = 1.3;
inline constexpr double kReceiverCost = 0.4;

/// A technique, ready for a scene's maps.
class ShadowTechnique {
  public:
    ShadowTechnique() = default;
    virtual ~ShadowTechnique() = default;
    ShadowTechnique(const ShadowTechnique&) = delete;
    ShadowTechnique& operator=(const ShadowTechnique&) = delete;

    /// GLSL that defines `float visibility(Receiver)` for a map that was prepared, in parts; see shaders/receiver.glsl. Parts are
    /// told apart by where their text is, which is to stay.
    virtual std::vector<std::string_view> shader(const ShadowMap& map) const = 0;

    /// Whether it reads the shadow map; without, no depth pass is drawn.
    virtual bool reads_map() const { return true; }

    /// Whether it can look into a map whose texels differ in size (light_warp.h).
    virtual bool takes_warp() const { return false; }

    /// Whether it reads a spot's depths that are linear (depth_encoding.h): only through lit() of shaders/receiver.glsl.
    virtual bool takes_linear_depth() const { return false; }

    /// Whether its filter's radius is its own in each pixel, and it writes `needed_texel`.
    virtual bool measures_need() const { return false; }

    /// Memory for maps of up to `capacity` texels a side, and for what it keeps beside them. Throws FailureError.
    virtual ShadowMap reserve(int capacity, DepthFormat format) const { return reserve_shadow_map(capacity, format); }

    /// How far from the receiver it looks, light plane. `filter_radius` is ShadowMap's.
    virtual double reach(const LightFrustum& frustum, double filter_radius) const = 0;

    /// Passes over a map just drawn, ahead of the lighting.
    virtual void prepare([[maybe_unused]] const ShadowMap& map) {}

    /// Sets the technique's own uniforms and buffers; `program` contains its shader and draws next. Texture units from 2
    /// are free.
    virtual void bind([[maybe_unused]] const gl::Program& program, [[maybe_unused]] const ShadowMap& map) const {}

    /// Lookups a pixel, at most.
    struct Lookups {
        int search = 0;
        int filter = 0;
        /// What each is: gathers of four texels, from the map or from where it is packed (texel_quads.h), or taps.
        bool gathers = false;
        /// Whether they are into a map that was filtered before.
        bool prefiltered = false;
    };
    virtual Lookups lookups(const ShadowMap& map) const = 0;

    /// What lighting a surface's fragment takes, in units of what storing one takes (surface_choice.h), ≥ kUnshadowedCost; by
    /// measurement (docs/skips.md), of maps that the law sizes.
    virtual double lighting_cost(const ShadowMap& map) const = 0;
};

/// A line of the list of techniques.
struct TechniqueEntry {
    std::string_view name;
    std::string_view summary;
    /// For maps that may come in any size, `first` being the first of them. Throws InputError for settings it can't take.
    std::unique_ptr<ShadowTechnique> (*make)(const TechniqueSettings& settings, const ShadowMap& first, bool by_law);
};

}  // namespace stairstep
