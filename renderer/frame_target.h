// Where a frame is drawn to, and how it is read back.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/gl/objects.h"
#include "stimuli/io/image_file.h"

namespace stairstep {

/// What a frame's pixels are: the lit scene, sRGB-encoded, or visibility alone (1 where nothing is).
enum class Show { colour, visibility };

struct FrameTarget {
    /// Different for each target that is made: tells whether what was kept of a target was kept of this one.
    uint64_t serial = 0;
    Show show = Show::colour;
    int width = 0;
    int height = 0;
    int samples = 1;
    gl::Texture colour;
    /// Multisampled where the colour is.
    gl::Texture depth;
    gl::Framebuffer framebuffer;
    /// Of more than one sample: drawn into first, then resolved into `framebuffer`.
    gl::Texture multisample_colour;
    gl::Framebuffer multisample_framebuffer;
    /// Of one sample: the texel that each pixel needs (receiver.glsl), and a framebuffer with all three.
    gl::Texture need;
    gl::Framebuffer need_framebuffer;
    /// Of one sample: each pixel's nearest surface (view_passes.h), and a framebuffer with both. Its triangle's plane in eye
    /// space (32-bit floats); its normal and colour, packed (shaders/surface.glsl).
    gl::Texture planes;
    gl::Texture materials;
    gl::Framebuffer surface_framebuffer;
    /// Different each time that surfaces are stored or others drawn over their depths, by whoever: tells whether those that are
    /// there are still one's own.
    std::shared_ptr<uint64_t> stored_surfaces = std::make_shared<uint64_t>(0);
};

/// samples ≥ 1 a pixel, for Show::colour alone: visibility is measured at pixel centres. Throws FailureError.
FrameTarget make_frame_target(Show show, int width, int height, int samples);

/// The picture that a colour target holds.
Image read_colour(const FrameTarget& target);

/// The visibility that a visibility target holds, row by row from the top, each in [0, 1].
std::vector<float> read_visibility(const FrameTarget& target);

}  // namespace stairstep
