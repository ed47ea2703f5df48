// stairstep-analyze: fits the law to a study's trials and reports it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "analysis/commands/commands.h"
#include "analysis/law_fit.h"
#include "analysis/law_table.h"
#include "analysis/report.h"
#include "analysis/study_check.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/number.h"
#include "study/design_json.h"
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
    /// What a table of trials doesn't tell is left out.
    StudyBackground background;
};

/// "simulated", "person", or a mix of them.
std::string observer_kind_of(const std::vector<SessionRecord>& sessions) {
    std::set<std::string> kinds;
    for (const SessionRecord& session : sessions) kinds.insert(session.observer_kind);
    std::string text;
    for (const std::string& kind : kinds) text += (text.empty() ? "" : " and ") + kind;
    return text;
}

/// The design that a database has, if it is one that this program reads: a study can be analysed without.
std::optional<Design> design_of(const TrialStore& store, const std::string& path) {
    try {
        return design_from_json(store.design_json(), path);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

StudyData read_study(const std::string& path) {
    StudyData study;
    study.source = std::filesystem::path(path).filename().string();
    std::vector<Trial> recorded;
    if (path.ends_with(".csv")) {
        recorded = read_trials_csv(path);
    } else {
        const TrialStore store = TrialStore::open(path);
        recorded = store.trials();
        const std::vector<SessionRecord> sessions = store.sessions();
        study.background.observer_kind = observer_kind_of(sessions);
        study.background.design = design_of(store, path);
        for (const SessionRecord& session : sessions) study.background.seeds.push_back(session.seed);
        study.source += " (" + study.background.observer_kind + " observers)";
    }
    for (const Trial& trial : recorded) {
        study.background.practice_trials += !trial.is_void && trial.kind == TrialKind::practice;
        study.background.catch_trials += !trial.is_void && trial.kind == TrialKind::attention;
        study.background.void_trials += trial.is_void;
    }
    study.trials = evidence(std::move(recorded));
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

/// Of --p's criteria, the one that --out-p names, or the first.
double criterion_of_law(const std::vector<double>& p_thresholds, const std::optional<double>& chosen) {
    if (!chosen) return p_thresholds.front();
    if (std::find(p_thresholds.begin(), p_thresholds.end(), *chosen) == p_thresholds.end()) {
        throw InputError("--out-p", format_number(*chosen) + " is none of --p", "name one of those");
    }
    return *chosen;
}

struct FitCommand {
    std::string trials;
    std::string out;
    std::string p_thresholds = format_number(kDefaultProbability);
    std::optional<double> out_p;
    LawFitOptions law{.bootstrap = {.replicates = 2000, .jobs = 0}};
    std::string method{name(LawFitOptions{}.method)};
    int simulations = StudyCheckOptions{}.simulations;
    bool as_json = false;
};

void fit_to_file(const FitCommand& command) {
    const std::vector<double> p_thresholds = probabilities_of(command.p_thresholds);
    const double p = criterion_of_law(p_thresholds, command.out_p);
    const StudyData study = read_study(command.trials);
    LawFit fit = fit_law(study.trials, p, study.source, command.law);
    if (p_thresholds.size() > 1) {
        fit.law.criteria = fit_criteria(study.trials, p_thresholds, study.source, command.law);
    }
    print_warnings(fit);
    const StudyCheck check =
        check_study(study.trials, fit, {command.simulations, command.law.bootstrap.seed, command.law.bootstrap.jobs});
    write_law(command.out, fit.law, {{"checks", to_json(check)}});
    if (command.as_json) {
        std::cout << read_file(command.out);
    } else {
        std::cout << law_table(fit.law) << check_table(check) << "wrote " << command.out << "\n";
    }
}

void write_report(const std::string& trials_path, const std::string& criterion, ReportInputs inputs,
                  const std::string& folder) {
    const double p_threshold = probabilities_of(criterion).front();
    StudyData study = read_study(trials_path);
    LawFitOptions options;
    options.bootstrap.jobs = inputs.check.jobs;
    LawFit fit = fit_law(study.trials, p_threshold, study.source, options);
    std::vector<double> criteria = kReportedProbabilities;
    if (std::find(criteria.begin(), criteria.end(), p_threshold) == criteria.end()) {
        criteria.insert(std::upper_bound(criteria.begin(), criteria.end(), p_threshold), p_threshold);
    }
    fit.law.criteria = fit_criteria(study.trials, criteria, study.source, options);
    inputs.background = std::move(study.background);
    const Report report = make_report(study.trials, fit, inputs);
    const std::filesystem::path out(folder);
    make_output_folder(out);
    for (const auto& [name, text] : report.files) write_file(out / name, text);
    write_file(out / "report.html", report.html);
    std::cout << "wrote " << (out / "report.html").string() << " and " << report.files.size()
              << " files beside it: its figures as SVG, their data as CSV, its methods as text\n";
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    using namespace stairstep;
    CLI::App app("Fits the law r = c·a to a study and reports it.", "stairstep-analyze");
    app.require_subcommand(1);

    FitCommand fit;
    auto* fit_command = app.add_subcommand("fit", "Fit thresholds and the law, write law.json.");
    const auto add_trials = [](CLI::App* command, std::string& trials) {
        command->add_option("trials", trials, "trials.csv or study.sqlite")->required();
    };
    add_trials(fit_command, fit.trials);
    fit_command
        ->add_option("--p", fit.p_thresholds,
                     "share of right answers that defines a threshold, 0.55 to 0.9; of a list, laws are compared")
        ->capture_default_str();
    fit_command->add_option("--out-p", fit.out_p, "which of --p the law file is for; the first unless named");
    fit_command->add_option("--out", fit.out, "the law file")->required();
    fit_command->add_flag("--json", fit.as_json, "print the law file, which has every estimate");
    std::vector<std::string> methods;
    for (const SlopeMethod m : kSlopeMethods) methods.emplace_back(name(m));
    fit_command->add_option("--method", fit.method, "how the law's slope and interval are made")
        ->check(CLI::IsMember(methods))
        ->capture_default_str();
    fit_command->add_flag("--robust", fit.law.robust, "let wild thresholds and observers count less (Huber)");
    fit_command->add_option("--bootstrap", fit.law.bootstrap.replicates, "number of replicates, 0 for none")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    fit_command
        ->add_option("--simulations", fit.simulations, "of each observer's answers, for goodness of fit; 0 for none")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    fit_command
        ->add_option("--seed", fit.law.bootstrap.seed, "of replicates, simulations and the worst case's interval")
        ->capture_default_str();
    fit_command->add_option("--jobs", fit.law.bootstrap.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    fit_command->callback([&] {
        fit.law.method = *slope_method_named(fit.method);
        fit_to_file(fit);
    });

    ReportInputs inputs;
    std::string report_trials, report_out;
    std::string report_p = format_number(kDefaultProbability);
    auto* report_command = app.add_subcommand(
        "report", "Write one self-contained report.html, and its figures and tables as SVG and CSV.");
    add_trials(report_command, report_trials);
    report_command->add_option("--p", report_p, "share of right answers that defines a threshold, 0.55 to 0.9")
        ->capture_default_str();
    report_command->add_option("--out", report_out, "folder for report.html")->required();
    report_command->add_option("--contact-sheet", inputs.contact_sheet, "PNG to show, from stairstep-stimuli");
    report_command->add_option("--renderings", inputs.render_stats, "stats.json to show, from stairstep-render");
    report_command
        ->add_option("--simulations", inputs.check.simulations,
                     "of each observer's answers, for goodness of fit; 0 for none")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    report_command->add_option("--seed", inputs.check.seed, "of the simulations")->capture_default_str();
    report_command->add_option("--jobs", inputs.check.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    report_command->callback([&] { write_report(report_trials, report_p, inputs, report_out); });

    add_coverage_command(app);
    add_power_command(app);

    return run_program(app, argc, argv);
}
