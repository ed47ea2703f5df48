#include "study/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "stimuli/error.h"
#include "study/design_json.h"
#include "study/simulated_observer.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

/// Runs a session and returns its trials as they would be stored, void ones marked.
std::vector<Trial> simulated_session(uint64_t seed, const Design& design = {},
                                     const SimulatedPopulation& population = {}) {
    const SimulatedObserver observer(population, Random(seed), 0);
    std::vector<Trial> trials;
    Session session(design, {"o", 0, 1, seed});
    const SessionOutcome outcome =
        run_session(session, observer,
                    {[&](const Trial& trial) { trials.push_back(trial); },
                     [&](int presentation) { trials[static_cast<size_t>(presentation) - 1].is_void = true; }});
    EXPECT_EQ(outcome, SessionOutcome::finished);
    return trials;
}

std::map<int, std::vector<Trial>> by_track(const std::vector<Trial>& trials) {
    std::map<int, std::vector<Trial>> tracks;
    for (const Trial& trial : evidence(trials)) tracks[trial.track].push_back(trial);
    return tracks;
}

/// Everything that a session may contain.
Design full_design() {
    Design design;
    design.easy = {.practice_trials = 5, .catch_share = 0.1};
    design.break_every_trials = 50;
    design.stop.most_trials = 12;
    return design;
}

TEST(Session, GivesEveryTrackItsTrialsAndLinesOnHalfOfThem) {
    const auto tracks = by_track(simulated_session(3));
    ASSERT_EQ(tracks.size(), 16u);
    for (const auto& [track, trials] : tracks) {
        ASSERT_EQ(trials.size(), 40u);
        int lines = 0;
        for (int i = 0; i < 40; ++i) {
            EXPECT_EQ(trials[i].trial, i + 1);
            EXPECT_EQ(trials[i].condition, trials[0].condition);
            lines += trials[i].stimulus == Judgement::line;
        }
        EXPECT_EQ(lines, 20);
    }
}

TEST(Session, ShowsLinesOnTheShareAskedFor) {
    Design design;
    for (const double share : {0.05, 0.25, 0.35, 0.6}) {
        design.line_share = share;
        for (const auto& [track, trials] : by_track(simulated_session(3, design))) {
            const auto lines = std::count_if(trials.begin(), trials.end(),
                                             [](const Trial& t) { return t.stimulus == Judgement::line; });
            EXPECT_NEAR(lines, 40 * share, 1e-9) << share;
        }
    }
}

