#include "study/engines/law_directed_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "stimuli/error.h"
#include "stimuli/parallel.h"
#include "stimuli/random.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

constexpr size_t kFolds = 20;
constexpr double kNormal95 = 1.959964;

/// Where a method's estimate lies after a trial, and its 95 % interval, relative to the truth.
struct Deviation {
    double error = 0;
    bool is_covered = false;
};

/// One entry a trial, for each method.
using Run = std::array<std::vector<Deviation>, kGainMethods>;

void require_valid(const GainSettings& s) {
    const auto require = [](bool holds, const char* subject, const char* problem) {
        if (!holds) throw InputError(subject, problem, "compare the settings with study/engines/law_directed_gain.h");
    };
    require(is_valid(s.observer), "simulated observer's psychometric shape", "is not valid");
    require(s.true_deviation_sd >= 0 && std::isfinite(s.true_deviation_sd), "true deviation SD",
            "must be a finite number of at least 0");
    require(!s.checkpoints.empty() && s.checkpoints.front() >= 1 &&
                std::is_sorted(s.checkpoints.begin(), s.checkpoints.end(), std::less_equal<>()),
            "checkpoints", "must be numbers of trials above 0, ascending");
    require(s.runs >= static_cast<int>(kFolds), "runs", "must be at least 20");
}

Deviation deviation(const ThresholdEstimate& estimate, double truth) {
    return {estimate.threshold - truth, estimate.low <= truth && truth <= estimate.high};
}

ThresholdEstimate with_normal_interval(double mean, double sd) {
    return {mean, sd, mean - kNormal95 * sd, mean + kNormal95 * sd};
}

ThresholdEstimate weighted(const std::vector<Quest>& quests, double deviation_sd) {
    double weights = 0, sum = 0;
    for (const Quest& quest : quests) {
        const double weight = 1 / (deviation_sd * deviation_sd + quest.sd() * quest.sd());
        weights += weight;
        sum += weight * quest.mean();
    }
    return with_normal_interval(sum / weights, 1 / std::sqrt(weights));
}

ThresholdEstimate unweighted(const std::vector<Quest>& quests, double deviation_sd) {
    const auto count = static_cast<double>(quests.size());
    double sum = 0, variance = 0;
    for (const Quest& quest : quests) {
        sum += quest.mean();
        variance += deviation_sd * deviation_sd + quest.sd() * quest.sd();
    }
    return with_normal_interval(sum / count, std::sqrt(variance) / count);
}

/// The law and the thresholds one simulated observer has, and the chance of a right answer.
struct Truth {
    double law;
    std::vector<double> thresholds;
    PsychometricShape shape;
    double offset;

    bool answer(size_t track, double intensity, Random& random) const {
        return random.uniform() < probability_correct(shape, offset, intensity, thresholds[track]);
    }
};

Run simulate_run(const GainSettings& s, const LawDirected& fresh, Random random) {
    Random traits = random.stream(0);
    Truth truth{s.engine.guess + s.engine.guess_sd * traits.normal(), {}, s.observer, threshold_offset(s.observer)};
    for (int k = 0; k < s.engine.tracks; ++k) {
        truth.thresholds.push_back(truth.law + s.true_deviation_sd * traits.normal());
    }
    const auto tracks = static_cast<uint64_t>(s.engine.tracks);
    const int trials = s.checkpoints.back();
    Run run;
    const auto note = [&](GainMethod method, const ThresholdEstimate& estimate) {
        run[static_cast<size_t>(method)].push_back(deviation(estimate, truth.law));
    };

    // The n-th trial's luck is the same for all methods, a lapse above all, and so is the random track: what differs between
    // methods is what they do.
    LawDirected directed = fresh;
    Random answers = random.stream(1);
    for (int trial = 0; trial < trials; ++trial) {
        const auto [track, x] = directed.suggest();
        directed.update(track, x, truth.answer(static_cast<size_t>(track), x, answers));
        note(GainMethod::law_directed, directed.estimate());
    }

    LawDirected shared = fresh;
    const double placement = most_informative_offset({});
    answers = random.stream(1);
    Random order = random.stream(2);
    for (int trial = 0; trial < trials; ++trial) {
        const uint64_t track = order.below(tracks);
        const double x = shared.track_estimate(static_cast<int>(track)).threshold + placement;
        shared.update(static_cast<int>(track), x, truth.answer(track, x, answers));
        note(GainMethod::shared_placement, shared.estimate());
    }

    LawDirected pooled = fresh;
    std::vector<Quest> quests(tracks, Quest({.guess = s.engine.guess,
                                             .guess_sd = s.engine.guess_sd,
                                             .grain = s.engine.grain,
                                             .range = s.engine.range}));
    answers = random.stream(1);
    order = random.stream(2);
    for (int trial = 0; trial < trials; ++trial) {
        const uint64_t track = order.below(tracks);
        const double x = quests[track].suggest();
        const bool correct = truth.answer(track, x, answers);
        quests[track].update(x, correct);
        pooled.update(static_cast<int>(track), x, correct);
        note(GainMethod::quest_hierarchical, pooled.estimate());
        note(GainMethod::quest_weighted, weighted(quests, s.engine.deviation_sd));
        note(GainMethod::quest_mean, unweighted(quests, s.engine.deviation_sd));
    }
    return run;
}

