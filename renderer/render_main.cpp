// stairstep-render: sizes shadow maps by the law and draws scenes with them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <optional>

#include "analysis/law/grating_error.h"
#include "analysis/law/law_file.h"
#include "analysis/law/sizing.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/picture_size.h"
#include "renderer/image_job.h"
#include "renderer/scenes/scenes.h"
#include "renderer/techniques/techniques.h"
#include "stimuli/error.h"
#include "stimuli/io/program.h"
#include "stimuli/number.h"
#include "stimuli/stimulus.h"

namespace stairstep {
namespace {

struct SizeOptions {
    std::string law = "kreuzer2017";
    double radius = 0;
    double extent = 0;
    double smallest_texel = 0;
    int largest_size = 16384;
    /// Of a grating, both or neither.
    std::optional<double> gap;
    std::optional<double> period;
    bool json = false;
};

struct ImageOptions {
    ImageJob job;
    std::string resolution = "auto";
    std::string size = "1280x720";
    std::string filter = "auto";
    std::string context = "osmesa";
    std::string fit = "axes";
    std::string warp = "none";
    int depth_bits = 32;
    std::string spot_depth = "reciprocal";
    std::string splits = "practical";
    std::string no_skip = kDrawsUnchanged;
    std::string camera;
    std::string light;
    std::string show = "colour";
    bool json = false;
};

/// What the map makes of a grating, where one is asked about.
nlohmann::ordered_json describe_grating(const SizeOptions& options, const Law& law, double texel) {
    if (law.kernel != KernelShape::box) {
        throw InputError("--gap", "is of a box, the law is of another filter", "use a law of the box, as kreuzer2017");
    }
    const Grating grating{*options.gap, *options.period};
    return {{"gap_texels", grating.gap / texel},
            {"period_texels", grating.period / texel},
            {"visibility_rmse", grating_rmse(grating, texel, options.radius)}};
}

void print_size(const SizeOptions& options) {
    const Law law = law_named(options.law);
    const MapSize size =
        shadow_map_size({law.slope, options.radius, options.extent, options.smallest_texel, options.largest_size});
    if (size.limit == SizeLimit::largest_size) {
        const std::string wanted =
            size.texels_wanted < 1e15 ? format_fixed(size.texels_wanted, 0) : "more than a million billion";
        throw FailureError(
            "shadow map",
            "the law wants " + wanted + " texels a side, --largest-size allows " + std::to_string(options.largest_size),
            "use a larger --radius or --smallest-texel, or a smaller --extent");
    }
    nlohmann::ordered_json json{{"texels", size.texels},
                                {"limited_by", size.limit == SizeLimit::screen ? "screen" : "law"},
                                {"slope", law.slope},
                                {"kernel", name(law.kernel)}};
    if (options.gap) json["grating"] = describe_grating(options, law, options.extent / size.texels);
    if (options.json) {
        std::cout << json.dump(2) << "\n";
        return;
    }
    std::cout << size.texels << "\n";
    if (options.gap) {
        const nlohmann::ordered_json& grating = json["grating"];
        std::cout << "gaps of " << format_fixed(grating["gap_texels"], 2) << " texels every "
                  << format_fixed(grating["period_texels"], 2) << ": visibility off by "
                  << format_fixed(grating["visibility_rmse"], 3) << " root mean square\n";
    }
}

std::vector<std::optional<int>> resolutions_of(const std::string& text) {
    std::vector<std::optional<int>> resolutions;
    for (const std::string& part : split(text, ',')) {
        const std::optional<int> side = side_of(part);
        if (!side && part != "auto") {
            throw InputError("--resolution", "\"" + part + "\" is no shadow-map size", "use auto or 1 to 16384");
        }
        if (std::find(resolutions.begin(), resolutions.end(), side) != resolutions.end()) {
            throw InputError("--resolution", "\"" + part + "\" is listed twice", "list each size once");
        }
        resolutions.push_back(side);
    }
    if (resolutions.empty()) throw InputError("--resolution", "is empty", "use auto or 1 to 16384");
    return resolutions;
}

/// "azimuth,elevation" and, where `factor` isn't null, ",factor" after it.
Direction direction_of(const std::string& flag, const std::string& text, double* factor) {
    const std::vector<std::string> parts = split(text, ',');
    std::vector<double> numbers;
    for (const std::string& part : parts) {
        if (const auto number = parse_number(part)) numbers.push_back(*number);
    }
    const bool complete = numbers.size() == parts.size() && (numbers.size() == 2 || (factor && numbers.size() == 3));
    if (!complete || std::abs(numbers[0]) > 3600 || !(numbers[1] >= 1 && numbers[1] <= 90) ||
        (numbers.size() == 3 && !(numbers[2] >= 0.05 && numbers[2] <= 20))) {
        throw InputError(flag, "\"" + text + "\" is no direction",
                         factor ? "write azimuth,elevation[,distance]: degrees, elevation 1 to 90, distance 0.05 to 20"
                                : "write azimuth,elevation in degrees, elevation 1 to 90");
    }
    if (numbers.size() == 3) *factor = numbers[2];
    return {numbers[0], numbers[1]};
}

ImageJob job_of(const ImageOptions& options) {
    ImageJob job = options.job;
    job.resolutions = resolutions_of(options.resolution);
    std::tie(job.width, job.height) = picture_size_of("--size", options.size);
    job.filter = filter_mode_named(options.filter);
    job.context = gl::context_kind_named(options.context);
    job.fit = options.fit == "smallest" ? Fit::smallest_rectangle : Fit::axis_aligned;
    job.cascades.splits = splits_named(options.splits);
    job.skips = skips_without(options.no_skip);
    job.depth = {depth_format_of_bits(options.depth_bits), spot_depth_named(options.spot_depth)};
    job.warp = options.warp == "lispsm" ? Warp::lispsm : Warp::none;
    if (job.light_half_tangent && !(*job.light_half_tangent >= 0 && *job.light_half_tangent <= 1)) {
        throw InputError("--light-size " + format_number(*job.light_half_tangent), "must be from 0 to 1",
                         "use for example 0.05; the sun's is 0.00465");
    }
    if (!options.camera.empty()) job.camera = direction_of("--camera", options.camera, &job.camera_distance);
    if (!options.light.empty()) job.light = direction_of("--light", options.light, nullptr);
    job.show = options.show == "visibility" ? Show::visibility : Show::colour;
    if (job.out.extension() != ".png") {
        throw InputError("--out", "\"" + job.out.string() + "\" is no PNG file name", "use a name that ends in .png");
    }
    return job;
}

void draw_image(const ImageOptions& options) {
    const nlohmann::ordered_json stats = run_image_job(job_of(options));
    std::cout << (options.json ? stats.dump(2) + "\n" : summary_of(stats));
}

void add_size_command(CLI::App& app, SizeOptions& options) {
    CLI::App* command = app.add_subcommand("size", "Prints how many texels a side a shadow map needs.");
    command->add_option("--law", options.law, "law.json, or kreuzer2017")->capture_default_str();
    command->add_option("--radius", options.radius, "half-width of the filter, in the unit of --extent")->required();
    command->add_option("--extent", options.extent, "what the map spans, as 28 (m)")->required();
    command->add_option("--smallest-texel", options.smallest_texel, "a pixel's footprint: finer texels are of no use")
        ->capture_default_str();
    command->add_option("--largest-size", options.largest_size, "texels a side that may be had")->capture_default_str();
    CLI::Option* gap = command->add_option(
        "--gap", options.gap, "width of the gaps of a fence or lattice: also prints how far off its shadow will be");
    CLI::Option* period = command->add_option("--period", options.period, "from a gap to the next");
    gap->needs(period);
    period->needs(gap);
    command->add_flag("--json", options.json, "print JSON");
    command->callback([&options] { print_size(options); });
}

void add_image_command(CLI::App& app, ImageOptions& options) {
    ImageJob& job = options.job;
    std::string techniques;
    for (const TechniqueEntry& entry : stairstep::techniques()) {
        techniques +=
            (techniques.empty() ? "" : ", ") + std::string(entry.name) + " (" + std::string(entry.summary) + ")";
    }
    CLI::App* command = app.add_subcommand("image", "Draws a model on a ground plane with shadows, and measures it.");
    std::string named;
    for (const SceneEntry& entry : scenes()) named += ", " + std::string(entry.name);
    command->add_option("scene", job.scene, "a model (glTF, OBJ, Collada and others), or one of" + named.substr(1))
        ->required();
    command->add_option("--technique", job.technique, techniques)->capture_default_str();
    command
        ->add_option("--resolution", options.resolution,
                     "shadow-map sizes: auto (the law's) or texels a side; 4096,auto draws and compares both")
        ->capture_default_str();
    command->add_option("--law", job.law, "law.json, or kreuzer2017")->capture_default_str();
    command->add_flag("--convert-kernel", job.convert_kernel, "accept a law of another kernel, by equal variance");
    command->add_option("--radius", job.radius,
                        "half-width of the filter, world units; default: a scene's own, 2.5 % of a model's diagonal");
    command
        ->add_option("--filter", options.filter,
                     "exact weighs every texel; regular, jittered (or sampled), poisson and rotated take --taps")
        ->check(CLI::IsMember({"auto", "exact", "regular", "jittered", "sampled", "poisson", "rotated"}))
        ->capture_default_str();
    command->add_option("--taps", job.taps, "up to 4096; a square number for regular and jittered")
        ->capture_default_str();
    command->add_option("--search-taps", job.search_taps, "of pcss's blocker search, likewise")->capture_default_str();
    command
        ->add_option("--bleeding", job.bleeding_reduction,
                     "of vsm: the share of light that counts as bleeding and is left out, 0 to 0.95")
        ->capture_default_str();
    command
        ->add_option(
            "--light-size", job.light_half_tangent,
            "for pcss: tangent of half the angle that the light is seen under (a spot: half its side, world units); "
            "default: a scene's own, 0.05 for a model; the sun's is 0.00465")
        ->check(CLI::Number);
    command->add_option("--fit", options.fit, "the map lies along the light's axes, or as makes it smallest")
        ->check(CLI::IsMember({"axes", "smallest"}))
        ->capture_default_str();
    command
        ->add_option("--cascades", job.cascades.count,
                     "cuts the view across into so many slices, each with a map of its own")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command->add_option("--splits", options.splits, "where: uniform, logarithmic or practical (their mean)")
        ->capture_default_str();
    command
        ->add_option("--no-skip", options.no_skip,
                     "draws what frames else leave out, the picture being the same: names separated by commas, of " +
                         skip_names() + "; all; empty for none")
        ->capture_default_str();
    command
        ->add_option("--warp", options.warp,
                     "lispsm makes texels smaller near the camera (hard and pcf under a directional light)")
        ->check(CLI::IsMember({"none", "lispsm"}))
        ->capture_default_str();
    command->add_option("--depth-bits", options.depth_bits, "of the map: 16, 24 or 32 (a float)")
        ->capture_default_str();
    command
        ->add_option("--spot-depth", options.spot_depth,
                     "what a spot's map is linear in: the depth's reciprocal, or linear (hard and pcf)")
        ->capture_default_str();
    command->add_option("--context", options.context, "osmesa (no display), egl (no display, GPU) or window")
        ->capture_default_str();
    command->add_option("--largest-size", job.largest_size, "most texels a side for auto")
        ->check(CLI::Range(1, kLargestSide))
        ->capture_default_str();
    command->add_option("--size", options.size, "of the picture, px")->capture_default_str();
    command->add_option("--samples", job.samples, "a pixel, for smooth outlines")
        ->check(CLI::Range(1, 32))
        ->capture_default_str();
    command->add_option("--frames", job.frames, "timed for each resolution")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--camera", options.camera,
                        "azimuth,elevation[,distance factor]; degrees; default: a scene's own, 35,24 for a model");
    command->add_option("--light", options.light,
                        "azimuth,elevation; degrees; default: a scene's own, -50,48 for a model");
    command->add_option("--show", options.show, "the lit scene, or visibility alone")
        ->check(CLI::IsMember({"colour", "visibility"}))
        ->capture_default_str();
    command->add_flag(
        "--truth", job.truth,
        "also draw a converged reference (pcss: trace rays to the light) and measure the error against it");
    command->add_option("--out", job.out, "PNG; for several resolutions NAME-4096.png and so on")->required();
    command->add_option("--stats", job.stats, "JSON file for sizes, times and errors");
    command->add_flag("--json", options.json, "print the statistics as JSON");
    command->callback([&options] { draw_image(options); });
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    stairstep::SizeOptions size;
    stairstep::ImageOptions image;
    CLI::App app("Shadow maps no larger than a person can see.", "stairstep-render");
    app.require_subcommand(1);
    stairstep::add_size_command(app, size);
    stairstep::add_image_command(app, image);
    stairstep::add_bench_command(app);
    stairstep::add_scaling_command(app);
    stairstep::add_stress_command(app);
    return stairstep::run_program(app, argc, argv);
}
