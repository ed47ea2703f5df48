#include "renderer/image_job.h"

#include <algorithm>
#include <cmath>

#include "analysis/law/law_file.h"
#include "analysis/law/sizing.h"
#include "renderer/box_slope.h"
#include "renderer/comparison.h"
#include "renderer/frame_median.h"
#include "renderer/gl/context.h"
#include "renderer/image_stage.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"
#include "renderer/truth/area_light_truth.h"
#include "stimuli/error.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The reference: map side, and taps a pixel.
constexpr int kTruthSize = 8192;
constexpr int kTruthTaps = 4096;

/// One resolution of the job.
struct Rendering {
    std::string label;
    ShadowRenderer renderer;
    std::vector<FrameTime> times;
    Image picture;
    std::optional<VisibilityError> error;
};

std::string label_of(const std::optional<int>& resolution) {
    return resolution ? std::to_string(*resolution) : "auto";
}

/// out.png → out-label.png
fs::path labelled(const fs::path& out, const std::string& label) {
    fs::path path = out;
    return path.replace_filename(out.stem().string() + "-" + label + out.extension().string());
}

/// How the statistics name a picture: relative to their own file, so that both can move together.
std::string name_in_stats(const ImageJob& job, const fs::path& file) {
    return job.stats.empty() ? file.string() : fs::proximate(file, fs::absolute(job.stats).parent_path()).string();
}

std::vector<fs::path> output_files(const ImageJob& job) {
    std::vector<fs::path> files;
    for (const auto& resolution : job.resolutions) {
        files.push_back(job.resolutions.size() == 1 ? job.out : labelled(job.out, label_of(resolution)));
    }
    if (job.resolutions.size() > 1) files.push_back(labelled(job.out, "difference"));
    if (job.truth) files.push_back(labelled(job.out, "truth"));
    if (!job.stats.empty()) files.push_back(job.stats);
    return files;
}

double distance_along_view(const Camera& camera, const glm::dvec3& point) {
    return glm::dot(camera.eye - point, camera.basis.back);
}

double frame_ms(const Rendering& rendering) {
    return median_of(rendering.times, [](const FrameTime& t) { return t.cpu_ms(); });
}

/// Whether most frames stored their surfaces; some must (surface_choice.h).
bool mostly_stored(const Rendering& rendering) {
    return median_of(rendering.times, [](const FrameTime& t) { return t.stored ? 1.0 : 0.0; }) > 0.5;
}

/// What is drawn.
struct Subject {
    const Scene& model;
    const GpuScene& scene;
    const SceneState& state;
};

/// All resolutions' frames in turn, so that whatever else the machine does slows each alike.
void time_frames(std::vector<Rendering>& renderings, int frames, const Subject& subject, const FrameTarget& target) {
    gl::PassTimer timer;
    Progress progress("timing frames", frames + 1);
    for (int i = 0; i <= frames; ++i) {
        for (Rendering& rendering : renderings) {
            const FrameTime time = rendering.renderer.draw(subject.scene, subject.state, target, timer);
            // The first frame also compiles and touches memory for the first time.
            if (i > 0) rendering.times.push_back(time);
        }
        progress.advance();
    }
}

Image draw_picture(const Subject& subject, ShadowRenderer& renderer, const FrameTarget& target) {
    gl::PassTimer timer;
    renderer.draw(subject.scene, subject.state, target, timer);
    return target.show == Show::colour ? read_colour(target)
                                       : visibility_picture(read_visibility(target), target.width, target.height);
}

std::vector<float> draw_visibility(const Subject& subject, ShadowRenderer& renderer, const FrameTarget& target) {
    gl::PassTimer timer;
    renderer.draw(subject.scene, subject.state, target, timer);
    return read_visibility(target);
}

/// The visibility that renderings are measured against, its picture, and what it is.
struct Truth {
    std::vector<float> visibility;
    Image picture;
    ordered_json description;
};

