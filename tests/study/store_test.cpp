#include "study/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

Trial some_trial(int session, int number) {
    Trial trial;
    trial.study = "s";
    trial.observer = "o1";
    trial.session = session;
    trial.track = 3;
    trial.trial = number;
    trial.presentation = number;
    trial.condition = {Pattern::stair, KernelShape::box, 0.5, 20};
    trial.suggested_radius_px = 50.1;
    trial.radius_px = 50.1 / number;
    trial.stimulus = Judgement::line;
    trial.response = number % 2 == 0 ? Judgement::line : Judgement::artifact;
    trial.response_time_s = 0.75;
    trial.shown_at_s = 946684800.25;
    trial.dropped_frames = 1;
    return trial;
}

TEST(TrialStore, ReadsBackWhatWasRecorded) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    std::vector<Trial> recorded;
    {
        TrialStore store = TrialStore::create(path, "s", "{\"a\":1}");
        const int session = store.begin_session({1, "o1", 0, 42, "simulated", "{}", std::nullopt});
        for (int i = 1; i <= 5; ++i) {
            recorded.push_back(some_trial(session, i));
            store.append(recorded.back());
        }
        store.end_session(session, SessionEnd::finished);
    }
    TrialStore store = TrialStore::open(path);
    EXPECT_THROW(store.append(some_trial(1, 6)), FailureError);  // opened to read
    EXPECT_EQ(trials_csv(store.trials()), trials_csv(recorded));
    EXPECT_EQ(store.study(), "s");
    EXPECT_EQ(store.design_json(), "{\"a\":1}");
    ASSERT_EQ(store.sessions().size(), 1u);
    EXPECT_EQ(store.sessions()[0].seed, 42u);
    EXPECT_EQ(store.sessions()[0].end, SessionEnd::finished);
}

TEST(TrialStore, LeavesOneFileBehindWhoeverReadsIt) {
    const TemporaryFolder folder;
    TrialStore::create(folder.path() / "study.sqlite", "s", "{}");
    TrialStore::open(folder.path() / "study.sqlite").trials();
    int files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
    EXPECT_EQ(files, 1);
}

TEST(TrialStore, IsDurableInWalWithFullSync) {
    const TemporaryFolder folder;
    TrialStore::create(folder.path() / "study.sqlite", "s", "{}");
    SQLite::Database database((folder.path() / "study.sqlite").string());
    EXPECT_EQ(database.execAndGet("PRAGMA journal_mode").getString(), "wal");
}

TEST(TrialStore, LosesNoAcknowledgedTrialWhenKilled) {
    const TemporaryFolder folder;
    for (int round = 0; round < 8; ++round) {
        const auto path = folder.path() / ("study" + std::to_string(round) + ".sqlite");
        int acknowledged[2];
        ASSERT_EQ(pipe(acknowledged), 0);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            close(acknowledged[0]);
            TrialStore store = TrialStore::create(path, "s", "{}");
            const int session = store.begin_session({1, "o1", 0, 1, "simulated", "{}", std::nullopt});
            for (int i = 1;; ++i) {
                store.append(some_trial(session, i));
                if (write(acknowledged[1], "x", 1) != 1) _exit(1);
            }
        }
        close(acknowledged[1]);
        // Kill after a number of trials that differs each time, in the middle of whatever comes next.
        char mark;
        size_t count = 0;
        while (count < 5u + 7u * round && read(acknowledged[0], &mark, 1) == 1) ++count;
        usleep(150 * round);
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        while (read(acknowledged[0], &mark, 1) == 1) ++count;
        close(acknowledged[0]);

        const std::vector<Trial> trials = TrialStore::open(path).trials();
        EXPECT_GE(trials.size(), count);
        EXPECT_LE(trials.size(), count + 1);  // one may have been recorded, not yet acknowledged
        for (size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(trials[i].trial, static_cast<int>(i) + 1);
    }
}

TEST(TrialStore, IsNeverOverwrittenNorChanged) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    {
        TrialStore store = TrialStore::create(path, "s", "{}");
        const int session = store.begin_session({1, "o1", 0, 1, "simulated", "{}", std::nullopt});
        store.append(some_trial(session, 1));
        EXPECT_THROW(store.append(some_trial(session, 1)), InputError);      // the same trial twice
        EXPECT_THROW(store.append(some_trial(session + 1, 1)), InputError);  // a session that never began
    }
    EXPECT_THROW(TrialStore::create(path, "s", "{}"), InputError);
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    EXPECT_THROW(database.exec("UPDATE trial SET response = 'line'"), SQLite::Exception);
    EXPECT_THROW(database.exec("DELETE FROM trial"), SQLite::Exception);
    EXPECT_EQ(TrialStore::open(path).trials().size(), 1u);
}

TEST(TrialStore, RefusesWhatIsNoStudy) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "other";
    EXPECT_THROW(TrialStore::open(path), InputError);
    EXPECT_THROW(TrialStore::open(folder.path()), InputError);
    write_file(path, "this is a text, no database, and long enough to be read as a header of one");
    EXPECT_THROW(TrialStore::open(path), InputError);
    {
        SQLite::Database other((folder.path() / "other.sqlite").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        other.exec("CREATE TABLE t (x)");
    }
    EXPECT_THROW(TrialStore::open(folder.path() / "other.sqlite"), InputError);
    EXPECT_THROW(TrialStore::create(folder.path() / "absent" / "s.sqlite", "s", "{}"), FailureError);
}

TEST(TrialStore, RefusesATruncatedDatabaseAndANewerSchema) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    {
        TrialStore store = TrialStore::create(path, "s", "{}");
        const int session = store.begin_session({1, "o1", 0, 1, "simulated", "{}", std::nullopt});
        for (int i = 1; i < 200; ++i) store.append(some_trial(session, i));
    }
    const std::string bytes = read_file(path);
    for (const size_t size : {size_t{0}, size_t{50}, size_t{4096}, bytes.size() / 2}) {
        const auto cut = folder.path() / "cut.sqlite";
        write_file(cut, std::string_view(bytes).substr(0, size));
        EXPECT_THROW(TrialStore::open(cut).trials(), InputError) << size << " bytes";
    }
    SQLite::Database(path.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
    EXPECT_THROW(TrialStore::open(path), InputError);
}

}  // namespace
}  // namespace stairstep
