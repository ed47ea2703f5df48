#include "study/store_check.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/design_json.h"
#include "study/simulation.h"
#include "tests/support/version_1_study.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// Two observers, one finished and one under way, with practice, catch trials and trials taken back.
void make_study(const fs::path& path) {
    Design design;
    design.patterns = {Pattern::step};
    design.texels_px = {5, 10};
    design.stop = {2, 8, {}};
    design.easy = {.practice_trials = 2, .catch_share = 0.1};
    Simulation simulation{2, 3, {}};
    simulation.population.redo_share = 0.1;
    TrialStore store = TrialStore::create(path, design.name, to_json(design).dump(), to_json(simulation).dump());
    for (int i = 0; i < 2; ++i) {
        SessionRecord record = session_record(simulation, i);
        record.session = store.begin_session(record);
        Session session(design, identity_of(record));
        const SimulatedObserver observer = simulated_observer(simulation, i);
        const auto answers = [&](const Presentation& shown) {
            Answer answer = observer(shown);
            if (i == 1 && shown.number > 20) answer.action = Action::pause;
            return answer;
        };
        const SessionOutcome outcome =
            run_session(session, answers,
                        {[&](const Trial& trial) { store.append(trial); },
                         [&](int presentation) { store.mark_void(record.session, presentation); }});
        if (outcome == SessionOutcome::finished) store.end_session(record.session, SessionEnd::finished);
    }
}

/// The bytes of that study, made once.
const std::string& study_bytes() {
    static const std::string bytes = [] {
        const TemporaryFolder folder;
        make_study(folder.path() / "study.sqlite");
        return read_file(folder.path() / "study.sqlite");
    }();
    return bytes;
}

/// Without waiting for the disk.
void write_at_once(const fs::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary) << text;
}

class StoreCheck : public testing::Test {
  protected:
    StoreCheck() { write_at_once(path_, study_bytes()); }

    /// The problems after some SQL, run with all triggers gone and put back.
    std::vector<std::string> problems_after(const std::string& sql, const std::string& pragmas = "") {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec("PRAGMA synchronous = OFF");
        std::vector<std::string> triggers;
        {
            SQLite::Statement query(database, "SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'");
            std::vector<std::string> names;
            while (query.executeStep()) {
                names.push_back(query.getColumn(0).getString());
                triggers.push_back(query.getColumn(1).getString());
            }
            query.reset();
            for (const std::string& name : names) database.exec("DROP TRIGGER " + name);
        }
        if (!pragmas.empty()) database.exec(pragmas);
        database.exec(sql);
        for (const std::string& trigger : triggers) database.exec(trigger);
        return check_store(path_).problems;
    }

    /// Expects problems, of which the first says this.
    void expect_problem(const std::string& sql, const std::string& text, const std::string& pragmas = "") {
        const std::vector<std::string> problems = problems_after(sql, pragmas);
        ASSERT_FALSE(problems.empty()) << sql;
        EXPECT_NE(problems[0].find(text), std::string::npos) << sql << "\n" << problems[0];
    }

    TemporaryFolder folder_;
    fs::path path_ = folder_.path() / "study.sqlite";
};

TEST_F(StoreCheck, FindsAGoodDatabaseWellAndLeavesItAlone) {
    const std::string before = read_file(path_);
    const StoreReport report = check_store(path_);
    EXPECT_EQ(report.problems, std::vector<std::string>{});
    EXPECT_EQ(report.sessions, 2u);
    EXPECT_GT(report.trials, 40u);
    EXPECT_EQ(report.schema, 2);
    EXPECT_TRUE(report.not_replayed.empty());
    EXPECT_EQ(read_file(path_), before);
    EXPECT_EQ(problems_after("SELECT 1"), std::vector<std::string>{});
}

// Each plants one fault; the place is part of what must be said.

TEST_F(StoreCheck, FindsAnAnswerThatWasTurnedRound) {
    // The answer itself could have been; what was shown after it could not.
    expect_problem(
        "UPDATE trial SET response = CASE response WHEN 'line' THEN 'artifact' ELSE 'line' END "
        "WHERE session = 1 AND presentation = 4",
        "session 1, presentation ");
}

TEST_F(StoreCheck, FindsAnotherStimulus) {
    expect_problem(
        "UPDATE trial SET stimulus = CASE stimulus WHEN 'line' THEN 'artifact' ELSE 'line' END "
        "WHERE session = 1 AND presentation = 7",
        "session 1, presentation 7: shows another stimulus");
}

