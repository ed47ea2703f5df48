// A frame: the shadow map from the light, then the picture from the camera.
#pragma once

#include <memory>

#include "renderer/gl/pass_timer.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/shadow_map.h"
#include "renderer/techniques/technique.h"
#include "renderer/view.h"
#include "stimuli/io/image_file.h"

namespace stairstep {

/// What a frame's pixels are: the lit scene, sRGB-encoded, or visibility alone (1 where nothing is).
enum class Show { colour, visibility };

/// Where a frame is drawn to.
struct FrameTarget {
    Show show = Show::colour;
    int width = 0;
    int height = 0;
    gl::Texture colour;
    gl::Framebuffer framebuffer;
    /// Drawn into first and resolved into `framebuffer`, for more than one sample; otherwise empty.
    gl::Texture multisample_colour;
    /// Multisampled where the colour is.
    gl::Texture depth;
    gl::Framebuffer multisample_framebuffer;
};

/// samples ≥ 1 a pixel, for Show::colour alone: visibility is measured at pixel centres. Throws FailureError.
FrameTarget make_frame_target(Show show, int width, int height, int samples);

/// A technique with its map and its programs.
struct ShadowRenderer {
    ShadowMap map;
    std::unique_ptr<ShadowTechnique> technique;
    gl::Program depth_program;
    gl::Program colour_program;
    gl::Program visibility_program;
};

/// Throws as the technique's make, and FailureError.
ShadowRenderer make_shadow_renderer(const TechniqueEntry& entry, const TechniqueSettings& settings,
                                    const ShadowMapShape& shape);

/// What is seen, and how it is lit.
struct FrameView {
    Camera camera;
    /// The scene's middle and diagonal, world units: where a ground without an end fades.
    glm::dvec3 middle{0};
    double diagonal = 1;
};

struct FrameTime {
    gl::PassTime depth;
    gl::PassTime lighting;
};

/// Draws one frame. The light is the one that the renderer's map was shaped for. Throws FailureError if GL
/// reports an error.
FrameTime draw_frame(const GpuScene& scene, const FrameView& view, const ShadowRenderer& shadows,
                     const FrameTarget& target, gl::PassTimer& timer);

/// The picture that a colour target holds.
Image read_colour(const FrameTarget& target);

/// The visibility that a visibility target holds, row by row from the top, each in [0, 1].
std::vector<float> read_visibility(const FrameTarget& target);

}  // namespace stairstep