TEST(Session, EndsTracksOnlyWhenConvergedOrFull) {
    Design design;
    design.stop = {10, 100, 0.05};
    for (const auto& [track, trials] : by_track(simulated_session(4, design))) {
        // Replaying the answers gives the posterior that the session stopped on.
        Quest quest(std::get<QuestSettings>(engine_settings(design)));
        for (size_t i = 0; i < trials.size(); ++i) {
            EXPECT_NEAR(trials[i].suggested_radius_px, trials[i].condition.texel_px * std::pow(10, -quest.suggest()),
                        1e-9);
            const bool finished = quest.trials() >= 10 && quest.sd() <= 0.05;
            EXPECT_FALSE(finished) << "track " << track << " went on after trial " << i;
            quest.update(trials[i].strength(), trials[i].correct());
        }
        EXPECT_TRUE(quest.sd() <= 0.05 || quest.trials() == 100);
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
    int count = 0;
    Session session({}, {"o", 0, 1, 1});
    run_session(session,
                [](const Presentation& shown) {
                    return Answer{shown.stimulus == Judgement::line ? Judgement::artifact : Judgement::line, 1, 0, 0};
                },
                {[&](const Trial&) { ++count; }});
    EXPECT_EQ(count, 16 * 40);
}

TEST(Session, PracticesFirstAndChecksAttentionApartFromTheTracks) {
    const Design design = full_design();
    const std::vector<Trial> trials = simulated_session(9, design);
    int catches = 0;
    for (size_t i = 0; i < trials.size(); ++i) {
        EXPECT_EQ(trials[i].presentation, static_cast<int>(i) + 1);
        EXPECT_EQ(trials[i].kind == TrialKind::practice, i < 5);
        catches += trials[i].kind == TrialKind::attention;
        if (trials[i].kind != TrialKind::main) {
            EXPECT_EQ(trials[i].trial, 0);
            EXPECT_EQ(trials[i].suggested_radius_px, trials[i].condition.texel_px * 0.5);
        }
    }
    // 192 trials of tracks are nine tenths of the rounds' presentations: 21 catch trials, SD 4.9.
    EXPECT_NEAR(catches, 21, 20);
    for (const auto& [track, of_track] : by_track(trials)) EXPECT_EQ(of_track.size(), 12u);
}

TEST(Session, BreaksBeforeRoundsAndWhenTheyAreDue) {
    const Design design = full_design();
    std::vector<int> breaks;
    Session session(design, {"o", 0, 1, 2});
    const SimulatedObserver observer({}, Random(2), 0);
    int previous_round = 1;
    int since = 0;
    run_session(session, [&](const Presentation& shown) {
        const int round = session.next()->round;
        const bool due = round > previous_round || since == design.break_every_trials;
        EXPECT_EQ(shown.since_break == 0, due || shown.number == 1) << shown.number;
        since = due ? 1 : since + 1;
        previous_round = round;
        return observer(shown);
    });
}

TEST(Session, ShowsATrialAnewThatWasTakenBack) {
    SimulatedPopulation population;
    population.redo_share = 0.2;
    const std::vector<Trial> trials = simulated_session(10, full_design(), population);
    int voids = 0;
    for (const Trial& trial : trials) voids += trial.is_void;
    EXPECT_GT(voids, 10);
    for (const auto& [track, of_track] : by_track(trials)) {
        ASSERT_EQ(of_track.size(), 12u);
        for (int i = 0; i < 12; ++i) EXPECT_EQ(of_track[i].trial, i + 1);
    }
    // What was taken back teaches nothing: without it the next suggestions are the same.
    Quest quest(std::get<QuestSettings>(engine_settings(full_design())));
    for (const Trial& trial : trials) {
        if (trial.track != 1 || trial.kind != TrialKind::main) continue;
        EXPECT_NEAR(trial.suggested_radius_px, trial.condition.texel_px * std::pow(10, -quest.suggest()), 1e-9);
        if (!trial.is_void) quest.update(trial.strength(), trial.correct());
    }
}

TEST(Session, GoesOnBitForBitFromAnyPointOfItsRecord) {
    SimulatedPopulation population;
    population.redo_share = 0.1;
    population.fatigue = 0.05;
    const Design design = full_design();
    const std::vector<Trial> whole = simulated_session(11, design, population);
    const SimulatedObserver observer(population, Random(11), 0);
    for (size_t cut = 0; cut < whole.size(); cut += 7) {
        std::vector<Trial> trials(whole.begin(), whole.begin() + static_cast<long>(cut));
        Session session = resumed_session(design, {"o", 0, 1, 11}, trials, "record");
        run_session(session, observer,
                    {[&](const Trial& trial) { trials.push_back(trial); },
                     [&](int presentation) { trials[static_cast<size_t>(presentation) - 1].is_void = true; }});
        ASSERT_EQ(trials_csv(trials), trials_csv(whole)) << "cut after " << cut;
    }
}

class EverySessionEngine : public testing::TestWithParam<const char*> {};

TEST_P(EverySessionEngine, GivesTracksTheirTrialsAndResumesBitForBit) {
    Design design = design_from_json(std::string(R"({"engine": {"name": ")") + GetParam() + "\"}}", "design");
    design.patterns = {Pattern::step};
    design.stop.most_trials = 14;
    SimulatedPopulation population;
    population.redo_share = 0.05;
    const std::vector<Trial> whole = simulated_session(20, design, population);
    const auto tracks = by_track(whole);
    ASSERT_EQ(tracks.size(), 8u);
    for (const auto& [track, trials] : tracks) EXPECT_EQ(trials.size(), 14u);
    const SimulatedObserver observer(population, Random(20), 0);
    for (const size_t cut : {size_t{1}, whole.size() / 3, whole.size() - 2}) {
        std::vector<Trial> trials(whole.begin(), whole.begin() + static_cast<long>(cut));
        Session session = resumed_session(design, {"o", 0, 1, 20}, trials, "record");
        run_session(session, observer,
                    {[&](const Trial& trial) { trials.push_back(trial); },
                     [&](int presentation) { trials[static_cast<size_t>(presentation) - 1].is_void = true; }});
        EXPECT_EQ(trials_csv(trials), trials_csv(whole)) << "cut after " << cut;
    }
}

INSTANTIATE_TEST_SUITE_P(All, EverySessionEngine,
                         testing::Values("quest", "minimum-entropy", "psi-marginal", "staircase", "constant-stimuli",
                                         "law-directed"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(Session, StopsWhereTheObserverDoes) {
    for (const auto& [action, outcome] :
         {std::pair(Action::pause, SessionOutcome::paused), std::pair(Action::abort, SessionOutcome::aborted)}) {
        Session session({}, {"o", 0, 1, 1});
        int count = 0;
        EXPECT_EQ(run_session(session,
                              [&](const Presentation&) {
                                  Answer answer;
                                  if (count == 10) answer.action = action;
                                  return answer;
                              },
                              {[&](const Trial&) { ++count; }}),
                  outcome);
        EXPECT_EQ(count, 10);
    }
}

TEST(Session, RefusesARecordThatIsNotItsOwn) {
    const std::vector<Trial> whole = simulated_session(12);
    const SessionIdentity identity{"o", 0, 1, 12};
    const auto spoilt = [&](auto spoil) {
        std::vector<Trial> trials(whole.begin(), whole.begin() + 20);
        spoil(trials);
        return trials;
    };
    EXPECT_NO_THROW(resumed_session({}, identity, spoilt([](auto&) {}), "record"));
    const std::vector<std::vector<Trial>> others{
        spoilt([](auto& t) { t.erase(t.begin() + 3); }),
        spoilt([](auto& t) { std::swap(t[4], t[5]); }),
        spoilt([](auto& t) { t[7].radius_px *= 1.001; }),
        spoilt([](auto& t) {
            t[7].response =
                t[7].correct() == (t[7].stimulus == Judgement::line) ? Judgement::artifact : Judgement::line;
        }),
        spoilt(
            [](auto& t) { t[9].stimulus = t[9].stimulus == Judgement::line ? Judgement::artifact : Judgement::line; }),
        spoilt([](auto& t) { t[11].condition.contrast = 0.7; }),
    };
    for (const auto& trials : others) EXPECT_THROW(resumed_session({}, identity, trials, "record"), InputError);
    EXPECT_THROW(resumed_session({}, {"o", 0, 1, 13}, spoilt([](auto&) {}), "record"), InputError);
}

TEST(Session, KnowsHowFarItIs) {
    for (const StopRule& stop : {StopRule{}, StopRule{10, 100, 0.05}, StopRule{1, 1, {}}}) {
        Design design;
        design.stop = stop;
        Session session(design, {"o", 0, 1, 1});
        const SimulatedObserver observer({}, Random(1), 0);
        EXPECT_EQ(session.progress(), 0);
        run_session(session, [&](const Presentation& shown) {
            EXPECT_GE(session.progress(), 0);
            EXPECT_LT(session.progress(), 1);
            return observer(shown);
        });
        EXPECT_EQ(session.progress(), 1);
    }
}

}  // namespace
}  // namespace stairstep
