#include "analysis/coverage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

PlantedStudy usual_study(const Design& design) {
    PlantedStudy study;
    study.design = design;
    study.design.patterns = {Pattern::step};
    study.design.contrasts = {1};
    return study;
}

/// One study's estimates by every method; none where no law could be fitted.
std::vector<SlopeEstimate> estimates_of(const PlantedStudy& study, uint64_t seed, const CoverageSettings& settings) {
    LawFitOptions options;
    options.bootstrap = {.replicates = settings.replicates, .seed = seed, .jobs = 1};
    try {
        return fit_law(simulate_study(study, seed), settings.p_threshold, "simulated", options)
            .law.conditions[0]
            .estimates;
    } catch (const FailureError&) {
        return {};
    }
}

MethodCoverage count(const std::string& method, const std::vector<std::vector<SlopeEstimate>>& studies, double truth) {
    MethodCoverage result{.method = method};
    int held = 0;
    double sum = 0, squares = 0, widths = 0;
    for (const std::vector<SlopeEstimate>& estimates : studies) {
        const auto estimate = std::find_if(estimates.begin(), estimates.end(),
                                           [&](const SlopeEstimate& candidate) { return candidate.name == method; });
        if (estimate == estimates.end()) continue;
        ++result.studies;
        held += estimate->ci95.first <= truth && truth <= estimate->ci95.second;
        const double error = std::log(estimate->value / truth);
        sum += error;
        squares += error * error;
        // An interval on the linear scale may reach below 0: it is as wide as from there to a hundredth of its end.
        widths += std::log(estimate->ci95.second / std::max(estimate->ci95.first, 0.01 * estimate->ci95.second));
    }
    if (result.studies == 0) return result;
    const double n = result.studies;
    result.coverage = held / n;
    result.coverage_se = std::sqrt(result.coverage * (1 - result.coverage) / n);
    result.bias = sum / n;
    result.sd = n > 1 ? std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1))) : 0;
    result.bias_se = result.sd / std::sqrt(n);
    result.width = widths / n;
    return result;
}

}  // namespace

bool MethodCoverage::is_on_target() const {
    return coverage + 2 * coverage_se >= 0.93 && coverage - 2 * coverage_se <= 0.97;
}

std::vector<MethodCoverage> count_coverage(const std::vector<std::vector<SlopeEstimate>>& studies, double true_slope) {
    std::vector<std::string> methods;
    for (const std::vector<SlopeEstimate>& estimates : studies) {
        for (const SlopeEstimate& estimate : estimates) {
            if (std::find(methods.begin(), methods.end(), estimate.name) == methods.end()) {
                methods.push_back(estimate.name);
            }
        }
    }
    std::vector<MethodCoverage> result;
    for (const std::string& method : methods) result.push_back(count(method, studies, true_slope));
    return result;
}

std::vector<CoverageCell> usual_cells(const Design& design) {
    std::vector<CoverageCell> cells{{"usual study", usual_study(design)}};
    const auto add = [&](const char* name, auto change) {
        PlantedStudy study = usual_study(design);
        change(study);
        cells.push_back({name, study});
    };
    add("5 observers", [](PlantedStudy& s) { s.observers = 5; });
    add("20 observers", [](PlantedStudy& s) { s.observers = 20; });
    add("between-observer SD .05", [](PlantedStudy& s) { s.population.between_observer_sd = 0.05; });
    add("between-observer SD .30", [](PlantedStudy& s) { s.population.between_observer_sd = 0.3; });
    add("lapses .05", [](PlantedStudy& s) { s.population.shape.delta = 0.05; });
    add("beta 2", [](PlantedStudy& s) { s.population.shape.beta = 2; });
    add("beta 5", [](PlantedStudy& s) { s.population.shape.beta = 5; });
    add("sizes 10, 20", [](PlantedStudy& s) { s.design.texels_px = {10, 20}; });
    add("20 trials a track", [](PlantedStudy& s) { s.design.stop = {10, 20, {}}; });
    add("thresholds deviate by 10 %", [](PlantedStudy& s) { s.population.deviation_sd = 0.1; });
    add("biased yes/no, .2", [](PlantedStudy& s) { s.population.response_bias = 0.2; });
    return cells;
}

CellCoverage coverage_of(const CoverageCell& cell, const CoverageSettings& settings,
                         const std::function<void()>& done) {
    assert(settings.studies >= 2);
    std::vector<std::vector<SlopeEstimate>> studies(static_cast<size_t>(settings.studies));
    run_in_parallel(studies.size(), settings.jobs, [&](size_t i) {
        studies[i] = estimates_of(cell.study, Random(settings.seed).stream(i).bits() >> 1, settings);
        done();
    });
    CellCoverage result{cell.name, count_coverage(studies, cell.study.true_slope(Pattern::step, 1)), 0};
    for (const std::vector<SlopeEstimate>& estimates : studies) result.failed += estimates.empty();
    return result;
}

}  // namespace stairstep
