// The engines of one round, whose tracks run interleaved: either an engine of its own for each track, where chance decides
// which track comes next, or one that looks at all tracks together and decides for itself.
//
// A value, as the engines are. To add an engine: its own file, a place in these lists, and its settings in engine_json.cpp.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "stimuli/random.h"
#include "study/engines/constant_stimuli.h"
#include "study/engines/law_directed.h"
#include "study/engines/psi_marginal.h"
#include "study/engines/quest.h"
#include "study/engines/staircase.h"

namespace stairstep {

/// Least expected entropy for a known shape: psi-marginal with nothing but the threshold to learn.
struct MinimumEntropySettings {
    /// Prior, shape and grid of the posterior.
    QuestSettings posterior{};
};

/// What makes the engines of a round.
using EngineSettings = std::variant<QuestSettings, MinimumEntropySettings, PsiMarginalSettings, StaircaseSettings,
                                    ConstantStimuliSettings, LawDirectedSettings>;

/// Where the engine's prior of T has its middle, log10 units.
double& guess_of(EngineSettings& settings);

/// Prior and psychometric function of an engine that takes the function's shape for known; null where it learns it.
const QuestSettings* known_shape_model(const EngineSettings& settings);

/// Where the next trial goes.
struct Placement {
    size_t track = 0;
    /// log10 units.
    double intensity = 0;
};

class RoundEngine {
  public:
    /// tracks ≥ 1. `seed` is for engines whose order of trials is drawn beforehand. Throws InputError naming a setting that
    /// is out of its range.
    RoundEngine(const EngineSettings& settings, size_t tracks, uint64_t seed);

    /// The next trial of one of the open tracks, of which there must be one: open[k] says whether track k goes on. `random`
    /// serves engines that leave the choice of the track to chance.
    Placement suggest(const std::vector<bool>& open, Random random) const;

    /// Takes in an answer given at a finite intensity, log10 units.
    void update(size_t track, double intensity, bool correct);

    /// Whether an answer in one track changes the estimates of others.
    bool shares_evidence() const { return std::holds_alternative<LawDirected>(engines_); }

    ThresholdEstimate estimate(size_t track) const;
    int trials(size_t track) const;

  private:
    /// Engines that look after one track each.
    using TrackEngine = std::variant<Quest, PsiMarginal, Staircase, ConstantStimuli>;
    using Engines = std::variant<std::vector<TrackEngine>, LawDirected>;

    static TrackEngine track_engine(const EngineSettings& settings, uint64_t seed);
    static Engines engines_of(const EngineSettings& settings, size_t tracks, uint64_t seed);

    Engines engines_;
};

}  // namespace stairstep
