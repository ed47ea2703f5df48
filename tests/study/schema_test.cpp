#include "study/schema.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/database_file.h"
#include "study/design_json.h"
#include "study/store.h"
#include "tests/support/stored_trials.h"
#include "tests/support/version_1_study.h"

namespace stairstep {
namespace {

class Version1 : public testing::Test {
  protected:
    Version1() { make_version_1_study(path_); }

    void expect_content(const TrialStore& store) {
        EXPECT_EQ(store.study(), "kreuzer-2017");
        EXPECT_EQ(store.plan_json(), "{}");
        const Design design = design_from_json(store.design_json(), "design");
        EXPECT_EQ(design.task, Task::yes_no);
        EXPECT_EQ(design.line_share, 0.5);
        EXPECT_EQ(design.stop.most_trials, 100);
        EXPECT_EQ(design.stop.converged_sd, 0.05);

        const std::vector<SessionRecord> sessions = store.sessions();
        ASSERT_GE(sessions.size(), 2u);
        for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(sessions[i].session, i + 1);
            EXPECT_EQ(sessions[i].observer, "sim0" + std::to_string(i + 1));
            EXPECT_EQ(sessions[i].observer_index, i);
            EXPECT_EQ(sessions[i].seed, 11u * (i + 1));
            EXPECT_EQ(sessions[i].schema, 1);
        }
        EXPECT_EQ(sessions[0].end, SessionEnd::finished);
        EXPECT_EQ(sessions[1].end, std::nullopt);

        const std::vector<Trial> first = store.trials(1);
        const std::vector<Trial> second = store.trials(2);
        ASSERT_EQ(first.size(), 3u);
        ASSERT_EQ(second.size(), 3u);
        for (int i = 0; i < 3; ++i) {
            for (const Trial& trial : {first[i], second[i]}) {
                EXPECT_EQ(trial.presentation, i + 1);
                EXPECT_EQ(trial.kind, TrialKind::main);
                EXPECT_EQ(trial.task, Task::yes_no);
                EXPECT_FALSE(trial.is_void);
            }
        }
        const int tracks[] = {first[0].track, first[1].track, first[2].track, second[2].track};
        EXPECT_EQ(std::vector<int>(tracks, tracks + 4), (std::vector<int>{2, 1, 2, 6}));
        EXPECT_EQ(first[2].trial, 2);
        EXPECT_EQ(first[0].suggested_radius_px, 400.1);
        EXPECT_EQ(first[0].radius_px, 320);
        EXPECT_EQ(first[1].stimulus, Judgement::line);
        EXPECT_EQ(first[1].response, Judgement::artifact);
        EXPECT_EQ(second[0].condition, (Condition{Pattern::stair, KernelShape::box, 0.5, 5}));
        EXPECT_EQ(second[0].response_time_s, 0.81);
        EXPECT_EQ(second[0].shown_at_s, 946771200.5);
        EXPECT_EQ(second[0].dropped_frames, 1);
        EXPECT_EQ(store.trials().size(), 6u);
        EXPECT_EQ(store.trials()[1].observer, "sim02");  // in the order of their recording
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_.path() / "old.sqlite";
};

TEST_F(Version1, IsReadWithoutAChange) {
    const std::string before = read_file(path_);
    expect_content(TrialStore::open(path_));
    EXPECT_EQ(read_file(path_), before);
    EXPECT_EQ(schema_version(open_as_it_is(path_)), 1);
}

TEST_F(Version1, BecomesThisVersionWhenOpenedToWrite) {
    {
        TrialStore store = TrialStore::open_to_write(path_);
        expect_content(store);
        const int session = store.begin_session(some_session());
        EXPECT_EQ(session, 3);
        // Two presentations of one trial, which version 1 had no room for.
        Trial trial = some_trial(session, 1);
        store.append(trial);
        store.mark_void(session, 1);
        trial.presentation = 2;
        store.append(trial);
        EXPECT_EQ(store.sessions()[2].schema, kSchemaVersion);
    }
    const SQLite::Database database = open_as_it_is(path_);
    EXPECT_EQ(schema_version(database), kSchemaVersion);
    EXPECT_EQ(schema_faults(database), std::vector<std::string>{});
    EXPECT_EQ(TrialStore::open(path_).trials(1).size(), 3u);
    TrialStore::open_to_write(path_);  // nothing more to do
}

TEST_F(Version1, StaysAsItWasWhereItCantBecomeThisVersion) {
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("CREATE TABLE void (x)");  // in the way
    EXPECT_THROW(TrialStore::open_to_write(path_), InputError);
    EXPECT_EQ(schema_version(open_as_it_is(path_)), 1);
    SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
    database.exec("DROP TABLE void");
    database = SQLite::Database(":memory:");
    expect_content(TrialStore::open_to_write(path_));
}

TEST(Schema, SaysWhatDiffers) {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    create_schema(database);
    EXPECT_EQ(schema_faults(database), std::vector<std::string>{});
    database.exec(
        "DROP TRIGGER void_is_final_delete; CREATE TABLE more (x); DROP TRIGGER trial_is_final_update;"
        "CREATE TRIGGER trial_is_final_update BEFORE UPDATE ON trial BEGIN SELECT 1; END");
    const std::vector<std::string> expected{"trigger trial_is_final_update isn't what this version has",
                                            "trigger void_is_final_delete is missing",
                                            "table more doesn't belong here"};
    EXPECT_EQ(schema_faults(database), expected);
}

}  // namespace
}  // namespace stairstep
