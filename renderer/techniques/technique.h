// What a shadow technique is: a piece of GLSL that turns a receiver into its visibility, and the numbers it
// needs.
//
// To add one: a file here with its TechniqueEntry, its shader, and a line in techniques.cpp.
#pragma once

#include <memory>
#include <string_view>

#include "renderer/gl/program.h"
#include "renderer/light_frustum.h"

namespace stairstep {

/// How a filter is evaluated: exact weighs every texel, sampled takes taps; automatic is exact where the
/// filter covers at most kWidestAutomaticExact texels.
enum class FilterMode { automatic, exact, sampled };

inline constexpr double kWidestAutomaticExact = 16;

struct TechniqueSettings {
    /// Half-width of the filter's support, world units across the light, > 0.
    double radius = 0;
    FilterMode mode = FilterMode::automatic;
    /// For sampled: a square number in [1, 4096].
    int taps = 25;
};

/// A technique, ready for maps of one shape.
class ShadowTechnique {
  public:
    ShadowTechnique() = default;
    virtual ~ShadowTechnique() = default;
    ShadowTechnique(const ShadowTechnique&) = delete;
    ShadowTechnique& operator=(const ShadowTechnique&) = delete;

    /// GLSL that defines `float visibility(Receiver)`; see shaders/receiver.glsl.
    virtual std::string_view shader() const = 0;

    /// Sets the technique's own uniforms and buffers; `program` contains its shader and draws next.
    virtual void bind([[maybe_unused]] const gl::Program& program) const {}

    /// Whether it reads the shadow map; without, no depth pass is drawn.
    virtual bool reads_map() const { return true; }

    /// Kind of lookup and lookups a pixel: "gathers" and 16, say.
    virtual std::string_view lookup_kind() const = 0;
    virtual int lookups() const = 0;
};

/// A line of the list of techniques.
struct TechniqueEntry {
    std::string_view name;
    std::string_view summary;
    /// Throws InputError for settings it can't take.
    std::unique_ptr<ShadowTechnique> (*make)(const TechniqueSettings& settings, const ShadowMapShape& shape);
};

}  // namespace stairstep
