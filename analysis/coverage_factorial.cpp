#include "analysis/coverage_factorial.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "analysis/condition_fit.h"
#include "analysis/law_fit.h"
#include "stimuli/error.h"
#include "stimuli/parallel.h"
#include "study/engines/round_engine.h"

namespace stairstep {
namespace {

/// What one study has to say about one cell.
struct StudyOutcome {
    std::vector<SlopeEstimate> estimates;
    int tracks = 0;
    int unbounded = 0;
    bool warned = false;
};

/// The part of a study that a cell is about.
SlopeData part_of(const std::vector<std::vector<Threshold>>& by_observer, int observers,
                  const std::vector<double>& texels_px, StudyOutcome& outcome) {
    SlopeData data;
    for (int j = 0; j < observers; ++j) {
        std::vector<Threshold> kept;
        for (const Threshold& t : by_observer[static_cast<size_t>(j)]) {
            if (std::find(texels_px.begin(), texels_px.end(), t.condition.texel_px) == texels_px.end()) continue;
            ++outcome.tracks;
            outcome.unbounded += !t.bounded;
            if (t.bounded) kept.push_back(t);
        }
        if (const auto slope = observer_slope(kept)) {
            data.observers.push_back(*slope);
            data.thresholds.push_back(kept);
        }
    }
    return data;
}

StudyOutcome outcome_of(const std::vector<std::vector<Threshold>>& by_observer, int observers,
                        const std::vector<double>& texels_px, const BootstrapSettings& bootstrap) {
    StudyOutcome outcome;
    const SlopeData data = part_of(by_observer, observers, texels_px, outcome);
    if (data.observers.size() < 2) return outcome;
    for (const SlopeMethod method : kSlopeMethods) {
        if (needs_bootstrap(method) && bootstrap.replicates == 0) continue;
        outcome.estimates.push_back(slope_estimate(method, data, bootstrap));
    }
    std::vector<Effect> effects;
    for (const ObserverSlope& o : data.observers) effects.push_back({o.ln_slope, o.ln_slope_se});
    const SlopeMethod method = LawFitOptions{}.method;
    const auto estimate = std::find_if(outcome.estimates.begin(), outcome.estimates.end(),
                                       [&](const SlopeEstimate& e) { return e.name == name(method); });
    outcome.warned = !interval_warning(method, *estimate, estimate_random_effects(effects).weight).empty();
    return outcome;
}

std::vector<std::vector<Threshold>> thresholds_by_observer(const PlantedStudy& study, uint64_t seed,
                                                           double p_threshold) {
    std::vector<std::vector<Threshold>> by_observer;
    std::string last;
    for (const Track& track : tracks_of(simulate_study(study, seed))) {
        if (by_observer.empty() || track.observer != last) by_observer.emplace_back();
        last = track.observer;
        by_observer.back().push_back(fit_threshold(track, p_threshold));
    }
    return by_observer;
}

}  // namespace

std::vector<FactorialPopulation> factorial_populations(FactorialShare share) {
    constexpr double kSds[]{0.05, 0.16, 0.3};
    constexpr double kLapses[]{0.02, 0.05};
    constexpr double kBetas[]{2, 3.5, 5};
    std::vector<FactorialPopulation> populations;
    for (size_t l = 0; l < std::size(kLapses); ++l) {
        for (size_t s = 0; s < std::size(kSds); ++s) {
            for (size_t b = 0; b < std::size(kBetas); ++b) {
                // A Latin square's diagonals: one for each lapse rate.
                if (share == FactorialShare::third && b != (s + l) % std::size(kBetas)) continue;
                populations.push_back({kSds[s], kLapses[l], kBetas[b]});
            }
        }
    }
    return populations;
}

const std::vector<std::vector<double>>& factorial_sizes_px() {
    static const std::vector<std::vector<double>> sizes{{10, 20}, {5, 10, 20, 30}};
    return sizes;
}

PlantedStudy factorial_study(const FactorialPopulation& population, const Design& design) {
    PlantedStudy study;
    study.design = design;
    study.design.patterns = {Pattern::step};
    study.design.contrasts = {1};
    study.design.texels_px = factorial_sizes_px().back();
    study.observers = *std::max_element(std::begin(kFactorialObservers), std::end(kFactorialObservers));
    study.population.between_observer_sd = population.between_observer_sd;
    study.population.shape.delta = population.lapse;
    study.population.shape.beta = population.beta;
    return study;
}

std::vector<FactorialCell> factorial_coverage(const FactorialPopulation& population, const Design& design,
                                              const FactorialSettings& settings, const std::function<void()>& done) {
    assert(settings.studies >= 2);
    if (RoundEngine(engine_settings(design), 2, 1).shares_evidence()) {
        throw InputError("--design", "its engine's tracks share what they learn, so that no part of a study is a study",
                         "use --cells usual");
    }
    std::vector<FactorialCell> cells;
    for (const int observers : kFactorialObservers) {
        for (const std::vector<double>& texels_px : factorial_sizes_px()) {
            cells.push_back({population, observers, texels_px, {}, 0, 0, 0});
        }
    }
    const PlantedStudy study = factorial_study(population, design);
    // Each population its own luck, whichever others are simulated.
    const std::vector<FactorialPopulation> all = factorial_populations(FactorialShare::all);
    const auto place = std::find(all.begin(), all.end(), population);
    const Random random = Random(settings.seed).stream(static_cast<uint64_t>(place - all.begin()));
    const size_t studies = static_cast<size_t>(settings.studies);
    std::vector<std::vector<StudyOutcome>> outcomes(cells.size(), std::vector<StudyOutcome>(studies));
    run_in_parallel(studies, settings.jobs, [&](size_t i) {
        const uint64_t seed = random.stream(i).bits() >> 1;
        const auto by_observer = thresholds_by_observer(study, seed, settings.p_threshold);
        const BootstrapSettings bootstrap{
            .replicates = i < static_cast<size_t>(settings.bootstrap_studies) ? settings.replicates : 0,
            .seed = seed >> 10,
            .jobs = 1};
        for (size_t c = 0; c < cells.size(); ++c) {
            outcomes[c][i] = outcome_of(by_observer, cells[c].observers, cells[c].texels_px, bootstrap);
        }
        done();
    });
    for (size_t c = 0; c < cells.size(); ++c) {
        std::vector<std::vector<SlopeEstimate>> estimates;
        double tracks = 0;
        for (StudyOutcome& outcome : outcomes[c]) {
            cells[c].failed += outcome.estimates.empty();
            cells[c].unbounded += outcome.unbounded;
            cells[c].warned += outcome.warned / static_cast<double>(settings.studies);
            tracks += outcome.tracks;
            estimates.push_back(std::move(outcome.estimates));
        }
        cells[c].unbounded /= tracks;
        cells[c].methods = count_coverage(estimates, study.true_slope(Pattern::step, 1));
    }
    return cells;
}

}  // namespace stairstep
