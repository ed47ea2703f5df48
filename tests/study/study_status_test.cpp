#include "study/study_status.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/design_json.h"
#include "tests/support/made_study.h"

namespace stairstep {
namespace {

std::vector<SessionStatus> status_of(const MadeStudy& study) {
    return study_status(to_json(study.design).dump(), study.sessions, study.trials, "made");
}

TEST(StudyStatus, FisherBoundIsTheClosedForm) {
    const EngineSettings quest = QuestSettings{};
    EXPECT_NEAR(*fisher_bound_sd(quest, 0), 0.5, 1e-12);  // the prior's
    EXPECT_NEAR(*fisher_bound_sd(quest, 40), 1 / std::sqrt(40 * 17.789 + 4), 1e-6);
    EXPECT_NEAR(*fisher_bound_sd(quest, 40), 0.0374, 5e-5);
}

TEST(StudyStatus, CountsWhatEachSessionShowed) {
    const MadeStudy study = made_study();
    const auto sessions = status_of(study);
    ASSERT_EQ(sessions.size(), study.sessions.size());
    int voids = 0;
    for (const SessionStatus& status : sessions) {
        int right = 0;
        int shown = 0;
        for (const Trial& trial : study.trials) {
            if (trial.session != status.session.session || trial.kind != TrialKind::attention || trial.is_void)
                continue;
            ++shown;
            right += trial.stimulus == trial.response;
        }
        EXPECT_EQ(status.catch_trials, shown);
        EXPECT_EQ(status.catch_right, right);
        EXPECT_EQ(status.presentations,
                  status.main_trials + status.practice_trials + status.catch_trials + status.voids);
        EXPECT_TRUE(status.progress) << status.note;
        voids += status.voids;
    }
    EXPECT_GT(voids, 5);
    EXPECT_GT(sessions[0].catch_trials, 0);
    EXPECT_EQ(sessions[0].practice_trials, 2);
    EXPECT_EQ(sessions[4].presentations, 0);
}

TEST(StudyStatus, AFinishedSessionIsDoneInEveryTrack) {
    const auto sessions = status_of(made_study());
    for (const size_t finished : {0, 3}) {
        const SessionProgress& progress = *sessions[finished].progress;
        // 2 patterns × 1 contrast, with 2 texel sizes and 6 trials each.
        EXPECT_EQ(progress.rounds, 2);
        EXPECT_EQ(progress.rounds_done, 2);
        EXPECT_EQ(progress.tracks, 4);
        EXPECT_EQ(progress.tracks_done, 4);
        EXPECT_EQ(progress.begun.size(), 4u);
        EXPECT_EQ(sessions[finished].main_trials, 24);
        EXPECT_EQ(progress.expected_trials, 24);
        EXPECT_EQ(progress.share, 1);
        EXPECT_FALSE(progress.time_left_s);
    }
}

TEST(StudyStatus, TracksHaveTheSdOfTheirOwnTrials) {
    const MadeStudy study = made_study();
    const auto sessions = status_of(study);
    for (const TrackStatus& track : sessions[2].progress->begun) {
        Quest quest(std::get<QuestSettings>(engine_settings(study.design)));
        for (const Trial& trial : study.trials) {
            if (trial.session == 3 && trial.track == track.track && trial.is_evidence()) {
                quest.update(trial.strength(), trial.correct());
            }
        }
        EXPECT_EQ(track.state.trials, quest.trials());
        EXPECT_DOUBLE_EQ(track.state.estimate.sd, quest.sd());
        if (quest.trials() == 0) continue;
        EXPECT_NEAR(*track.sd_over_bound(), quest.sd() * std::sqrt(quest.trials() * 17.789 + 4), 1e-4);
        EXPECT_GT(*track.sd_over_bound(), 0.8);
    }
}

TEST(StudyStatus, ForeseesTheTimeOfASteadySession) {
    // 24 main trials are due. After 12, at 3 s each with one long break, as many are left: 36 s.
    MadeStudy study = made_study();
    study.design.easy = {};
    study.sessions = {{1, "o", 0, 5, "person", "{}", std::nullopt}};
    study.trials.clear();
    Session session(study.design, {"o", 0, 1, 5});
    for (int i = 0; i < 12; ++i) {
        Trial trial = *session.next();
        trial.shown_at_s = 3 * i + (i >= 7 ? 86400 : 0);
        trial.response = i % 4 == 0 ? Judgement::line : trial.stimulus;
        study.trials.push_back(trial);
        session.record(trial);
    }
    const SessionStatus status = status_of(study)[0];
    EXPECT_DOUBLE_EQ(*status.presentation_s, 3);
    EXPECT_DOUBLE_EQ(status.progress->share, 0.5);
    EXPECT_EQ(status.progress->expected_trials, 24);
    EXPECT_NEAR(*status.progress->time_left_s, 36, 1e-9);
    EXPECT_EQ(status.progress->rounds_done, 1);

    study.sessions[0].end = SessionEnd::aborted;
    EXPECT_FALSE(status_of(study)[0].progress->time_left_s);
}

TEST(StudyStatus, WhatCannotBeReplayedHasItsCountsAndANote) {
    MadeStudy study = made_study();
    const auto untouched = status_of(study);
    study.trials[4].radius_px *= 1.5;  // in session 1
    const auto sessions = status_of(study);
    EXPECT_FALSE(sessions[0].progress);
    EXPECT_NE(sessions[0].note.find("session 1, presentation 5"), std::string::npos) << sessions[0].note;
    EXPECT_EQ(sessions[0].main_trials, untouched[0].main_trials);
    EXPECT_TRUE(sessions[1].progress);
    EXPECT_EQ(sessions[1].note, "");

    for (const SessionStatus& status :
         study_status("{\"engine\": {\"name\": \"oracle\"}}", study.sessions, study.trials, "made")) {
        EXPECT_FALSE(status.progress);
        EXPECT_NE(status.note.find("oracle"), std::string::npos);
    }
    EXPECT_EQ(study_status("[", study.sessions, study.trials, "made").size(), 5u);
}

}  // namespace
}  // namespace stairstep
