#include "study/store.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/trials_csv.h"
#include "tests/support/stored_trials.h"

namespace {

int syncs = 0;

}  // namespace

// SQLite finds these first: they count, and then do what they stand for.
extern "C" int fdatasync(int file) {
    ++syncs;
    return static_cast<int>(syscall(SYS_fdatasync, file));
}
extern "C" int fsync(int file) {
    ++syncs;
    return static_cast<int>(syscall(SYS_fsync, file));
}

namespace stairstep {
namespace {

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

TEST(TrialStore, SyncsEveryTrialToTheDiskBeforeItReturns) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    int session = 0;
    const auto expect_syncs = [&session](TrialStore& store, int first) {
        for (int i = first; i < first + 5; ++i) {
            const int before = syncs;
            store.append(some_trial(session, i));
            EXPECT_GT(syncs, before);
        }
        const int before = syncs;
        store.mark_void(session, first);
        EXPECT_GT(syncs, before);
    };
    {
        TrialStore store = TrialStore::create(path, "s", "{}");
        session = store.begin_session(some_session());
        expect_syncs(store, 1);
    }
    TrialStore store = TrialStore::open_to_write(path);
    expect_syncs(store, 6);
    SQLite::Database database(path.string());
    EXPECT_EQ(database.execAndGet("PRAGMA journal_mode").getString(), "wal");
}

TEST(TrialStore, GoesOnWithWhatWasBegun) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    {
        TrialStore store = TrialStore::create(path, "s", "{}", "{\"b\":2}");
        const int session = store.begin_session(some_session());
        store.append(some_trial(session, 1));
        store.end_session(store.begin_session(some_session()), SessionEnd::aborted);
    }
    {
        TrialStore store = TrialStore::open_to_write(path);
        EXPECT_EQ(store.plan_json(), "{\"b\":2}");
        store.hold_session(1);
        store.append(some_trial(1, 2));
        store.end_session(1, SessionEnd::finished);
        EXPECT_THROW(store.append(some_trial(1, 3)), InputError);  // has ended
        EXPECT_THROW(store.hold_session(2), InputError);
        EXPECT_THROW(store.hold_session(3), InputError);  // never began
        EXPECT_EQ(store.begin_session(some_session()), 3);
    }
    EXPECT_EQ(TrialStore::open(path).trials(1).size(), 2u);
    EXPECT_TRUE(TrialStore::open(path).trials(2).empty());
}

TEST(TrialStore, IsWrittenByOneProcessASessionAndByManyADatabase) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    TrialStore store = TrialStore::create(path, "s", "{}");
    const int session = store.begin_session(some_session());
    TrialStore second = TrialStore::open_to_write(path);
    EXPECT_THROW(second.hold_session(session), FailureError);
    EXPECT_THROW(second.append(some_trial(session, 1)), FailureError);

    std::vector<pid_t> children;
    for (int i = 0; i < 3; ++i) {
        children.push_back(fork());
        if (children.back() == 0) {
            try {
                TrialStore own = TrialStore::open_to_write(path);
                const int own_session = own.begin_session(some_session());
                for (int k = 1; k <= 40; ++k) own.append(some_trial(own_session, k));
                own.end_session(own_session, SessionEnd::finished);
                _exit(0);
            } catch (...) {
                _exit(1);
            }
        }
    }
    for (int k = 1; k <= 40; ++k) store.append(some_trial(session, k));
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    store.end_session(session, SessionEnd::finished);
    EXPECT_EQ(store.sessions().size(), 4u);
    for (const SessionRecord& record : store.sessions()) {
        std::vector<Trial> expected;
        for (int k = 1; k <= 40; ++k) expected.push_back(some_trial(record.session, k));
        EXPECT_EQ(trials_csv(store.trials(record.session)), trials_csv(expected));
    }
}

TEST(TrialStore, KeepsNothingOfADatabaseInMemory) {
    TrialStore store = TrialStore::create(":memory:", "s", "{}");
    const int session = store.begin_session(some_session());
    store.append(some_trial(session, 1));
    store.end_session(session, SessionEnd::finished);
    EXPECT_EQ(store.trials().size(), 1u);
    EXPECT_FALSE(std::filesystem::exists(":memory:"));
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