TEST_F(StoreCheck, FindsAnotherRadius) {
    expect_problem("UPDATE trial SET radius_px = radius_px * 1.01 WHERE session = 2 AND presentation = 5",
                   "session 2, presentation 5: has another radius");
}

TEST_F(StoreCheck, FindsARadiusThatTheDisplayDoesntShow) {
    expect_problem("UPDATE trial SET radius_px = 321 WHERE session = 1 AND presentation = 3",
                   "session 1, presentation 3: has a radius of 321 px");
}

TEST_F(StoreCheck, FindsAnotherCondition) {
    expect_problem("UPDATE trial SET contrast = 0.7 WHERE session = 1 AND presentation = 3",
                   "session 1, presentation 3: isn't the trial");
}

TEST_F(StoreCheck, FindsAMissingTrial) {
    expect_problem(
        "DELETE FROM void WHERE session = 1 AND presentation = 9;"
        "DELETE FROM trial WHERE session = 1 AND presentation = 9",
        "session 1, presentation 10: comes where 9 should");
}

TEST_F(StoreCheck, FindsTheFirstTrialMissing) {
    expect_problem(
        "DELETE FROM void WHERE session = 1 AND presentation = 1;"
        "DELETE FROM trial WHERE session = 1 AND presentation = 1",
        "session 1, presentation 2: comes where 1 should");
}

TEST_F(StoreCheck, FindsTheEndOfAFinishedSessionMissing) {
    expect_problem(
        "DELETE FROM void WHERE session = 1 AND presentation > 15; DELETE FROM trial WHERE session = 1 AND "
        "presentation "
        "> 15",
        "session 1: is marked as finished, but presentation 16 was still to come");
}

TEST_F(StoreCheck, FindsASessionEndedTooEarly) {
    expect_problem("INSERT INTO session_end VALUES (2, 'finished')",
                   "session 2: is marked as finished, but presentation 21 was still to come");
}

TEST_F(StoreCheck, TakesASessionThatWasGivenUp) {
    EXPECT_EQ(problems_after("INSERT INTO session_end VALUES (2, 'aborted')"), std::vector<std::string>{});
}

TEST_F(StoreCheck, FindsTrialsAfterTheEnd) {
    expect_problem(
        "INSERT INTO trial SELECT NULL, session, presentation + 1, round, track, trial + 1, 'main', task, pattern, "
        "kernel, contrast, texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s + "
        "9, 0 "
        "FROM trial WHERE session = 1 ORDER BY presentation DESC LIMIT 1",
        "comes after the session's end");
}

TEST_F(StoreCheck, FindsATrialTakenBackThatWasnt) {
    expect_problem(
        "INSERT INTO void SELECT session, presentation FROM trial WHERE session = 1 AND presentation = 4 "
        "AND (session, presentation) NOT IN (SELECT session, presentation FROM void)",
        "session 1, presentation 5");
}

TEST_F(StoreCheck, FindsTimesThatGoBackwards) {
    expect_problem("UPDATE trial SET shown_at_s = shown_at_s - 10 WHERE session = 1 AND presentation = 8",
                   "session 1, presentation 8: was shown before the one before it");
}

TEST_F(StoreCheck, FindsAResponseTimeThatCantBe) {
    expect_problem("UPDATE trial SET response_time_s = -0.1 WHERE session = 1 AND presentation = 8",
                   "session 1, presentation 8: has the response time -0.1 s");
    expect_problem("UPDATE trial SET response_time_s = 9e999 WHERE session = 1 AND presentation = 8",
                   "session 1, presentation 8: has the response time inf s");
}

TEST_F(StoreCheck, FindsAnotherSeed) {
    expect_problem("UPDATE session SET seed = seed + 1 WHERE session = 2", "session 2, presentation ");
}

TEST_F(StoreCheck, FindsAnotherPlaceInTheOrder) {
    expect_problem("UPDATE session SET observer_index = 1 WHERE session = 1", "session 1, presentation 1: isn't");
    expect_problem("UPDATE session SET observer_index = -3 WHERE session = 1", "session 1: has an observer before");
}

TEST_F(StoreCheck, FindsADesignThatIsNone) {
    expect_problem("UPDATE study SET design = '{\"texels_px\":[]}'", "texels_px");
    expect_problem("UPDATE study SET design = '{'", "design");
    expect_problem("UPDATE study SET design = '{\"texels_px\":[5,20]}'", "session 1, presentation ");
    expect_problem("DELETE FROM study", "holds no study");
}

