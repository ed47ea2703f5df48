#include "study/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "study/simulated_observer.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

std::vector<Trial> simulated_session(uint64_t seed, const Design& design = {}) {
    SimulatedObserver observer({}, Random(seed), 0);
    std::vector<Trial> trials;
    run_session(design, {"o", 0, 1, seed}, std::ref(observer), [&](const Trial& trial) { trials.push_back(trial); });
    return trials;
}

TEST(Session, GivesEveryTrackItsTrialsAndLinesOnHalfOfThem) {
    const Design design;
    std::map<int, std::vector<Trial>> tracks;
    for (const Trial& trial : simulated_session(3)) tracks[trial.track].push_back(trial);
    ASSERT_EQ(tracks.size(), 16u);
    for (const auto& [track, trials] : tracks) {
        const int count = static_cast<int>(trials.size());
        EXPECT_GE(count, design.stop.least_trials);
        EXPECT_LE(count, design.stop.most_trials);
        int lines = 0;
        for (int i = 0; i < count; ++i) {
            EXPECT_EQ(trials[i].trial, i + 1);
            EXPECT_EQ(trials[i].condition, trials[0].condition);
            lines += trials[i].stimulus == Judgement::line;
        }
        EXPECT_NEAR(lines, count / 2.0, 1);  // blocks of four, the last perhaps cut
    }
}

TEST(Session, EndsTracksOnlyWhenConvergedOrFull) {
    const Design design;
    std::map<int, std::vector<Trial>> tracks;
    for (const Trial& trial : simulated_session(4)) tracks[trial.track].push_back(trial);
    for (const auto& [track, trials] : tracks) {
        // Replaying the answers gives the posterior that the session stopped on.
        Quest quest(quest_settings(design));
        for (size_t i = 0; i < trials.size(); ++i) {
            EXPECT_NEAR(trials[i].suggested_radius_px, trials[i].condition.texel_px * std::pow(10, -quest.suggest()),
                        1e-9);
            const bool finished = quest.trials() >= design.stop.least_trials && quest.sd() <= design.stop.converged_sd;
            EXPECT_FALSE(finished) << "track " << track << " went on after trial " << i;
            quest.update(std::log10(trials[i].condition.texel_px / trials[i].radius_px), trials[i].correct());
        }
        EXPECT_TRUE(quest.sd() <= design.stop.converged_sd || quest.trials() == design.stop.most_trials);
    }
}

TEST(Session, InterleavesTheTracksOfARoundAndKeepsRoundsApart) {
    const std::vector<Trial> trials = simulated_session(5);
    int switches = 0;
    for (size_t i = 1; i < trials.size(); ++i) {
        EXPECT_GE(trials[i].round, trials[i - 1].round);
        switches += trials[i].track != trials[i - 1].track;
    }
    EXPECT_GT(switches, static_cast<int>(trials.size()) / 2);
}

TEST(Session, IsTheSameForTheSameSeedOnly) {
    EXPECT_EQ(trials_csv(simulated_session(6)), trials_csv(simulated_session(6)));
    EXPECT_NE(trials_csv(simulated_session(6)), trials_csv(simulated_session(7)));
}

TEST(Session, ShowsOnlyWhatTheDisplayCan) {
    Design design;
    design.largest_radius_px = 20;
    for (const Trial& trial : simulated_session(8, design)) {
        EXPECT_LE(trial.radius_px, 20);
        EXPECT_GE(trial.radius_px, design.smallest_radius_px);
    }
}

TEST(Session, EndsEvenWithAnObserverWhoIsNeverRight) {
    const Design design;
    int count = 0;
    run_session(
        design, {"o", 0, 1, 1},
        [](const Presentation& shown) {
            return Answer{shown.stimulus == Judgement::line ? Judgement::artifact : Judgement::line, 1, 0, 0};
        },
        [&](const Trial&) { ++count; });
    EXPECT_LE(count, 16 * design.stop.most_trials);
}

}  // namespace
}  // namespace stairstep
