// Filters by taps: which, and how each pixel moves them. The GLSL is shaders/taps.glsl.
#pragma once

#include "renderer/techniques/technique.h"

namespace stairstep {

/// What a tap adds to ShadowTechnique::lighting_cost.
inline constexpr double kTapCost = 0.16;

/// A set of taps on the GPU; the shader's `tap(set, i)` gives its places in units of the radius.
class TapSet {
  public:
    /// `count` taps, as `filter` (not exact or automatic) has them. `option` names the count's flag in errors. Throws
    /// InputError for a count that filter can't have.
    TapSet(FilterMode filter, int count, const char* option);

    int count() const { return count_; }

    /// Farthest that taps reach along an axis, in units of the radius. Radii are a box's half-width everywhere; a disk is
    /// larger by 1.155 so that it has the box's variance, and the two blur alike.
    double reach() const;

    /// As the shader's set `index`, 0 or 1.
    void bind(const gl::Program& program, int index) const;

  private:
    FilterMode filter_;
    int count_;
    gl::Buffer taps_;
};

}  // namespace stairstep
