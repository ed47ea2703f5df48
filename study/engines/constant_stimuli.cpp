#include "study/engines/constant_stimuli.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

constexpr size_t kMostLevels = 10'000;
constexpr int kMostRepetitions = 100'000;

}  // namespace

ConstantStimuli::ConstantStimuli(const ConstantStimuliSettings& settings)
    : settings_(settings), posterior_(settings.posterior) {
    const std::vector<double>& levels = settings.levels;
    if (levels.empty() || levels.size() > kMostLevels ||
        !std::all_of(levels.begin(), levels.end(), [](double level) { return std::isfinite(level); })) {
        throw InputError("constant stimuli's levels", "must be finite numbers, at least one and at most 10,000",
                         "compare the settings with study/engines/constant_stimuli.h");
    }
    if (settings.repetitions < 1 || settings.repetitions > kMostRepetitions) {
        throw InputError("constant stimuli's repetitions", "must lie in 1 to 100,000", "use for example 10");
    }
}

double ConstantStimuli::suggest() const {
    const size_t count = settings_.levels.size();
    const size_t trial = static_cast<size_t>(trials());
    std::vector<double> block = settings_.levels;
    Random random = Random(settings_.seed).stream(trial / count);
    random.shuffle(std::span(block));
    return settings_.posterior.guess + block[trial % count];
}

int ConstantStimuli::planned_trials() const {
    return static_cast<int>(settings_.levels.size()) * settings_.repetitions;
}

}  // namespace stairstep