/// Of an area light: what tracing rays to it finds.
Truth trace_truth(const ImageJob& job, const Subject& subject) {
    Progress progress("tracing the truth", 1);
    Truth truth;
    truth.visibility = area_light_visibility(subject.model, subject.state, job.width, job.height);
    truth.picture = visibility_picture(truth.visibility, job.width, job.height);
    truth.description = {{"kind", "area light"}, {"samples", kTruthSamples}};
    return truth;
}

/// Of a filter of constant radius: the same, converged.
Truth draw_truth(const ImageJob& job, const ShadowSettings& settings, const Subject& subject) {
    ShadowSettings converged = settings;
    converged.technique.filter = FilterMode::jittered;
    converged.technique.filter_taps = kTruthTaps;
    converged.fixed_size = kTruthSize;
    converged.warp = Warp::none;
    converged.depth = {};
    converged.cascades = {};
    ShadowRenderer reference(technique_named("pcf"), converged, subject.scene, subject.state,
                             static_cast<double>(job.width) / job.height);
    Progress progress("drawing the truth", 1);
    Truth truth;
    truth.visibility =
        draw_visibility(subject, reference, make_frame_target(Show::visibility, job.width, job.height, 1));
    truth.picture =
        job.show == Show::visibility
            ? visibility_picture(truth.visibility, job.width, job.height)
            : draw_picture(subject, reference, make_frame_target(job.show, job.width, job.height, job.samples));
    truth.description = {
        {"kind", "converged filter"}, {"width", kTruthSize}, {"height", kTruthSize}, {"taps", kTruthTaps}};
    return truth;
}

Truth measure_errors(std::vector<Rendering>& renderings, const ImageJob& job, const ShadowSettings& settings,
                     const Subject& subject) {
    Truth truth = job.technique == "pcss" ? trace_truth(job, subject) : draw_truth(job, settings, subject);
    const FrameTarget target = make_frame_target(Show::visibility, job.width, job.height, 1);
    for (Rendering& rendering : renderings) {
        rendering.error = compare_visibility(draw_visibility(subject, rendering.renderer, target), truth.visibility);
    }
    return truth;
}

