// stairstep-stimuli: writes a grid of stimuli as images with a manifest, and checks such a folder.
#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/law/law_file.h"
#include "renderer/stimulus_source.h"
#include "stimuli/contour.h"
#include "stimuli/error.h"
#include "stimuli/grid.h"
#include "stimuli/io/batch.h"
#include "stimuli/io/contact_sheet.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/io/reference_report.h"
#include "stimuli/io/transfer_file.h"
#include "stimuli/io/verification.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Of a contact sheet where --contours gives no number.
constexpr int kUsualContours = 5;

/// The command line as given.
struct Options {
    std::string patterns = "step,stair,line";
    std::string texels = "5,10,20,30";
    std::string radii = "0,5,10,20,35,50,70,105";
    std::string kernels = "box";
    std::string contrasts = "1,0.5";
    std::string phases = "0:0";
    Kernel poisson{KernelShape::poisson};
    std::string size = "640x480";
    std::string step_reference = "sloped";
    std::string grid_file;
    std::string source = "exact";
    std::string format = "png";
    std::optional<int> bits;
    std::string transfer = "linear";
    std::string dither = "none";
    std::optional<double> pixels_per_degree;
    std::string out;
    std::string contact_sheet;
    /// Empty where there are to be none.
    std::string contours;
    int jobs = 0;
    std::string shard = "1/1";
    bool resume = false;
};

/// For `reference`; the grid's axes come from Options.
struct ReferenceOptions {
    Options grid = [] {
        Options options;
        options.patterns = "step,stair";
        options.radii = "0";  // what is sought
        return options;
    }();
    double largest_radius_px = 640;
    std::string law;
    std::string plot;
    bool json = false;
};

struct VerifyOptions {
    std::string folder;
    int jobs = 0;
    bool json = false;
};

/// Adds "step", "stair", "line" or "slope=0.3" to a grid.
void add_pattern(StimulusGrid& grid, const std::string& text) {
    if (text.starts_with("slope=")) {
        const auto slope = parse_number(text.substr(6));
        if (!slope) throw InputError("--pattern", "\"" + text + "\" names no slope", "write for example slope=0.3");
        if (grid.slopes.empty()) grid.patterns.push_back(Pattern::slope);
        grid.slopes.push_back(*slope);
        return;
    }
    for (const Pattern pattern : {Pattern::step, Pattern::stair, Pattern::line}) {
        if (name(pattern) == text) return grid.patterns.push_back(pattern);
    }
    throw InputError("--pattern", "\"" + text + "\" is no pattern", "use step, stair, slope=0.3 or line");
}

KernelShape kernel_named(const std::string& text) {
    if (const auto shape = kernel_shape_named(text)) return *shape;
    throw InputError("--kernel", "\"" + text + "\" is no kernel", "use box, disk, gaussian or poisson");
}

/// "0:0,0.25:0.5": pairs of texels right and up.
std::vector<Phase> parse_phases(const std::string& text) {
    std::vector<Phase> phases;
    for (const std::string& pair : split(text, ',')) {
        const std::vector<std::string> parts = split(pair, ':');
        const auto x = parts.size() == 2 ? parse_number(parts[0]) : std::nullopt;
        const auto y = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
        if (!x || !y)
            throw InputError("--phase", "\"" + pair + "\" is no phase", "write RIGHT:UP in texels, as 0.25:0.5");
        phases.push_back({*x, *y});
    }
    return phases;
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
    for (const std::string& text : split(options.patterns, ',')) add_pattern(grid, text);
    grid.kernels.clear();
    for (const std::string& text : split(options.kernels, ',')) grid.kernels.push_back(kernel_named(text));
    grid.poisson = options.poisson;
    grid.phases = parse_phases(options.phases);
    grid.texels_px = parse_number_list(options.texels, "--texel");
    grid.radii_px = parse_number_list(options.radii, "--radius");
    grid.contrasts = parse_number_list(options.contrasts, "--contrast");
    grid.step_reference = options.step_reference == "horizontal" ? StepReference::horizontal : StepReference::sloped;
    parse_size(options.size, grid);
    return grid;
}

ImageEncoding encoding_of(const Options& options) {
    ImageEncoding encoding;
    encoding.format = image_format_named(options.format).value();
    encoding.bits = options.bits.value_or(encoding.format == ImageFormat::exr ? 32 : 8);
    encoding.dither = dither_named(options.dither).value();
    require_valid(encoding);
    encoding.transfer = read_transfer(options.transfer);
    return encoding;
}

