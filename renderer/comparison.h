// How far two pictures, a picture and the truth, or two sequences of frames lie apart.
#pragma once

#include <vector>

#include "stimuli/io/image_file.h"

namespace stairstep {

/// Between two pictures of one size, in 8-bit levels as displayed.
struct PictureDifference {
    /// Over all channels of all pixels.
    double rmse_levels = 0;
    int max_levels = 0;
    /// Share of the pixels with a channel that differs by more than 1 and 8 levels.
    double share_over_1_level = 0;
    double share_over_8_levels = 0;
};

PictureDifference compare_pictures(const Image& a, const Image& b);

/// |a − b| a channel, times scale ≥ 1, cut at 255.
Image difference_picture(const Image& a, const Image& b, int scale);

/// The largest scale that cuts nothing, at most 32 so that rounding noise stays dark.
int difference_scale(const PictureDifference& difference);

/// The error of a visibility against the true one; visibility is in [0, 1] and a level is 1/255.
struct VisibilityError {
    double rmse = 0;
    /// Over the pixels of the penumbra alone, where the truth is neither 0 nor 1; 0 where there is none.
    double penumbra_rmse = 0;
    double max = 0;
    double share_over_1_level = 0;
    double share_over_8_levels = 0;
    /// Share of the pixels that lie in the penumbra.
    double penumbra_share = 0;
    /// Light bleeding: mean visibility of the pixels where the truth is fully dark, surfaces turned away from the light, which
    /// no technique lights, among them; 0 where there are none.
    double light_bleeding = 0;
};

/// Both of the same length, at least 1.
VisibilityError compare_visibility(const std::vector<float>& rendered, const std::vector<float>& truth);

/// How much a sequence's shadows move where the true ones don't, and how much they fail to where those do:
///
///   wobble = mean over pixels and pairs of consecutive frames of |ΔI − ΔI_true|,   ΔI = I(frame t + 1) − I(frame t)
///
/// An error that stays in its place costs nothing; one that crawls or flickers does. The change is each pixel's own: what a
/// moving camera does to a picture, it does to the true one as well.
class Wobble {
  public:
    /// The next frame of both sequences, of the same length as the frames before and at least 1.
    void add(const std::vector<float>& rendered, const std::vector<float>& truth);

    /// In units of the frames' values; 0 as long as there are less than two frames.
    double mean() const;
    size_t frames() const { return frames_; }

  private:
    /// Rendered less true, of the last frame: ΔI − ΔI_true is its change.
    std::vector<double> error_;
    double sum_ = 0;
    size_t frames_ = 0;
};

/// Visibility as a grey picture, 255 lit.
Image visibility_picture(const std::vector<float>& visibility, int width, int height);

}  // namespace stairstep
