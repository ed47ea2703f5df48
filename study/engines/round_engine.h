// The engines of one round, whose tracks run interleaved: either an engine of its own for each track, where chance decides
// which track comes next, or one that looks at all tracks together and decides for itself.
//
// A value, as the engines are. To add an engine: its own file, a place in these lists, and its settings in design_json.cpp.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "stimuli/random.h"
#include "study/engines/quest.h"

namespace stairstep {

/// Engines that look after one track each.
using TrackEngine = std::variant<Quest>;

/// What makes the engines of a round.
using EngineSettings = std::variant<QuestSettings>;

/// Where the next trial goes.
struct Placement {
    size_t track = 0;
    /// log10 units.
    double intensity = 0;
};

class RoundEngine {
  public:
    /// tracks ≥ 1. Throws InputError naming a setting that is out of its range.
    RoundEngine(const EngineSettings& settings, size_t tracks);

    /// The next trial of one of the open tracks, of which there must be one: open[k] says whether track k goes on. `random`
    /// serves engines that leave the choice of the track to chance.
    Placement suggest(const std::vector<bool>& open, Random random) const;

    /// Takes in an answer given at a finite intensity, log10 units.
    void update(size_t track, double intensity, bool correct);

    /// Whether an answer in one track changes the estimates of others.
    bool shares_evidence() const { return false; }

    Estimate estimate(size_t track) const;
    int trials(size_t track) const;

  private:
    std::vector<TrackEngine> tracks_;
};

}  // namespace stairstep
