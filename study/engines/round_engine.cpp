#include "study/engines/round_engine.h"

namespace stairstep {

RoundEngine::RoundEngine(const EngineSettings& settings, size_t tracks) {
    const TrackEngine engine = std::visit([](const auto& s) -> TrackEngine { return Quest(s); }, settings);
    tracks_.assign(tracks, engine);
}

Placement RoundEngine::suggest(const std::vector<bool>& open, Random random) const {
    std::vector<size_t> candidates;
    for (size_t track = 0; track < open.size(); ++track) {
        if (open[track]) candidates.push_back(track);
    }
    const size_t track = candidates[random.below(candidates.size())];
    return {track, std::visit([](const auto& engine) { return engine.suggest(); }, tracks_[track])};
}

void RoundEngine::update(size_t track, double intensity, bool correct) {
    std::visit([&](auto& engine) { engine.update(intensity, correct); }, tracks_[track]);
}

Estimate RoundEngine::estimate(size_t track) const {
    return std::visit([](const auto& engine) { return engine.estimate(); }, tracks_[track]);
}

int RoundEngine::trials(size_t track) const {
    return std::visit([](const auto& engine) { return engine.trials(); }, tracks_[track]);
}

}  // namespace stairstep
