#include "study/bench/accuracy.h"

#include <algorithm>
#include <map>

#include "stimuli/io/progress.h"
#include "study/engines/constant_stimuli.h"
#include "study/engines/psi_marginal.h"
#include "study/engines/psychtoolbox_quest.h"
#include "study/engines/quest.h"
#include "study/engines/staircase.h"

namespace stairstep {
namespace {

constexpr const char* kMinimumEntropy = "minimum entropy";
constexpr const char* kPsiMarginal = "psi-marginal";
constexpr const char* kQuest = "Quest";

/// Minimum entropy's RMSE in another implementation, by the number of trials.
const std::map<int, double> kMinimumEntropyRmse{{20, 0.105}, {40, 0.0536}, {60, 0.0381}};
constexpr double kCoverageBar = 0.92;

template <AdaptiveEngine E>
BenchMethod method(const std::string& name, const E& fresh, int every = 1) {
    return {name, [fresh](const TrackSimulation& simulation) { return simulate_tracks(fresh, simulation); }, every};
}

BenchMethod quest_method(const std::string& name, QuestPlacement placement) {
    QuestSettings settings;
    settings.placement = placement;
    return method(name, Quest(settings));
}

BenchMethod staircase_method(const std::string& name, int down_after) {
    StaircaseSettings settings;
    settings.down_after = down_after;
    return method(name, Staircase(settings));
}

BenchMethod constant_stimuli_method() {
    // The order of its levels is a seed's; one for all runs is one more fixed design.
    return method("constant stimuli", ConstantStimuli(ConstantStimuliSettings{}));
}

BenchMethod minimum_entropy_method() {
    return method(kMinimumEntropy, PsiMarginal(minimum_entropy_settings(QuestSettings{})));
}

BenchMethod psi_marginal_method() {
    return method(kPsiMarginal, PsiMarginal(PsiMarginalSettings{}), 5);
}

TrackSimulation simulation_of(const AccuracySettings& settings, const BenchMethod& method) {
    TrackSimulation simulation;
    simulation.runs = std::max(20, settings.runs / method.every);
    simulation.seed = settings.seed;
    simulation.jobs = settings.jobs;
    return simulation;
}

/// An observer that is not what the engines expect: β 3.5, δ .01 and no bias.
struct Mismatch {
    double beta;
    double delta;
    double bias;
};

std::vector<Mismatch> mismatches() {
    std::vector<Mismatch> all;
    for (const double beta : {1.3, 2.0, 3.5, 5.0}) {
        for (const double delta : {0.01, 0.05}) all.push_back({beta, delta, 0});
    }
    all.push_back({3.5, 0.01, 0.2});
    all.push_back({2, 0.05, 0.2});
    return all;
}

}  // namespace

std::vector<BenchMethod> bench_methods() {
    return {method("Psychtoolbox, quantile", PsychtoolboxQuest({.guess = 0, .guess_sd = 0.5, .range = 5})),
            quest_method("Quest, quantile", QuestPlacement::quantile),
            quest_method("Quest, mode", QuestPlacement::mode),
            quest_method("Quest, mean", QuestPlacement::mean),
            quest_method("Quest, most informative", QuestPlacement::most_informative),
            minimum_entropy_method(),
            psi_marginal_method(),
            staircase_method("staircase, 2 down 1 up", 2),
            staircase_method("staircase, 3 down 1 up", 3),
            constant_stimuli_method()};
}

double fisher_bound(const PsychometricShape& shape, double guess_sd, int trials) {
    return 1 / std::sqrt(trials * largest_information(shape) + 1 / (guess_sd * guess_sd));
}

BenchTable measure_accuracy(const AccuracySettings& settings) {
    BenchTable table{.name = "accuracy",
                     .title = "Accuracy of a threshold, log10 units",
                     .columns = {"method", "trials", "runs", "rmse", "rmse_se", "bias", "bias_se", "robust_sd", "bound",
                                 "rmse_over_bound"}};
    const std::vector<BenchMethod> methods = bench_methods();
    Progress progress("measuring accuracy, methods", static_cast<long>(methods.size()));
    for (const BenchMethod& method : methods) {
        const TrackSimulation simulation = simulation_of(settings, method);
        const auto results = method.simulate(simulation);
        for (size_t c = 0; c < results.size(); ++c) {
            const int trials = simulation.checkpoints[c];
            const double bound = fisher_bound(simulation.observer, simulation.guess_sd, trials);
            const ErrorSummary s = summarise(results[c]);
            BenchRow row{{method.name,
                          trials,
                          s.runs,
                          {s.rmse, 4},
                          {s.rmse_se, 4},
                          {s.bias, 4},
                          {s.bias_se, 4},
                          {s.robust_sd, 4},
                          {bound, 4},
                          {s.rmse / bound, 2}}};
            if (method.name == kMinimumEntropy) row.bar = at_most(s.rmse, kMinimumEntropyRmse.at(trials), 4, s.rmse_se);
            table.rows.push_back(std::move(row));
        }
        progress.advance();
    }
    table.notes = {
        "rmse is the SD of the estimates about the true T ~ N(guess, 0.5), for prior SD 0.5, beta 3.5, gamma 0.5, "
        "delta "
        "0.01; robust_sd is 1.4826 times the median absolute error.",
        "Psychtoolbox is the engine PsychtoolboxQuest, which gives the same numbers to 1e-9.",
        "bound is the least that n trials allow, 1/sqrt(n I + 1/0.25) with I = 17.789 the largest information of a "
        "trial.",
        "Errors have heavy tails: an early lapse or lucky guesses mislead a whole track, and few of them make up most "
        "of rmse. Run r meets the same observer and the same luck with every method, so that differences between "
        "methods are surer than rmse_se says.",
        "psi-marginal knows neither slope nor lapse rate, and does the first fifth of the runs. Constant stimuli cover "
        "guess +- 0.45 and staircases start 0.4 above it, wherever T is.",
        "The bar is what minimum entropy came to in another implementation over 2,000 runs, whose own standard errors "
        "are at least twice these."};
    return table;
}

BenchTable measure_coverage(const AccuracySettings& settings) {
    BenchTable table{.name = "coverage",
                     .title = "What 95 % intervals cover",
                     .columns = {"method", "beta", "delta", "bias", "trials", "runs", "coverage", "coverage_se",
                                 "threshold_bias", "rmse"}};
    std::vector<BenchMethod> methods{quest_method(kQuest, QuestPlacement::most_informative), minimum_entropy_method(),
                                     psi_marginal_method()};
    const std::vector<Mismatch> all = mismatches();
    Progress progress("measuring coverage, observers", static_cast<long>(methods.size() * all.size()));
    for (BenchMethod& method : methods) {
        method.every = 20;
        for (const Mismatch& mismatch : all) {
            TrackSimulation simulation = simulation_of(settings, method);
            simulation.observer.beta = mismatch.beta;
            simulation.observer.delta = mismatch.delta;
            simulation.response_bias = mismatch.bias;
            simulation.checkpoints = {40, 60};
            const auto results = method.simulate(simulation);
            for (size_t c = 0; c < results.size(); ++c) {
                const ErrorSummary s = summarise(results[c]);
                BenchRow row{{method.name,
                              {mismatch.beta, 1},
                              {mismatch.delta, 2},
                              {mismatch.bias, 1},
                              simulation.checkpoints[c],
                              s.runs,
                              {s.coverage, 3},
                              {s.coverage_se, 3},
                              {s.bias, 4},
                              {s.rmse, 4}}};
                if (method.name == kPsiMarginal && mismatch.beta >= 2)
                    row.bar = at_least(s.coverage, kCoverageBar, 2, s.coverage_se);
                table.rows.push_back(std::move(row));
            }
            progress.advance();
        }
    }
    table.notes = {
        "beta, delta and bias are the observer's. Quest and minimum entropy take beta 3.5 and delta 0.01 for granted; "
        "psi-marginal learns slope and lapse rate.",
        "An observer with bias b who sees nothing says \"artifact\" with probability 1/2 + b; half the trials are "
        "lines, in "
        "decks of four, so that guesses are right half the time all the same."};
    return table;
}

}  // namespace stairstep
