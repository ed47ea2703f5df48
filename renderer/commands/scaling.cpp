// `stairstep-render scaling`.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "renderer/commands/commands.h"
#include "renderer/commands/picture_size.h"
#include "renderer/scaling/scaling_job.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

struct Options {
    std::string out;
    std::optional<std::string> axes;
    bool quick = false;
    std::optional<std::string> size;
    std::optional<int> frames;
    std::string context = "osmesa";
    bool json = false;
};

scaling::ScalingJob job_of(const Options& options) {
    scaling::ScalingJob job = options.quick ? scaling::quick_job() : scaling::ScalingJob{};
    if (options.axes) {
        job.axes.clear();
        for (const std::string& name : split(*options.axes, ',')) {
            job.axes.push_back(scaling::axis_named(name));
            if (options.quick) job.axes.back().values = job.axes.back().quick_values;
        }
    }
    if (options.size) std::tie(job.scenario.width, job.scenario.height) = picture_size_of("--size", *options.size);
    if (options.frames) job.frames = *options.frames;
    job.context = gl::context_kind_named(options.context);
    job.out = options.out;
    return job;
}

}  // namespace

void add_scaling_command(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "scaling", "Measures how the cost of shadow techniques grows with triangles, pixels, radius and lights.");
    command->add_option("--out", options->out, "folder for scaling.csv, index.html and figures")->required();
    std::string names;
    for (const scaling::Axis& axis : scaling::axes()) names += (names.empty() ? "" : ",") + axis.name;
    command->add_option("--axes", options->axes, "what grows; default: " + names);
    command->add_flag("--quick", options->quick, "fewer and smaller values, fewer techniques: a minute or two");
    command->add_option("--size", options->size,
                        "of the picture, px, where it isn't what grows; default: 1280x720, quick: 640x360");
    command->add_option("--frames", options->frames, "timed of each technique at each value; default: 10, quick: 3")
        ->check(CLI::Range(1, 10000));
    command->add_option("--context", options->context, "osmesa (no display), egl (no display, GPU) or window")
        ->capture_default_str();
    command->add_flag("--json", options->json, "print JSON");
    command->callback([options] {
        const nlohmann::ordered_json result = scaling::run_scaling(job_of(*options));
        std::cout << (options->json ? result.dump(2) + "\n" : scaling::summary_of(result));
    });
}

}  // namespace stairstep