GainRow row(const std::vector<Run>& runs, GainMethod method, int trials) {
    const auto count = static_cast<double>(runs.size());
    double sum = 0, squares = 0, fourths = 0, covered = 0;
    for (const Run& run : runs) {
        const Deviation& d = run[static_cast<size_t>(method)][static_cast<size_t>(trials - 1)];
        const double square = d.error * d.error;
        sum += d.error;
        squares += square;
        fourths += square * square;
        covered += d.is_covered;
    }
    GainRow row{.method = method, .trials = trials};
    const double mean_square = squares / count;
    row.bias = sum / count;
    row.bias_se = std::sqrt(std::max(0.0, mean_square - row.bias * row.bias) / (count - 1));
    row.rmse = std::sqrt(mean_square);
    // The delta method: SE of the mean square over 2·RMSE.
    const double mean_square_se = std::sqrt(std::max(0.0, fourths / count - mean_square * mean_square) / (count - 1));
    row.rmse_se = row.rmse > 0 ? mean_square_se / (2 * row.rmse) : 0;
    row.coverage = covered / count;
    row.coverage_se = std::sqrt(row.coverage * (1 - row.coverage) / count);
    return row;
}

/// Mean square errors after each number of trials, the runs of one fold left out (kFolds: none).
std::vector<double> mean_squares(const std::vector<Run>& runs, GainMethod method, size_t left_out) {
    std::vector<double> squares(runs.front()[0].size());
    for (size_t r = 0; r < runs.size(); ++r) {
        if (r % kFolds == left_out) continue;
        const std::vector<Deviation>& deviations = runs[r][static_cast<size_t>(method)];
        for (size_t t = 0; t < squares.size(); ++t) squares[t] += deviations[t].error * deviations[t].error;
    }
    const size_t left = left_out < kFolds ? (runs.size() - left_out + kFolds - 1) / kFolds : 0;
    for (double& square : squares) square /= static_cast<double>(runs.size() - left);
    return squares;
}

/// The number of trials from which on the error stays at or below `goal`, interpolated; nothing if it never does.
std::optional<double> trials_for(const std::vector<double>& squares, double goal) {
    if (squares.back() > goal) return std::nullopt;
    size_t t = squares.size() - 1;
    while (t > 0 && squares[t - 1] <= goal) --t;
    if (t == 0) return 1.0;
    return static_cast<double>(t) + (squares[t - 1] - goal) / (squares[t - 1] - squares[t]);
}

GainRatio ratio(const std::vector<Run>& runs, GainMethod method, int trials) {
    const auto without = [&](size_t fold) -> std::optional<double> {
        const double goal = mean_squares(runs, GainMethod::law_directed, fold)[static_cast<size_t>(trials - 1)];
        const std::optional<double> needed = trials_for(mean_squares(runs, method, fold), goal);
        if (!needed) return std::nullopt;
        return *needed / trials;
    };
    GainRatio result{.method = method, .trials = trials, .ratio = without(kFolds)};
    std::vector<double> folds;
    for (size_t fold = 0; fold < kFolds; ++fold) {
        if (const std::optional<double> value = without(fold)) folds.push_back(*value);
    }
    if (folds.empty()) return result;
    double mean = 0, spread = 0;
    for (const double value : folds) mean += value / static_cast<double>(folds.size());
    for (const double value : folds) spread += (value - mean) * (value - mean);
    result.ratio_se = std::sqrt(spread * static_cast<double>(kFolds - 1) / static_cast<double>(folds.size()));
    return result;
}

}  // namespace

const char* to_string(GainMethod method) {
    switch (method) {
        case GainMethod::law_directed: return "law-directed";
        case GainMethod::shared_placement: return "shared-placement";
        case GainMethod::quest_hierarchical: return "quest-hierarchical";
        case GainMethod::quest_weighted: return "quest-weighted";
        case GainMethod::quest_mean: return "quest-mean";
    }
    return "";
}

GainTable simulate_gain(const GainSettings& settings) {
    require_valid(settings);
    const LawDirected fresh(settings.engine);
    std::vector<Run> runs(static_cast<size_t>(settings.runs));
    run_in_parallel(runs.size(), settings.jobs,
                    [&](size_t r) { runs[r] = simulate_run(settings, fresh, Random(settings.seed).stream(r)); });

    GainTable table;
    for (const int trials : settings.checkpoints) {
        for (int m = 0; m < kGainMethods; ++m) table.rows.push_back(row(runs, static_cast<GainMethod>(m), trials));
    }
    for (const int trials : settings.checkpoints) {
        if (trials == settings.checkpoints.back()) break;
        for (int m = 1; m < kGainMethods; ++m) table.ratios.push_back(ratio(runs, static_cast<GainMethod>(m), trials));
    }
    return table;
}

}  // namespace stairstep
