#include "study/engines/round_engine.h"

#include <algorithm>
#include <memory>

namespace stairstep {

double& guess_of(EngineSettings& settings) {
    return std::visit(
        [](auto& s) -> double& {
            if constexpr (requires { s.posterior; }) {
                return s.posterior.guess;
            } else {
                return s.guess;
            }
        },
        settings);
}

const QuestSettings* known_shape_model(const EngineSettings& settings) {
    return std::visit(
        [](const auto& s) -> const QuestSettings* {
            if constexpr (requires { s.posterior; }) {
                return &s.posterior;
            } else if constexpr (std::is_same_v<decltype(s), const QuestSettings&>) {
                return &s;
            } else {
                return nullptr;
            }
        },
        settings);
}

RoundEngine::TrackEngine RoundEngine::track_engine(const EngineSettings& settings, uint64_t seed) {
    if (const auto* s = std::get_if<QuestSettings>(&settings)) return Quest(*s);
    if (const auto* s = std::get_if<MinimumEntropySettings>(&settings)) {
        return PsiMarginal(minimum_entropy_settings(s->posterior));
    }
    if (const auto* s = std::get_if<PsiMarginalSettings>(&settings)) return PsiMarginal(*s);
    if (const auto* s = std::get_if<StaircaseSettings>(&settings)) return Staircase(*s);
    ConstantStimuliSettings constant = std::get<ConstantStimuliSettings>(settings);
    constant.seed = seed;
    return ConstantStimuli(constant);
}

RoundEngine::Engines RoundEngine::engines_of(const EngineSettings& settings, size_t tracks, uint64_t seed) {
    if (const auto* s = std::get_if<LawDirectedSettings>(&settings)) {
        LawDirectedSettings together = *s;
        together.tracks = static_cast<int>(tracks);
        return LawDirected(together);
    }
    std::vector<TrackEngine> engines;
    if (std::holds_alternative<ConstantStimuliSettings>(settings)) {
        // An order of its own for each track.
        for (size_t k = 0; k < tracks; ++k) engines.push_back(track_engine(settings, Random(seed).stream(k).bits()));
    } else {
        engines.assign(tracks, track_engine(settings, seed));  // copies share tables
    }
    return engines;
}

RoundEngine::RoundEngine(const EngineSettings& settings, size_t tracks, uint64_t seed)
    : engines_(engines_of(settings, tracks, seed)) {}

Placement RoundEngine::suggest(const std::vector<bool>& open, Random random) const {
    if (const auto* together = std::get_if<LawDirected>(&engines_)) {
        const auto flags = std::make_unique<bool[]>(open.size());
        std::copy(open.begin(), open.end(), flags.get());
        const auto next = together->suggest(std::span<const bool>(flags.get(), open.size()));
        return {static_cast<size_t>(next.track), next.intensity};
    }
    std::vector<size_t> candidates;
    for (size_t track = 0; track < open.size(); ++track) {
        if (open[track]) candidates.push_back(track);
    }
    const size_t track = candidates[random.below(candidates.size())];
    const TrackEngine& engine = std::get<std::vector<TrackEngine>>(engines_)[track];
    return {track, std::visit([](const auto& e) { return e.suggest(); }, engine)};
}

void RoundEngine::update(size_t track, double intensity, bool correct) {
    if (auto* together = std::get_if<LawDirected>(&engines_)) {
        together->update(static_cast<int>(track), intensity, correct);
        return;
    }
    TrackEngine& engine = std::get<std::vector<TrackEngine>>(engines_)[track];
    std::visit([&](auto& e) { e.update(intensity, correct); }, engine);
}

ThresholdEstimate RoundEngine::estimate(size_t track) const {
    if (const auto* together = std::get_if<LawDirected>(&engines_)) {
        return together->track_estimate(static_cast<int>(track));
    }
    return std::visit([](const auto& e) { return e.estimate(); }, std::get<std::vector<TrackEngine>>(engines_)[track]);
}

int RoundEngine::trials(size_t track) const {
    if (const auto* together = std::get_if<LawDirected>(&engines_)) return together->trials(static_cast<int>(track));
    return std::visit([](const auto& e) { return e.trials(); }, std::get<std::vector<TrackEngine>>(engines_)[track]);
}

}  // namespace stairstep
