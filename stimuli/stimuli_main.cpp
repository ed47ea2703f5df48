// stairstep-stimuli: writes a grid of stimuli as images with a manifest.
#include <CLI/CLI.hpp>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include "renderer/stimulus_source.h"
#include "stimuli/error.h"
#include "stimuli/grid.h"
#include "stimuli/io/contact_sheet.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/manifest.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// The command line as given.
struct Options {
    std::string patterns = "step,stair,line";
    std::string texels = "5,10,20,30";
    std::string radii = "0,5,10,20,35,50,70,105";
    std::string kernels = "box";
    std::string contrasts = "1,0.5";
    std::string size = "640x480";
    std::string step_reference = "sloped";
    std::string source = "exact";
    std::string out;
    std::string contact_sheet;
    int jobs = 0;
};

Pattern pattern_named(const std::string& text) {
    for (const Pattern pattern : {Pattern::step, Pattern::stair, Pattern::line}) {
        if (name(pattern) == text) return pattern;
    }
    throw InputError("--pattern", "\"" + text + "\" is no pattern", "use step, stair or line");
}

KernelShape kernel_named(const std::string& text) {
    if (const auto shape = kernel_shape_named(text)) return *shape;
    throw InputError("--kernel", "\"" + text + "\" is no kernel", "use box");
}

void parse_size(const std::string& text, StimulusGrid& grid) {
    const std::vector<std::string> sides = split(text, 'x');
    const auto width = sides.size() == 2 ? parse_number(sides[0]) : std::nullopt;
    const auto height = sides.size() == 2 ? parse_number(sides[1]) : std::nullopt;
    const auto is_side = [](double side) {
        return side >= 1 && side <= kLargestSide && side == static_cast<int>(side);
    };
    if (!width || !height || !is_side(*width) || !is_side(*height)) {
        throw InputError("--size", "\"" + text + "\" is no image size",
                         "write WIDTHxHEIGHT, each 1 to 16384, as 640x480");
    }
    grid.width_px = static_cast<int>(*width);
    grid.height_px = static_cast<int>(*height);
}

StimulusGrid grid_of(const Options& options) {
    StimulusGrid grid;
    grid.patterns.clear();
    for (const std::string& text : split(options.patterns, ',')) grid.patterns.push_back(pattern_named(text));
    grid.kernels.clear();
    for (const std::string& text : split(options.kernels, ',')) grid.kernels.push_back(kernel_named(text));
    grid.texels_px = parse_number_list(options.texels, "--texel");
    grid.radii_px = parse_number_list(options.radii, "--radius");
    grid.contrasts = parse_number_list(options.contrasts, "--contrast");
    grid.step_reference = options.step_reference == "horizontal" ? StepReference::horizontal : StepReference::sloped;
    parse_size(options.size, grid);
    return grid;
}

StimulusSource source_named(const std::string& text) {
    return text == "shadow-map" ? shadow_map_source() : StimulusSource(luminance);
}

void write_stimulus(const fs::path& folder, const Stimulus& stimulus, const StimulusSource& source) {
    const std::vector<double> pixels = source(stimulus);
    Image image(stimulus.width_px, stimulus.height_px, 1);
    std::transform(pixels.begin(), pixels.end(), image.pixels.begin(),
                   [](double value) { return static_cast<uint8_t>(level_8bit(value)); });
    write_png(folder / image_file_name(stimulus), image,
              {{"ImageDescription", file_stem(stimulus)}, {"Software", "Stairstep " STAIRSTEP_VERSION}});
}

/// Runs task(0 … count − 1) on `jobs` threads; the first exception ends all and is thrown on.
void run_in_parallel(size_t count, int jobs, const std::function<void(size_t)>& task) {
    std::atomic<size_t> next = 0;
    std::mutex guard;
    std::exception_ptr failure;
    const auto work = [&] {
        for (size_t i; (i = next++) < count;) {
            try {
                task(i);
            } catch (...) {
                const std::scoped_lock lock(guard);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 1; i < jobs; ++i) threads.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

void generate(const Options& options) {
    const std::vector<Stimulus> stimuli = stimuli_of(grid_of(options));
    const fs::path folder = options.out;
    make_output_folder(folder);

    const StimulusSource source = source_named(options.source);
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    Progress progress("writing stimuli", static_cast<long>(stimuli.size()));
    run_in_parallel(stimuli.size(), options.jobs > 0 ? options.jobs : cores, [&](size_t i) {
        write_stimulus(folder, stimuli[i], source);
        progress.advance();
    });
    if (!options.contact_sheet.empty()) write_png(options.contact_sheet, contact_sheet(stimuli));
    // The manifest comes last: where it is, every image it names is.
    write_manifest(folder / "stimuli.csv", stimuli, options.source);
    std::cout << "wrote " << stimuli.size() << " stimuli and stimuli.csv to " << folder.string() << "\n";
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    stairstep::Options options;
    CLI::App app("Writes filtered shadow edges as images: every combination of the lists below, with stimuli.csv.",
                 "stairstep-stimuli");
    app.add_option("--pattern", options.patterns, "of step, stair, line")->capture_default_str();
    app.add_option("--texel", options.texels, "texel sizes on screen, px: 5,10 or 5:5:30")->capture_default_str();
    app.add_option("--radius", options.radii, "filter radii, px; 0 is unfiltered")->capture_default_str();
    app.add_option("--kernel", options.kernels, "of box")->capture_default_str();
    app.add_option("--contrast", options.contrasts, "lit luminance above a black shadow, (0, 1]")
        ->capture_default_str();
    app.add_option("--size", options.size, "image size, px")->capture_default_str();
    app.add_option("--reference", options.step_reference, "how the line of a step runs")
        ->check(CLI::IsMember({"sloped", "horizontal"}))
        ->capture_default_str();
    app.add_option("--source", options.source, "how artifacts are made: closed forms, or a shadow map in OpenGL")
        ->check(CLI::IsMember({"exact", "shadow-map"}))
        ->capture_default_str();
    app.add_option("--format", "image format")->check(CLI::IsMember({"png"}))->default_str("png");
    app.add_option("--bits", "bits a channel")->check(CLI::IsMember({"8"}))->default_str("8");
    app.add_option("--transfer", "from luminance to pixel value")
        ->check(CLI::IsMember({"linear"}))
        ->default_str("linear");
    app.add_option("--out", options.out, "folder for the images and stimuli.csv")->required();
    app.add_option("--contact-sheet", options.contact_sheet, "also draw all artifacts into this one PNG");
    app.add_option("--jobs", options.jobs, "threads; 0 is one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.callback([&options] { stairstep::generate(options); });
    return stairstep::run_program(app, argc, argv);
}
