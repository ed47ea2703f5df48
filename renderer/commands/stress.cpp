// `stairstep-render stress`.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "renderer/commands/commands.h"
#include "renderer/commands/picture_size.h"
#include "renderer/stress/stress_job.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

struct Options {
    std::string out;
    std::string techniques = "hard,pcf,pcss,vsm,esm";
    std::string size;
    std::string only;
    std::string context = "osmesa";
    bool quick = false;
    bool long_run = false;
    bool no_courses = false;
    bool json = false;
};

stress::StressJob job_of(const Options& options) {
    stress::StressJob job;
    job.techniques = split(options.techniques, ',');
    job.quick = options.quick;
    job.long_run = options.long_run;
    job.courses = !options.no_courses;
    if (!options.only.empty()) job.only = split(options.only, ';');
    const std::string size = !options.size.empty() ? options.size : options.quick ? "160x90" : "320x180";
    std::tie(job.measurement.width, job.measurement.height) = picture_size_of("--size", size);
    job.context = gl::context_kind_named(options.context);
    job.out = options.out;
    return job;
}

}  // namespace

void add_stress_command(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "stress", "Puts shadow techniques under extreme conditions: error, NaN, GL errors, acne, detachment.");
    command->add_option("--out", options->out, "folder for stress.csv, stress.md and index.html")->required();
    command->add_option("--techniques", options->techniques, "at the law's sizes")->capture_default_str();
    command->add_flag("--quick", options->quick, "fewer conditions, short courses, smaller pictures");
    command->add_flag("--long", options->long_run, "animate for 100,000 frames, not 2,000");
    command->add_flag("--no-courses", options->no_courses, "leave out the changes of size and the animation");
    command->add_option("--only", options->only, "kinds of conditions, \"frames;spot\"; default: all");
    command->add_option("--size", options->size, "of the picture, px; default: 320x180, quick: 160x90");
    command->add_option("--context", options->context, "osmesa (no display), egl (no display, GPU) or window")
        ->capture_default_str();
    command->add_flag("--json", options->json, "print JSON");
    command->callback([options] {
        const nlohmann::ordered_json result = stress::run_stress(job_of(*options));
        std::cout << (options->json ? result.dump(2) + "\n" : stress::summary_of(result));
    });
}

}  // namespace stairstep