/// `pixel` is in the light plane.
ordered_json describe(const Rendering& rendering, const std::string& file, double pixel, const Interval& law_range) {
    const ShadowMapShape& shape = rendering.renderer.map().shape;
    const ShadowTechnique::Lookups lookups = rendering.renderer.technique().lookups(rendering.renderer.map());
    const std::string lookup_kind = lookups.gathers ? "gathers" : "taps";
    // Of the two axes the one with the coarser texels: it is the one that shows.
    const double texel = std::max(shape.texel().x, shape.texel().y);
    const double texel_px = texel / pixel;
    ordered_json json;
    json["resolution"] = rendering.label;
    json["width"] = shape.width;
    json["height"] = shape.height;
    json["texels"] = shape.texel_count();
    json["limited_by"] = name(shape.limit);
    json["radius_in_texels"] = rendering.renderer.map().filter_radius / texel;
    json["texel_px_on_screen"] = texel_px;
    json["extrapolates"] = texel_px < law_range.first || texel_px > law_range.second;
    json["filter"] = lookups.prefiltered  ? "prefiltered"
                     : lookups.gathers    ? "exact"
                     : lookups.filter > 1 ? "sampled"
                                          : "none";
    json[lookup_kind] = lookups.filter;
    if (lookups.search > 0) json["search_" + lookup_kind] = lookups.search;
    json["surfaces"] = mostly_stored(rendering) ? "stored" : "drawn";
    json["frame_ms"] = frame_ms(rendering);
    json["depth_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.depth.cpu_ms; });
    json["lighting_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.lighting.cpu_ms; });
    json["fit_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.fit_ms; });
    json["prepare_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.prepare.cpu_ms; });
    json["need_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.need.cpu_ms; });
    json["gpu_depth_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.depth.gpu_ms; });
    json["gpu_lighting_ms"] = median_of(rendering.times, [](const FrameTime& t) { return t.lighting.gpu_ms; });
    json["file"] = file;
    if (rendering.error) {
        json["visibility_error"] = {{"rmse", rendering.error->rmse},
                                    {"penumbra_rmse", rendering.error->penumbra_rmse},
                                    {"max", rendering.error->max},
                                    {"share_over_1_level", rendering.error->share_over_1_level},
                                    {"share_over_8_levels", rendering.error->share_over_8_levels},
                                    {"penumbra_share", rendering.error->penumbra_share},
                                    {"light_bleeding", rendering.error->light_bleeding}};
    }
    return json;
}

}  // namespace

ordered_json run_image_job(const ImageJob& job) {
    const TechniqueEntry& technique = technique_named(job.technique);
    const Law law = law_named(job.law);
    const double slope = box_slope(law, job.law, job.convert_kernel);
    const std::vector<fs::path> files = output_files(job);
    // What can't be written is found out before anything is drawn.
    for (const fs::path& file : files) OutputFile probe(file);

    const double aspect = static_cast<double>(job.width) / job.height;
    const Staged staged = stage(job, aspect);
    const SceneState& state = staged.state;
    if (job.truth && job.technique == "pcss" && !state.more_lights.empty()) {
        throw InputError("--truth", job.scene + " has several lights, and rays are traced to one",
                         "leave it out, or use another technique or scene");
    }
    const double radius = staged.radius;
    const double distance = distance_along_view(state.camera, staged.casters.centre());
    const double pixel = pixel_footprint(state.camera, std::max(distance, state.camera.near), job.height);

    // Light-plane lengths of a spot are tangents.
    const bool spot = state.light.kind == Light::Kind::spot;
    const double world_per_plane = spot ? depth_along(state.light, staged.casters.centre()) : 1;

    const auto context = gl::make_context(job.context);
    const GpuScene gpu_scene = upload(staged.scene);
    const Subject subject{staged.scene, gpu_scene, state};
    const FrameTarget target = make_frame_target(job.show, job.width, job.height, job.samples);
    ShadowSettings settings;
    settings.technique = {job.filter, job.taps, job.search_taps, slope, job.bleeding_reduction};
    settings.radius = radius;
    settings.largest_size = job.largest_size;
    settings.fit = job.fit;
    settings.warp = job.warp;
    settings.depth = job.depth;
    settings.cascades = job.cascades;
    settings.skips = job.skips;
    std::vector<Rendering> renderings;
    for (const auto& resolution : job.resolutions) {
        settings.fixed_size = resolution;
        renderings.push_back(
            {label_of(resolution), ShadowRenderer(technique, settings, gpu_scene, state, aspect), {}, {}, {}});
    }
    if (job.samples > 1) {
        // A target of several samples can't measure what pixels need; one of one sample does so first.
        const FrameTarget single = make_frame_target(job.show, job.width, job.height, 1);
        for (Rendering& rendering : renderings) draw_picture(subject, rendering.renderer, single);
    }
    time_frames(renderings, job.frames, subject, target);

    ordered_json stats;
    stats["program"] = "stairstep-render " STAIRSTEP_VERSION;
    stats["scene"] = job.scene;
    stats["triangles"] = staged.triangles;
    stats["technique"] = job.technique;
    stats["warp"] = job.warp == Warp::lispsm ? "lispsm" : "none";
    stats["depth_bits"] = bits_of(job.depth.format);
    stats["spot_depth"] = name(job.depth.spot);
    stats["law"] = {{"file", job.law},
                    {"kernel", name(law.kernel)},
                    {"slope", law.slope},
                    {"slope_for_box", slope},
                    {"kernel_converted", law.kernel != KernelShape::box},
                    {"texel_range_px", law.texel_range_px}};
    stats["radius"] = radius;
    stats["radius_px_on_screen"] = radius / pixel;
    const glm::dvec2 extent = renderings.back().renderer.map().shape.frustum.extent();
    stats["light_extent"] = {extent.x, extent.y};
    stats["renderer"] = gl::renderer_name();
    stats["image_width"] = job.width;
    stats["image_height"] = job.height;
    stats["samples"] = job.samples;
    stats["frames"] = job.frames;

    for (Rendering& rendering : renderings) rendering.picture = draw_picture(subject, rendering.renderer, target);
    if (job.truth) {
        const Truth truth = measure_errors(renderings, job, settings, subject);
        const fs::path file = labelled(job.out, "truth");
        write_png(file, truth.picture);
        stats["truth"] = truth.description;
        stats["truth"]["file"] = name_in_stats(job, file);
    }
    stats["renderings"] = ordered_json::array();
    for (size_t i = 0; i < renderings.size(); ++i) {
        write_png(files[i], renderings[i].picture);
        stats["renderings"].push_back(
            describe(renderings[i], name_in_stats(job, files[i]), pixel / world_per_plane, law.texel_range_px));
    }
    if (renderings.size() > 1) {
        const Rendering& first = renderings.front();
        const Rendering& last = renderings.back();
        const PictureDifference difference = compare_pictures(first.picture, last.picture);
        const int scale = difference_scale(difference);
        const fs::path file = labelled(job.out, "difference");
        write_png(file, difference_picture(first.picture, last.picture, scale));
        stats["difference"] = {{"between", {first.label, last.label}},
                               {"file", name_in_stats(job, file)},
                               {"scale", scale},
                               {"rmse_levels", difference.rmse_levels},
                               {"max_levels", difference.max_levels},
                               {"share_over_1_level", difference.share_over_1_level},
                               {"share_over_8_levels", difference.share_over_8_levels}};
        stats["speedup"] = frame_ms(first) / frame_ms(last);
    }
    if (!job.stats.empty()) write_json(job.stats, stats);
    return stats;
}

std::string summary_of(const ordered_json& stats) {
    std::string text = stats["scene"].get<std::string>() + ", " + std::to_string(stats["triangles"].get<size_t>()) +
                       " triangles, " + stats["technique"].get<std::string>() + " with a radius of " +
                       format_fixed(stats["radius"], 4) + " (" + format_fixed(stats["radius_px_on_screen"], 1) +
                       " px on screen), on " + stats["renderer"].get<std::string>() + ".\n";
    for (const ordered_json& rendering : stats["renderings"]) {
        text += "  " + rendering["resolution"].get<std::string>() + ": " +
                std::to_string(rendering["width"].get<int>()) + "x" + std::to_string(rendering["height"].get<int>()) +
                " texels of " + format_fixed(rendering["texel_px_on_screen"], 1) + " px, " +
                format_fixed(rendering["frame_ms"], 1) + " ms a frame (depth " +
                format_fixed(rendering["depth_ms"], 1) + ", lighting " + format_fixed(rendering["lighting_ms"], 1) +
                ")";
        if (rendering.contains("visibility_error")) {
            text += ", penumbra error " + format_fixed(rendering["visibility_error"]["penumbra_rmse"], 4) +
                    ", light bleeding " + format_fixed(rendering["visibility_error"]["light_bleeding"], 4);
        }
        if (rendering["resolution"] == "auto" && rendering["extrapolates"].get<bool>()) {
            text += ", beyond the texel sizes that the law was measured at";
        }
        text += "; " + rendering["file"].get<std::string>() + "\n";
    }
    if (stats.contains("difference")) {
        const ordered_json& difference = stats["difference"];
        text += "  " + format_fixed(stats["speedup"], 2) + " times as fast; " +
                format_fixed(100 * difference["share_over_8_levels"].get<double>(), 2) +
                " % of the pixels differ by more than 8 levels of 255, at most by " +
                std::to_string(difference["max_levels"].get<int>()) + "; " + difference["file"].get<std::string>() +
                " (times " + std::to_string(difference["scale"].get<int>()) + ")\n";
    }
    return text;
}

}  // namespace stairstep
