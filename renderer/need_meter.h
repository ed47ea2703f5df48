// What texels a frame's pixels needed, condensed for the choice of the next frame's (Kreuzer 2017, eq. 5.12).
//
// A frame writes each pixel's needed texel, in the light plane, beside its colour. A pass condenses that to a tile of 8 × 8
// pixels, which is read back while the next frame is drawn: no pass waits for it, and no geometry is drawn for it.
#pragma once

#include <optional>
#include <vector>

#include "renderer/frame_target.h"
#include "renderer/gl/program.h"

namespace stairstep {

/// Which of the pixels' needs the map serves.
struct NeedStatistic {
    enum class Kind {
        /// The finest that any pixel needs.
        extreme,
        /// The finest but for a share of the pixels.
        percentile,
        /// The finest but for a share of the tiles, each by its finest pixel.
        tiles,
    };
    Kind kind = Kind::percentile;
    /// Share that is left out, in [0, 1): of the pixels or tiles that need anything.
    double share = 0.05;
};

/// Tiles as read back: for each that needs anything, the finest need of its pixels, and that of one pixel of its own, which
/// may be infinite.
struct TileNeeds {
    std::vector<float> finest;
    std::vector<float> one_pixel;
};

/// The texel that serves all but the statistic's share; infinite where nothing needs any.
double needed_texel(const TileNeeds& tiles, const NeedStatistic& statistic);

class NeedMeter {
  public:
    NeedMeter();

    /// Condenses the need of the frame that `target`, of one sample, holds, and starts to read it back.
    void measure(const FrameTarget& target);

    /// What the last measured frame's tiles need, once; nullopt before. Waits for the GPU to have done that frame.
    std::optional<TileNeeds> take();

  private:
    gl::Program program_;
    gl::VertexArray no_vertices_;
    int width_ = 0;
    int height_ = 0;
    gl::Texture tiles_;
    gl::Framebuffer framebuffer_;
    gl::Buffer read_back_;
    bool pending_ = false;
};

}  // namespace stairstep
