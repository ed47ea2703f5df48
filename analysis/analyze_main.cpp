// stairstep-analyze: fits the law to a study's trials and reports it.
#include <CLI/CLI.hpp>
#include <iostream>
#include <set>

#include "analysis/commands/commands.h"
#include "analysis/figures.h"
#include "analysis/law_fit.h"
#include "analysis/law_table.h"
#include "analysis/report.h"
#include "analysis/result_csv.h"
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

/// What the report's table of texels compares.
const std::vector<double> kReportedProbabilities{0.75, 0.82, 0.9};

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

void print_warnings(const LawFit& fit) {
    for (const std::string& warning : fit.warnings) std::cerr << "warning: " << warning << "\n";
}

/// "0.75,0.82": criteria, the first of which is the law's.
std::vector<double> probabilities_of(const std::string& text) {
    const std::vector<double> p_thresholds = parse_number_list(text, "--p");
    if (p_thresholds.empty() || p_thresholds.size() > 20)
        throw InputError("--p", "lists no or too many shares", "use 0.82");
    for (const double p : p_thresholds) {
        if (!(p >= 0.55 && p <= 0.9)) {
            throw InputError("--p", format_number(p) + " is out of range", "use shares of 0.55 to 0.9");
        }
    }
    return p_thresholds;
}

void fit_to_file(const std::string& trials_path, const std::string& criteria, const LawFitOptions& options,
                 const std::string& out, bool as_json) {
    const std::vector<double> p_thresholds = probabilities_of(criteria);
    const StudyData study = read_study(trials_path);
    LawFit fit = fit_law(study.trials, p_thresholds.front(), study.source, options);
    if (p_thresholds.size() > 1) fit.law.criteria = fit_criteria(study.trials, p_thresholds, study.source, options);
    print_warnings(fit);
    write_law(out, fit.law);
    if (as_json) {
        std::cout << read_file(out);
    } else {
        std::cout << law_table(fit.law) << "wrote " << out << "\n";
    }
}

void write_report(const std::string& trials_path, const std::string& criterion, ReportInputs inputs,
                  const std::string& folder) {
    const double p_threshold = probabilities_of(criterion).front();
    const StudyData study = read_study(trials_path);
    LawFit fit = fit_law(study.trials, p_threshold, study.source);
    fit.law.criteria = fit_criteria(study.trials, kReportedProbabilities, study.source);
    inputs.observer_kind = study.observer_kind;
    const std::string html = report_html(study.trials, fit, inputs);
    const std::filesystem::path out(folder);
    make_output_folder(out);
    write_file(out / "law.svg", law_figure(fit));
    write_file(out / "convergence.svg", convergence_figure(study.trials, fit));
    write_file(out / "thresholds.csv", thresholds_csv(fit));
    write_file(out / "law.csv", law_csv(fit.law));
    write_file(out / "report.html", html);
    std::cout << "wrote " << (out / "report.html").string()
              << ", its figures (law.svg, convergence.svg) and their data "
              << "(thresholds.csv, law.csv)\n";
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    using namespace stairstep;
    CLI::App app("Fits the law r = c·a to a study and reports it.", "stairstep-analyze");
    app.require_subcommand(1);

    std::string trials;
    std::string out;
    std::string p_thresholds = format_number(kDefaultProbability);
    LawFitOptions options{.bootstrap = {.replicates = 2000, .jobs = 0}};
    std::string method(name(options.method));
    bool as_json = false;
    const auto add_common = [&](CLI::App* command) {
        command->add_option("trials", trials, "trials.csv or study.sqlite")->required();
        command
            ->add_option(
                "--p", p_thresholds,
                "share of right answers that defines a threshold, 0.55 to 0.9; fit takes a list and compares its laws, "
                "the first of which it writes")
            ->capture_default_str();
    };

    auto* fit_command = app.add_subcommand("fit", "Fit thresholds and the law, write law.json.");
    add_common(fit_command);
    fit_command->add_option("--out", out, "the law file")->required();
    fit_command->add_flag("--json", as_json, "print the law file, which has every estimate");
    std::vector<std::string> methods;
    for (const SlopeMethod m : kSlopeMethods) methods.emplace_back(name(m));
    fit_command->add_option("--method", method, "how the law's slope and interval are made")
        ->check(CLI::IsMember(methods))
        ->capture_default_str();
    fit_command->add_flag("--robust", options.robust, "let wild thresholds and observers count less (Huber)");
    fit_command->add_option("--bootstrap", options.bootstrap.replicates, "number of replicates, 0 for none")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    fit_command->add_option("--seed", options.bootstrap.seed, "of replicates and of the worst case's interval")
        ->capture_default_str();
    fit_command->add_option("--jobs", options.bootstrap.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    fit_command->callback([&] {
        options.method = *slope_method_named(method);
        fit_to_file(trials, p_thresholds, options, out, as_json);
    });

    ReportInputs inputs;
    auto* report_command = app.add_subcommand("report", "Write one self-contained report.html.");
    add_common(report_command);
    report_command->add_option("--out", out, "folder for report.html")->required();
    report_command->add_option("--contact-sheet", inputs.contact_sheet, "PNG to show, from stairstep-stimuli");
    report_command->add_option("--renderings", inputs.render_stats, "stats.json to show, from stairstep-render");
    report_command->callback([&] { write_report(trials, p_thresholds, inputs, out); });

    add_coverage_command(app);
    add_power_command(app);

    return run_program(app, argc, argv);
}