/// What `--source` and a manifest's column source name. A shadow map's GL context opens when one is first asked for.
/// Where luminances come from, by name. A value of main's: what draws must be gone before the program's statics and the
/// driver's go.
class Sources {
  public:
    LuminanceOf operator()(const std::string& source);

  private:
    /// Made by its first use.
    LuminanceOf shadow_map_;
};

LuminanceOf Sources::operator()(const std::string& source) {
    if (source == "exact") return luminance;
    if (source == "shadow-map") {
        if (!shadow_map_) shadow_map_ = shadow_map_source();
        return shadow_map_;
    }
    throw InputError("source \"" + source + "\"", "is unknown", "use exact or shadow-map");
}

std::vector<Stimulus> stimuli_of(const Options& options) {
    const StimulusGrid grid = grid_of(options);
    if (options.grid_file.empty()) return stimuli_of(grid);
    Stimulus defaults;
    defaults.width_px = grid.width_px;
    defaults.height_px = grid.height_px;
    defaults.step_reference = grid.step_reference;
    return read_grid(options.grid_file, defaults);
}

/// How many contours a contact sheet has.
int parse_contours(const std::string& text) {
    if (text.empty()) return 0;
    const auto count = parse_number(text);
    if (!count || !(*count >= 1 && *count <= kMostContours) || *count != std::floor(*count)) {
        throw InputError("--contours", "\"" + text + "\" is no number of contours",
                         "write a whole number from 1 to " + std::to_string(kMostContours) + ", or none");
    }
    return static_cast<int>(*count);
}

void generate(const Options& options) {
    const std::vector<Stimulus> stimuli = stimuli_of(options);
    const int contours = parse_contours(options.contours);
    Batch batch;
    batch.folder = options.out;
    batch.rendition = {encoding_of(options), options.source, options.pixels_per_degree};
    batch.jobs = options.jobs;
    batch.shard = parse_shard(options.shard);
    batch.resume = options.resume;
    const BatchSummary summary = write_batch(stimuli, batch, Sources()(options.source));
    if (!options.contact_sheet.empty()) write_png(options.contact_sheet, contact_sheet(stimuli, contours));
    std::cout << "wrote " << summary.written << " stimuli and " << summary.manifest << " to " << options.out;
    if (options.resume) std::cout << ", kept " << summary.kept;
    std::cout << "\n";
}

void print_json(const Verification& result) {
    nlohmann::ordered_json faults = nlohmann::ordered_json::array();
    for (const ImageFault& fault : result.faults) {
        nlohmann::ordered_json entry{{"file", fault.file}, {"problem", fault.problem}, {"pixels", fault.pixels}};
        // JSON has no infinity, the difference from a NaN.
        const bool finite = std::isfinite(fault.largest_difference);
        entry["largest_difference"] = finite ? nlohmann::ordered_json(fault.largest_difference) : nullptr;
        faults.push_back(entry);
    }
    const nlohmann::ordered_json report{
        {"images", result.images}, {"equal", result.images - result.faults.size()}, {"faults", faults}};
    std::cout << report.dump(2) << "\n";
}

void print(const Verification& result) {
    for (const ImageFault& fault : result.faults) {
        std::cout << fault.file << ": " << fault.problem;
        if (fault.pixels > 0) {
            std::cout << ", " << fault.pixels << " by up to " << format_number(fault.largest_difference);
        }
        std::cout << "\n";
    }
    std::cout << result.images - result.faults.size() << " of " << result.images << " images are as listed\n";
}

void verify(const VerifyOptions& options) {
    const Verification result = stairstep::verify(options.folder, options.jobs, Sources());
    options.json ? print_json(result) : print(result);
    if (result.faults.empty()) return;
    throw FailureError(options.folder,
                       std::to_string(result.faults.size()) + " of " + std::to_string(result.images) +
                           " images are not what stimuli.csv says",
                       "remove those and write them again with --resume");
}

std::string text_or_dash(const std::optional<double>& radius) {
    return radius ? format_fixed(*radius, 2) : "-";
}

