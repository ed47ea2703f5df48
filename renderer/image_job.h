// The job of `stairstep-render image`: one scene, drawn with one technique at one or more shadow-map sizes,
// timed side by side, compared, and written as pictures with their statistics.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame_target.h"
#include "renderer/gl/context.h"
#include "renderer/light_frustum.h"
#include "renderer/techniques/technique.h"
#include "renderer/shadow_settings.h"
#include "renderer/view.h"

namespace stairstep {

struct ImageJob {
    /// A model's file, or the name of a scene (scenes/scenes.h).
    std::string scene;
    std::string technique = "pcf";
    /// Sides of fixed square maps; nullopt is the law's own size. At least one, none twice.
    std::vector<std::optional<int>> resolutions{std::nullopt};
    /// A file, or "kreuzer2017".
    std::string law = "kreuzer2017";
    /// Whether a law of another kernel than the box may be converted by equal variance.
    bool convert_kernel = false;
    /// Half-width of the box, world units; by default a scene's own, and 2.5 % of the diagonal of a model's bounds.
    std::optional<double> radius;
    FilterMode filter = FilterMode::automatic;
    int taps = 25;
    int search_taps = 25;
    /// As TechniqueSettings.
    double bleeding_reduction = TechniqueSettings{}.bleeding_reduction;
    Fit fit = Fit::axis_aligned;
    /// Of a directional light's map; then the axes are the warp's.
    Warp warp = Warp::none;
    DepthEncoding depth;
    Cascades cascades;
    /// What frames leave out. What didn't change since the last frame isn't among it: all are timed as if something had moved.
    Skips skips = skips_without(kDrawsUnchanged);
    gl::ContextKind context = gl::ContextKind::osmesa;
    int largest_size = 8192;
    int width = 1280;
    int height = 720;
    int samples = 1;
    /// Frames timed for each resolution, ≥ 1, after one that isn't.
    int frames = 5;
    /// By default a scene's own, and for a model from azimuth 35°, elevation 24°.
    std::optional<Direction> camera;
    double camera_distance = 1;
    /// A directional light from there; by default a scene's own, and for a model from −50°, 48°.
    std::optional<Direction> light;
    /// Tangent of half the angle under which the light, a square, is seen, ≥ 0: how soft pcss draws. The sun's is 0.00465.
    /// By default a scene's own, and for a model 0.05.
    std::optional<double> light_half_tangent;
    Show show = Show::colour;
    /// Whether to draw a converged reference (for pcss, trace the area light) and measure each rendering's visibility against it.
    bool truth = false;
    /// The picture, PNG. For two or more resolutions their names go before the extension: out-4096.png,
    /// out-auto.png, and out-difference.png (first against last); so does out-truth.png.
    std::filesystem::path out;
    /// JSON; empty for none.
    std::filesystem::path stats;
};

/// Does the job and returns the statistics; the pictures are written first, each file whole or not at all.
/// Throws InputError and FailureError. Lengths are in world units unless they say px; `file` is relative to the
/// statistics' own file. Keys:
///
///   program, scene, technique, renderer, image_width, image_height, samples, frames
///   triangles                  of the scene, without the ground
///   radius, radius_px_on_screen
///   light_extent               what the map must span along its two axes
///   warp                       lispsm or none
///   depth_bits, spot_depth     how maps store depth (depth_encoding.h)
///   law                        file, kernel, slope, slope_for_box, kernel_converted, texel_range_px
///   truth                      with `truth` only: file, kind and, for a converged filter, its map's width and height and its
///                              taps, or, for pcss, the samples of the area light that rays were traced to (the picture is
///                              then of visibility)
///   difference, speedup        for two or more: the first against the last; the fields of PictureDifference
///   renderings                 one a resolution:
///     resolution, width, height, texels, file
///     limited_by               fixed, law, screen (texels of a pixel) or largest_size
///     radius_in_texels, texel_px_on_screen    along the axis with the coarser texels (under a warp, its
///                                           largest), at the model's centre
///     extrapolates             whether that texel lies outside the law's range
///     filter                   exact, sampled, prefiltered or none; then `gathers` or `taps`: lookups a pixel, and for pcss those of
///                              its search, search_gathers or search_taps
///     surfaces                 stored or drawn: how most frames came to light them (surface_choice.h)
///     frame_ms, depth_ms, lighting_ms         medians on the CPU's clock
///     fit_ms, prepare_ms, need_ms             likewise: fitting the light's frustum, what a technique makes of its map, and
///                                             what it finds the next frame needs
///     gpu_depth_ms, gpu_lighting_ms           the driver's
///     visibility_error         with `truth` only: the fields of VisibilityError
nlohmann::ordered_json run_image_job(const ImageJob& job);

/// The statistics in a paragraph for people.
std::string summary_of(const nlohmann::ordered_json& stats);

}  // namespace stairstep
