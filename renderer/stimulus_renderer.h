// Draws a stimulus as a renderer would: a half-plane occluder rasterised into a shadow map of a-px texels, seen by a
// receiver parallel to the screen through percentage-closer filtering with the stimulus's kernel.
//
//   V(p) = Σ_ij w_ij(p)·lit_ij,   w_ij = the kernel's mass on texel (i, j) around p; lit_ij = the texel's shadow test
//
// for box, disk and gaussian; poisson is the share of taps whose nearest texel is lit. It shows that stimuli/'s closed forms
// are what a shadow map does (tests/renderer/stimulus_renderer_test.cpp): within one level of 255 for box, disk and
// gaussian; for poisson equal but where a tap falls on a texel's border, to rounding.
#pragma once

#include <map>
#include <vector>

#include "renderer/gl/objects.h"
#include "stimuli/stimulus.h"

namespace stairstep {

/// Owns nothing but GL objects, of the context that is current when it is made and must be when it draws.
class StimulusRenderer {
  public:
    /// Luminance C·V of every pixel at its centre, row by row from the top: what stimuli/stimulus.h's luminance() returns.
    /// The cost grows with (r/a)²: 640×480 pixels under a disk of 21 texels' radius take some seconds of a CPU. Throws as
    /// half_plane_map, which refuses lines, and FailureError where the driver says no.
    std::vector<double> luminance(const Stimulus& stimulus);

  private:
    const gl::Program& pcf_program(KernelShape shape);

    gl::Program depth_program_;
    /// Made when first asked for.
    std::map<KernelShape, gl::Program> pcf_programs_;
};

}  // namespace stairstep
