// stairstep-analyze: fits the law to a study's trials and reports it.
#include <CLI/CLI.hpp>
#include <iostream>
#include <set>

#include "analysis/law_fit.h"
#include "analysis/report.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/number.h"
#include "study/store.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

/// What thresholds mean unless --p says otherwise: the study's own criterion.
constexpr double kDefaultProbability = 0.82;

/// Trials and where they come from.
struct StudyData {
    std::vector<Trial> trials;
    std::string source;
    /// "simulated", "person", a mix of them; empty for a table, which doesn't tell.
    std::string observer_kind;
};

std::string observer_kind_of(const TrialStore& store) {
    std::set<std::string> kinds;
    for (const SessionRecord& session : store.sessions()) kinds.insert(session.observer_kind);
    std::string text;
    for (const std::string& kind : kinds) text += (text.empty() ? "" : " and ") + kind;
    return text;
}

StudyData read_study(const std::string& path) {
    StudyData study;
    study.source = std::filesystem::path(path).filename().string();
    if (path.ends_with(".csv")) {
        study.trials = evidence(read_trials_csv(path));
    } else {
        const TrialStore store = TrialStore::open(path);
        study.trials = evidence(store.trials());
        study.observer_kind = observer_kind_of(store);
        study.source += " (" + study.observer_kind + " observers)";
    }
    if (study.trials.empty()) throw InputError(path, "holds no trial", "run the study first");
    return study;
}

std::string interval_text(const Interval& interval) {
    return "[" + format_fixed(interval.first, 2) + ", " + format_fixed(interval.second, 2) + "]";
}

void print_law(const Law& law) {
    for (const ConditionLaw& c : law.conditions) {
        std::cout << "  " << name(c.pattern) << ", contrast " << format_number(c.contrast) << ", " << name(c.kernel)
                  << ": c = " << format_fixed(c.slope, 3) << " " << interval_text(c.slope_ci95) << ", intercept "
                  << format_fixed(c.intercept_px, 2) << " px " << interval_text(c.intercept_ci95) << ", exponent "
                  << format_fixed(c.exponent, 2) << " " << interval_text(c.exponent_ci95) << ", " << c.observers
                  << " observers, " << c.trials << " trials\n";
    }
    std::cout << "law: r = " << format_fixed(law.slope, 3) << " a, 95 % interval " << interval_text(law.slope_ci95)
              << " (worst case: " << name(law.pattern) << ", contrast " << format_number(law.contrast) << ")\n";
}

void print_warnings(const LawFit& fit) {
    for (const std::string& warning : fit.warnings) std::cerr << "warning: " << warning << "\n";
}

void fit_to_file(const std::string& trials_path, double p_threshold, const std::string& out, bool as_json) {
    const StudyData study = read_study(trials_path);
    const LawFit fit = fit_law(study.trials, p_threshold, study.source);
    print_warnings(fit);
    write_law(out, fit.law);
    if (as_json) {
        std::cout << read_file(out);
    } else {
        print_law(fit.law);
        std::cout << "wrote " << out << "\n";
    }
}

void write_report(const std::string& trials_path, double p_threshold, ReportInputs inputs, const std::string& folder) {
    const StudyData study = read_study(trials_path);
    const LawFit fit = fit_law(study.trials, p_threshold, study.source);
    inputs.observer_kind = study.observer_kind;
    const std::string html = report_html(study.trials, fit, inputs);
    make_output_folder(folder);
    const std::filesystem::path file = std::filesystem::path(folder) / "report.html";
    write_file(file, html);
    std::cout << "wrote " << file.string() << "\n";
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    using namespace stairstep;
    CLI::App app("Fits the law r = c·a to a study and reports it.", "stairstep-analyze");
    app.require_subcommand(1);

    std::string trials;
    std::string out;
    double p_threshold = kDefaultProbability;
    bool as_json = false;
    const auto add_common = [&](CLI::App* command) {
        command->add_option("trials", trials, "trials.csv or study.sqlite")->required();
        command->add_option("--p", p_threshold, "share of right answers that defines a threshold")
            ->check(CLI::Range(0.55, 0.9))
            ->capture_default_str();
    };

    auto* fit_command = app.add_subcommand("fit", "Fit thresholds and the law, write law.json.");
    add_common(fit_command);
    fit_command->add_option("--out", out, "the law file")->required();
    fit_command->add_flag("--json", as_json, "print the law as JSON");
    fit_command->callback([&] { fit_to_file(trials, p_threshold, out, as_json); });

    ReportInputs inputs;
    auto* report_command = app.add_subcommand("report", "Write one self-contained report.html.");
    add_common(report_command);
    report_command->add_option("--out", out, "folder for report.html")->required();
    report_command->add_option("--contact-sheet", inputs.contact_sheet, "PNG to show, from stairstep-stimuli");
    report_command->add_option("--renderings", inputs.render_stats, "stats.json to show, from stairstep-render");
    report_command->callback([&] { write_report(trials, p_threshold, inputs, out); });

    return run_program(app, argc, argv);
}