void print_references(const std::vector<ReferenceSizes>& sizes, double largest_radius_px) {
    std::cout
        << "radius in px from which on artifact and line differ nowhere by more than 1 level, 1/2 level, not at all\n"
        << "after rounding to 8 bits; - is not reached up to " << format_number(largest_radius_px) << " px\n";
    for (const ReferenceSizes& s : sizes) {
        const Stimulus& a = s.artifact;
        std::cout << "  " << name(a.pattern) << (a.pattern == Pattern::slope ? " " + format_number(a.slope) : "")
                  << ", " << name(a.kernel.shape) << ", contrast " << format_number(a.contrast)
                  << ", a = " << format_number(a.texel_px) << " px:  " << text_or_dash(s.one_level) << "  "
                  << text_or_dash(s.half_level) << "  " << text_or_dash(s.identical) << "\n";
    }
}

void print_references_json(const std::vector<ReferenceSizes>& sizes, double largest_radius_px) {
    const auto number = [](const std::optional<double>& radius) {
        return radius ? nlohmann::ordered_json(*radius) : nlohmann::ordered_json(nullptr);
    };
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ReferenceSizes& s : sizes) {
        rows.push_back({{"pattern", name(s.artifact.pattern)},
                        {"slope", s.artifact.slope},
                        {"kernel", name(s.artifact.kernel.shape)},
                        {"contrast", s.artifact.contrast},
                        {"texel_px", s.artifact.texel_px},
                        {"one_level_px", number(s.one_level)},
                        {"half_level_px", number(s.half_level)},
                        {"identical_px", number(s.identical)}});
    }
    std::cout << nlohmann::ordered_json{{"largest_radius_px", largest_radius_px}, {"sizes", rows}}.dump(2) << "\n";
}

std::vector<StudyLaw> laws_of(const std::string& path) {
    if (path.empty()) return {};
    const Law law = law_named(path);
    if (law.conditions.empty()) return {{law.pattern, law.contrast, law.kernel, law.slope}};
    std::vector<StudyLaw> laws;
    for (const ConditionLaw& c : law.conditions) laws.push_back({c.pattern, c.contrast, c.kernel, c.slope});
    return laws;
}

