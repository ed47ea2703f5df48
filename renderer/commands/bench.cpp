// `stairstep-render bench`.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "renderer/bench/bench_job.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/picture_size.h"
#include "renderer/truth/truth_cache.h"
#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/stimulus.h"

namespace stairstep {
namespace {

struct Options {
    std::string out;
    std::optional<std::string> scenes;
    bool quick = false;
    bool ablation = false;
    bool no_wobble = false;
    std::string size = "1280x720";
    std::optional<std::string> wobble_size;
    std::optional<int> wobble_steps;
    std::optional<int> frames;
    std::optional<int> samples;
    int jobs = 0;
    int largest_size = 8192;
    std::string law = "kreuzer2017";
    bool convert_kernel = false;
    std::optional<double> radius;
    std::string context = "osmesa";
    std::string cache;
    bool json = false;
};

bench::BenchJob job_of(const Options& options) {
    bench::BenchJob job = options.quick ? bench::quick_job() : bench::BenchJob{};
    if (options.ablation) job.configurations = bench::ablation_configurations();
    if (options.scenes) job.scenes = split(*options.scenes, ',');
    std::tie(job.measurement.width, job.measurement.height) = picture_size_of("--size", options.size);
    if (options.wobble_size) {
        std::tie(job.wobble->width, job.wobble->height) = picture_size_of("--wobble-size", *options.wobble_size);
    }
    if (options.samples) {
        const int side = static_cast<int>(std::lround(std::sqrt(*options.samples)));
        if (side * side != *options.samples) {
            throw InputError("--samples " + std::to_string(*options.samples), "is no square number",
                             "use for example 256 or 1024");
        }
        job.truth.light_samples = *options.samples;
    }
    if (options.frames) job.measurement.frames = *options.frames;
    if (options.wobble_steps) job.wobble->steps = *options.wobble_steps;
    job.measurement.largest_size = options.largest_size;
    job.truth.cache = options.cache.empty() ? default_cache_folder() : std::filesystem::path(options.cache);
    job.truth.jobs = options.jobs;
    // Many frames of small pictures: means over them need fewer samples of each.
    job.wobble->truth = job.truth;
    job.wobble->truth.light_samples = 256;
    job.wobble->truth.filter_taps = 1024;
    if (options.no_wobble) job.wobble.reset();
    job.law = options.law;
    job.convert_kernel = options.convert_kernel;
    job.radius = options.radius;
    job.context = gl::context_kind_named(options.context);
    job.out = options.out;
    return job;
}

}  // namespace

void add_bench_command(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("bench", "Measures shadow techniques: run time against error, scene by scene.");
    command->add_option("--out", options->out, "folder for bench.csv, index.html and pictures")->required();
    command->add_option("--scenes", options->scenes,
                        "names or model files; default: crane,clutter,truck,colonnade,cornell,city");
    command->add_flag("--quick", options->quick, "three scenes, few configurations, cheaper truths: about a minute");
    command->add_flag("--ablation", options->ablation, "only what each thing that frames leave out saves");
    command->add_option("--size", options->size, "of the picture, px")->capture_default_str();
    command->add_option("--frames", options->frames, "timed of each configuration; default: 10, quick: 5")
        ->check(CLI::Range(1, 10000));
    command
        ->add_option("--samples", options->samples,
                     "rays a pixel of the area light's truth, a square number; default: 1024, quick: 256")
        ->check(CLI::Range(1, 65536));
    command->add_flag("--no-wobble", options->no_wobble, "leave out what moves between frames");
    command->add_option("--wobble-size", options->wobble_size, "of its pictures, px; default: 320x180, quick: 160x90");
    command->add_option("--wobble-steps", options->wobble_steps, "of each motion; default: 8, quick: 2")
        ->check(CLI::Range(1, 200));
    command->add_option("--law", options->law, "law.json, or kreuzer2017")->capture_default_str();
    command->add_flag("--convert-kernel", options->convert_kernel, "accept a law of another kernel, by equal variance");
    command->add_option("--radius", options->radius,
                        "half-width of constant filters, world units; default: each scene's");
    command->add_option("--largest-size", options->largest_size, "most texels a side for auto")
        ->check(CLI::Range(1, kLargestSide))
        ->capture_default_str();
    command->add_option("--context", options->context, "osmesa (no display), egl (no display, GPU) or window")
        ->capture_default_str();
    command->add_option("--cache", options->cache, "folder that keeps truths; default: the user's cache folder");
    command->add_option("--jobs", options->jobs, "threads that trace, 0 for one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_flag("--json", options->json, "print JSON");
    command->callback([options] {
        const nlohmann::ordered_json result = bench::run_bench(job_of(*options));
        std::cout << (options->json ? result.dump(2) + "\n" : bench::summary_of(result));
    });
}

}  // namespace stairstep