TEST_F(StoreCheck, FindsWhatForeignKeysForbid) {
    expect_problem("INSERT INTO session_end VALUES (7, 'finished')",
                   "foreign key: session_end row 7 refers to a session that isn't there", "PRAGMA foreign_keys = OFF");
}

TEST_F(StoreCheck, FindsWhatTheChecksForbid) {
    expect_problem("UPDATE trial SET stimulus = 'blob' WHERE session = 1 AND presentation = 2",
                   "integrity: ", "PRAGMA ignore_check_constraints = ON");
}

TEST_F(StoreCheck, FindsAKernelThatNoneKnowsAndGoesOn) {
    const std::vector<std::string> problems = problems_after(
        "UPDATE trial SET kernel = 'blob' WHERE session = 1 AND presentation = 3;"
        "UPDATE trial SET response_time_s = 0 WHERE session = 2 AND presentation = 3");
    ASSERT_EQ(problems.size(), 2u);
    EXPECT_NE(problems[0].find("blob"), std::string::npos) << problems[0];
    EXPECT_NE(problems[1].find("session 2, presentation 3"), std::string::npos) << problems[1];
}

TEST_F(StoreCheck, FindsAMissingTrigger) {
    for (const char* trigger : {"trial_is_final_update", "void_is_final_delete", "trial_comes_before_end"}) {
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec(std::string("DROP TRIGGER ") + trigger);
        const std::vector<std::string> problems = check_store(path_).problems;
        ASSERT_FALSE(problems.empty());
        EXPECT_EQ(
            std::count(problems.begin(), problems.end(), std::string("schema: trigger ") + trigger + " is missing"), 1);
    }
}

TEST_F(StoreCheck, NeverCrashesOnSpoiltBytesAndFindsThemWhereTheyMatter) {
    const std::string bytes = read_file(path_);
    Random random(1);
    int found = 0;
    int refused = 0;
    for (int i = 0; i < 150; ++i) {
        std::string spoilt = bytes;
        if (i % 3 == 0) {
            spoilt.resize(random.below(spoilt.size()));
        } else {
            for (int k = 0; k < 8; ++k) spoilt[random.below(spoilt.size())] = static_cast<char>(random.below(256));
        }
        write_at_once(path_, spoilt);
        try {
            found += !check_store(path_).problems.empty();
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(found, 75);
    EXPECT_LT(refused, 40);
}

TEST_F(StoreCheck, RefusesWhatIsNoStudyAndReportsDamageToOne) {
    const std::string bytes = read_file(path_);
    write_at_once(path_, "text");
    EXPECT_THROW(check_store(path_), InputError);
    write_at_once(path_, "");
    EXPECT_THROW(check_store(path_), InputError);
    EXPECT_THROW(check_store(folder_.path()), InputError);
    write_at_once(path_, std::string_view(bytes).substr(0, bytes.size() / 2));
    EXPECT_FALSE(check_store(path_).problems.empty());
    write_at_once(path_, bytes);
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 3");
    EXPECT_THROW(check_store(path_), InputError);
}

TEST_F(StoreCheck, SaysWhatOfVersion1CantBeReplayed) {
    const auto old = folder_.path() / "old.sqlite";
    make_version_1_study(old);
    StoreReport report = check_store(old);
    EXPECT_EQ(report.schema, 1);
    EXPECT_EQ(report.problems, std::vector<std::string>{});
    EXPECT_EQ(report.not_replayed, (std::vector<int>{1, 2}));
    { TrialStore::open_to_write(old); }
    report = check_store(old);
    EXPECT_EQ(report.schema, 2);
    EXPECT_EQ(report.problems, std::vector<std::string>{});
    EXPECT_EQ(report.not_replayed, (std::vector<int>{1, 2}));
    make_version_1_study(folder_.path() / "other.sqlite");
    SQLite::Database(folder_.path() / "other.sqlite", SQLite::OPEN_READWRITE)
        .exec("DROP TRIGGER trial_is_final_update");
    EXPECT_EQ(check_store(folder_.path() / "other.sqlite").problems,
              std::vector<std::string>{"schema: trigger trial_is_final_update is missing"});
}

}  // namespace
}  // namespace stairstep