void find_references(const ReferenceOptions& options) {
    if (!(options.largest_radius_px > 0 && options.largest_radius_px <= 1e6)) {
        throw InputError("--largest " + format_number(options.largest_radius_px), "must be above 0 and up to 10^6 px",
                         "use for example 640");
    }
    const std::vector<StudyLaw> laws = laws_of(options.law);
    const std::vector<Stimulus> artifacts = stimuli_of(grid_of(options.grid));
    const auto sizes = reference_sizes(artifacts, options.largest_radius_px, options.grid.jobs);
    if (!options.grid.out.empty()) write_file(options.grid.out, reference_csv(sizes, options.largest_radius_px));
    if (!options.plot.empty()) write_file(options.plot, reference_figure(sizes, laws));
    options.json ? print_references_json(sizes, options.largest_radius_px)
                 : print_references(sizes, options.largest_radius_px);
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    using namespace stairstep;
    Options options;
    CLI::App app("Writes filtered shadow edges as images: every combination of the lists below, with stimuli.csv.",
                 "stairstep-stimuli");
    const std::vector<CLI::Option*> axes{
        app.add_option("--pattern", options.patterns, "of step, stair, slope=M (any silhouette y = M x), line")
            ->capture_default_str(),
        app.add_option("--texel", options.texels, "texel sizes on screen, px: 5,10 or 5:5:30")->capture_default_str(),
        app.add_option("--radius", options.radii, "filter radii, px; 0 is unfiltered")->capture_default_str(),
        app.add_option("--kernel", options.kernels, "of box, disk, gaussian, poisson")->capture_default_str(),
        app.add_option("--contrast", options.contrasts, "lit luminance above a black shadow, (0, 1]")
            ->capture_default_str(),
        app.add_option("--phase", options.phases, "where the texel grid lies: RIGHT:UP in texels, as 0:0,0.25:0.5")
            ->capture_default_str(),
        app.add_option("--taps", options.poisson.taps, "of poisson")->capture_default_str(),
        app.add_option("--seed", options.poisson.seed, "of poisson: which set of taps")
            ->check(CLI::Range(0, 2000000000))
            ->capture_default_str(),
        app.add_flag("--rotated", options.poisson.rotated,
                     "poisson: each pixel turns the taps by an angle of its own")};
    CLI::Option* grid =
        app.add_option("--grid", options.grid_file,
                       "instead of those lists a CSV file, one row a stimulus, columns as in stimuli.csv");
    for (CLI::Option* axis : axes) grid->excludes(axis);
    app.add_option("--size", options.size, "image size, px")->capture_default_str();
    app.add_option("--reference", options.step_reference, "how the line of a step runs")
        ->check(CLI::IsMember({"sloped", "horizontal"}))
        ->capture_default_str();
    app.add_option("--source", options.source, "exact (closed forms) or shadow-map (drawn by one, with OSMesa)")
        ->check(CLI::IsMember({"exact", "shadow-map"}))
        ->capture_default_str();
    app.add_option("--format", options.format, "image format")
        ->check(CLI::IsMember({"png", "tif", "exr"}))
        ->capture_default_str();
    app.add_option("--bits", options.bits, "bits a pixel: 8 or 16, for exr 32; default 8 and 32")
        ->check(CLI::IsMember({8, 16, 32}));
    app.add_option("--transfer", options.transfer,
                   "from luminance to stored value: linear, srgb, gamma=2.2 or a CSV file with level,luminance")
        ->capture_default_str();
    app.add_option("--dither", options.dither, "for gradients finer than a level")
        ->check(CLI::IsMember({"none", "ordered", "error-diffusion"}))
        ->capture_default_str();
    app.add_option("--pixels-per-degree", options.pixels_per_degree,
                   "viewing geometry, recorded in images and stimuli.csv");
    app.add_option("--out", options.out, "folder for the images and stimuli.csv; required");
    CLI::Option* contact_sheet =
        app.add_option("--contact-sheet", options.contact_sheet, "also draw all artifacts into this one PNG");
    CLI::Option* contours =
        app.add_option("--contours", options.contours,
                       "how many iso-contours of visibility to draw on the contact sheet, 5 if no number is given: the "
                       "artifact's over those of its line")
            ->expected(0, 1)
            ->type_name("[N]")
            ->needs(contact_sheet);
    app.add_option("--jobs", options.jobs, "threads; 0 is one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--shard", options.shard, "i/n: write part i of n alone, with a manifest stimuli.i-of-n.csv");
    app.add_flag("--resume", options.resume, "keep images that are there already, as described");

    VerifyOptions verify_options;
    CLI::App* verify_command = app.add_subcommand("verify", "Derives every image of a folder again and compares.");
    verify_command->add_option("folder", verify_options.folder, "with images and stimuli.csv")->required();
    verify_command->add_option("--jobs", verify_options.jobs, "threads; 0 is one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    verify_command->add_flag("--json", verify_options.json, "print the result as JSON");
    ReferenceOptions reference;
    CLI::App* reference_command =
        app.add_subcommand("reference", "Finds the radius from which on a sampled edge looks exactly like its line.");
    reference_command->add_option("--pattern", reference.grid.patterns, "of step, stair, slope=M")
        ->capture_default_str();
    reference_command->add_option("--texel", reference.grid.texels, "texel sizes on screen, px")->capture_default_str();
    reference_command->add_option("--kernel", reference.grid.kernels, "of box, disk, gaussian, poisson")
        ->capture_default_str();
    reference_command->add_option("--contrast", reference.grid.contrasts, "lit luminance, (0, 1]")
        ->capture_default_str();
    reference_command->add_option("--size", reference.grid.size, "of the pictures compared, px")->capture_default_str();
    reference_command->add_option("--reference", reference.grid.step_reference, "how the line of a step runs")
        ->check(CLI::IsMember({"sloped", "horizontal"}))
        ->capture_default_str();
    reference_command->add_option("--largest", reference.largest_radius_px, "radius up to which to look, px")
        ->capture_default_str();
    reference_command->add_option("--out", reference.grid.out, "also write the table as CSV");
    reference_command->add_option("--plot", reference.plot, "also draw it as SVG");
    reference_command->add_option("--law", reference.law, "a study's law.json, or kreuzer2017, to draw beside it");
    reference_command->add_option("--jobs", reference.grid.jobs, "threads; 0 is one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    reference_command->add_flag("--json", reference.json, "print the table as JSON");
    reference_command->callback([&] { find_references(reference); });

    // A flag that says what to write says nothing here.
    for (CLI::App* command : {verify_command, reference_command}) {
        for (CLI::Option* option : app.get_options()) {
            if (option != app.get_help_ptr()) command->excludes(option);
        }
    }
    verify_command->callback([&] { verify(verify_options); });

    app.callback([&] {
        if (!app.get_subcommands().empty()) return;
        if (options.out.empty()) throw CLI::RequiredError("--out");
        if (contours->count() > 0 && options.contours.empty()) options.contours = std::to_string(kUsualContours);
        generate(options);
    });
    return run_program(app, argc, argv);
}
