// Many simulated tracks of one engine: how far its estimates are from the planted threshold.
//
// Each run draws T ~ N(guess, guess_sd²) and an observer with its own psychometric function, who sees what is shown with
// probability (1 − δ)(1 − e^{−u}) and else guesses, "artifact" with probability ½ + bias; half the trials are lines, in
// shuffled decks of four, as in a session. Without a bias that is Ψ of study/psychometric.h with γ = ½. Run r has the same T
// and its trial n the same luck for every engine: what differs between engines is what they do. The result depends on the seed
// alone, not on the number of threads.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "stimuli/parallel.h"
#include "stimuli/random.h"
#include "study/engines/estimate.h"
#include "study/psychometric.h"

namespace stairstep {

struct TrackSimulation {
    /// γ must be ½.
    PsychometricShape observer{};
    /// In [−½, ½].
    double response_bias = 0;
    double guess = 0;
    double guess_sd = 0.5;
    /// After how many trials the estimate is looked at: ascending, ≥ 1.
    std::vector<int> checkpoints{20, 40, 60};
    /// ≥ 2.
    int runs = 10000;
    uint64_t seed = 1;
    /// Threads, 0 for one a core.
    int jobs = 0;
};

struct TrackResult {
    /// ThresholdEstimate − T, log10 units.
    double error = 0;
    /// Whether T lies between the estimate's low and high.
    bool is_covered = false;
};

/// One simulated observer and its luck.
class TrackObserver {
  public:
    TrackObserver(const TrackSimulation& simulation, int run)
        : shape_(simulation.observer),
          offset_(threshold_offset(simulation.observer)),
          artifact_share_(0.5 + simulation.response_bias),
          random_(Random(simulation.seed).stream(static_cast<uint64_t>(run))),
          threshold_(simulation.guess + simulation.guess_sd * random_.normal()) {}

    double threshold() const { return threshold_; }

    /// Whether the next answer, at this intensity, is right.
    bool answers_correctly(double intensity) {
        if (card_ == deck_.size()) {
            card_ = 0;
            random_.shuffle(std::span<bool>(deck_));
        }
        const bool is_artifact = deck_[card_++];
        const double seen = (1 - shape_.delta) * -std::expm1(-weibull_exponent(shape_, offset_, intensity, threshold_));
        const bool sees = random_.uniform() < seen;
        const bool prefers_artifact = random_.uniform() < artifact_share_;
        return sees || prefers_artifact == is_artifact;
    }

  private:
    PsychometricShape shape_;
    double offset_;
    double artifact_share_;
    Random random_;
    double threshold_;
    std::array<bool, 4> deck_{true, true, false, false};
    size_t card_ = 4;
};

/// Results by checkpoint, then by run.
template <AdaptiveEngine E>
std::vector<std::vector<TrackResult>> simulate_tracks(const E& fresh, const TrackSimulation& simulation) {
    const auto runs = static_cast<size_t>(simulation.runs);
    std::vector<std::vector<TrackResult>> results(simulation.checkpoints.size(), std::vector<TrackResult>(runs));
    run_in_parallel(runs, simulation.jobs, [&](size_t run) {
        TrackObserver observer(simulation, static_cast<int>(run));
        E engine(fresh);
        for (size_t c = 0; c < simulation.checkpoints.size(); ++c) {
            while (engine.trials() < simulation.checkpoints[c]) {
                const double intensity = engine.suggest();
                engine.update(intensity, observer.answers_correctly(intensity));
            }
            const ThresholdEstimate e = engine.estimate();
            const double truth = observer.threshold();
            results[c][run] = {e.threshold - truth, e.low <= truth && truth <= e.high};
        }
    });
    return results;
}

/// What many errors come to, with standard errors of the simulation.
struct ErrorSummary {
    int runs = 0;
    /// √(mean square error); its SE by the delta method, SD of the squares/(√runs·2·RMSE).
    double rmse = 0;
    double rmse_se = 0;
    /// Mean error.
    double bias = 0;
    double bias_se = 0;
    /// 1.4826 × the median absolute error: the RMSE if errors were normal, and blind to a few wild ones.
    double robust_sd = 0;
    /// Share of intervals that hold T.
    double coverage = 0;
    double coverage_se = 0;
};

/// Of two results or more.
ErrorSummary summarise(std::span<const TrackResult> results);

}  // namespace stairstep
