// What the store keeps when its process, its disk or its files fail: every trial it acknowledged.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <map>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/random.h"
#include "study/store.h"
#include "study/trials_csv.h"
#include "tests/support/stored_trials.h"

namespace stairstep {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kKills = 60;
#else
constexpr int kKills = 810;  // tests/programs/simulate_test.cpp has the rest of a thousand
#endif

/// What a writer says through a pipe once the store has returned.
struct Acknowledgement {
    int session;
    int presentation;
    bool is_void;
};

/// Goes on with a database until it is killed: sessions of 25 trials, one in ten taken back.
[[noreturn]] void write_until_killed(const std::filesystem::path& path, int acknowledgements, uint64_t seed) {
    Random random(seed);
    const auto acknowledge = [&](const Acknowledgement& done) {
        if (write(acknowledgements, &done, sizeof done) != sizeof done) _exit(3);
    };
    try {
        TrialStore store =
            std::filesystem::exists(path) ? TrialStore::open_to_write(path) : TrialStore::create(path, "s", "{}");
        const std::vector<SessionRecord> sessions = store.sessions();
        int session = 0;
        if (!sessions.empty() && !sessions.back().end) {
            session = sessions.back().session;
            store.hold_session(session);
        }
        while (true) {
            if (session == 0) session = store.begin_session(some_session());
            for (int next = static_cast<int>(store.trials(session).size()) + 1; next <= 25; ++next) {
                store.append(some_trial(session, next));
                acknowledge({session, next, false});
                if (random.uniform() > 0.1) continue;
                store.mark_void(session, next);
                acknowledge({session, next, true});
            }
            store.end_session(session, SessionEnd::finished);
            session = 0;
        }
    } catch (const std::exception& e) {
        (void)!write(STDERR_FILENO, e.what(), std::char_traits<char>::length(e.what()));
        _exit(4);
    }
}

/// Starts a writer, kills it a while after its n-th acknowledgement, and returns what it acknowledged.
std::vector<Acknowledgement> killed_writer(const std::filesystem::path& path, uint64_t seed, size_t least,
                                           int delay_us) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        write_until_killed(path, ends[1], seed);
    }
    close(ends[1]);
    std::vector<Acknowledgement> acknowledged;
    Acknowledgement done;
    const auto hear = [&] { return read(ends[0], &done, sizeof done) == sizeof done; };
    while (acknowledged.size() < least && hear()) acknowledged.push_back(done);
    usleep(static_cast<useconds_t>(delay_us));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed with " << WEXITSTATUS(status);
    while (hear()) acknowledged.push_back(done);
    close(ends[0]);
    return acknowledged;
}

std::string first_integrity_problem(const std::filesystem::path& path) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    return database.execAndGet("PRAGMA integrity_check").getString();
}

/// Kills writers of databases that grow, in this folder; a new one after every `kills_a_database`.
void kill_many(const std::filesystem::path& folder, int kills, int kills_a_database, int longest_delay_us) {
    Random random(static_cast<uint64_t>(kills));
    size_t acknowledged_in_all = 0;
    std::filesystem::path path;
    std::map<int, std::vector<Trial>> expected;  // of all writers of this database, by session
    for (int i = 0; i < kills; ++i) {
        if (i % kills_a_database == 0) {
            path = folder / (std::to_string(i) + ".sqlite");
            expected.clear();
        }
        const size_t least = random.below(4);  // none: it may be killed before it has a database
        const int delay_us = static_cast<int>(random.below(static_cast<uint64_t>(longest_delay_us)));
        const std::vector<Acknowledgement> acknowledged = killed_writer(path, random.bits(), least, delay_us);
        acknowledged_in_all += acknowledged.size();
        if (!std::filesystem::exists(path)) {
            ASSERT_TRUE(acknowledged.empty());
            continue;
        }
        const TrialStore store = TrialStore::open(path);
        std::map<int, std::vector<Trial>> found;
        for (const Trial& trial : store.trials()) found[trial.session].push_back(trial);
        for (const Acknowledgement& done : acknowledged) {
            std::vector<Trial>& trials = expected[done.session];
            if (done.is_void) {
                trials[static_cast<size_t>(done.presentation) - 1].is_void = true;
            } else {
                ASSERT_EQ(trials.size() + 1, static_cast<size_t>(done.presentation)) << "kill " << i;
                trials.push_back(some_trial(done.session, done.presentation));
            }
        }
        // All that was acknowledged, as it was, and at most one step more: killed between doing and saying it.
        size_t more = 0;
        for (auto& [session, trials] : found) {
            std::vector<Trial>& known = expected[session];
            ASSERT_GE(trials.size(), known.size()) << "kill " << i << ", session " << session;
            for (size_t k = 0; k < known.size(); ++k) {
                ASSERT_LE(known[k].is_void, trials[k].is_void);
                if (known[k].is_void != trials[k].is_void) ++more;
                known[k].is_void = trials[k].is_void;
            }
            for (size_t k = known.size(); k < trials.size(); ++k, ++more) {
                known.push_back(some_trial(session, static_cast<int>(k) + 1));
            }
            ASSERT_EQ(trials_csv(known), trials_csv(trials)) << "kill " << i << ", session " << session;
        }
        for (const auto& [session, trials] : expected) ASSERT_TRUE(found.contains(session) || trials.empty());
        ASSERT_LE(more, 1u) << "kill " << i;
        if (i % 10 == 0) {
            ASSERT_EQ(first_integrity_problem(path), "ok");
        }
    }
    EXPECT_GT(acknowledged_in_all, static_cast<size_t>(kills));
}

TEST(StoreFaults, LosesNothingAcknowledgedWhenKilledOnDisk) {
    const TemporaryFolder folder;
    kill_many(folder.path(), kKills / 6, 30, 10000);
}

TEST(StoreFaults, LosesNothingAcknowledgedWhenKilledInMemory) {
    // Without a disk's waits the kills fall everywhere, not mostly into those.
    if (access("/dev/shm", W_OK) != 0) GTEST_SKIP() << "no folder in memory here";
    const std::string old = getenv("TMPDIR") ? getenv("TMPDIR") : "";
    setenv("TMPDIR", "/dev/shm", 1);
    {
        const TemporaryFolder folder;
        kill_many(folder.path(), kKills - kKills / 6, 15, 5000);
    }
    old.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", old.c_str(), 1);
}

/// While it lives no file can grow beyond a size: a full disk, without one.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        old_handler_ = signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        signal(SIGXFSZ, old_handler_);
    }

  private:
    rlimit before_{};
    sighandler_t old_handler_;
};

TEST(StoreFaults, KeepsEverythingOnAFullDiskAndGoesOnOnceThereIsRoom) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    std::vector<Trial> recorded;
    {
        TrialStore store = TrialStore::create(path, "s", "{}");
        const int session = store.begin_session(some_session());
        for (int round = 0; round < 3; ++round) {
            {
                const FileSizeLimit limit(std::filesystem::file_size(path.string() + "-wal") + 50'000 + 777 * round);
                try {
                    while (recorded.size() < 10'000) {
                        store.append(some_trial(session, static_cast<int>(recorded.size()) + 1));
                        recorded.push_back(some_trial(session, static_cast<int>(recorded.size()) + 1));
                    }
                    FAIL() << "the disk was never full";
                } catch (const FailureError& e) {
                    EXPECT_NE(std::string(e.what()).find("free space"), std::string::npos) << e.what();
                }
                EXPECT_THROW(store.append(some_trial(session, static_cast<int>(recorded.size()) + 1)), FailureError);
                EXPECT_EQ(trials_csv(TrialStore::open(path).trials()), trials_csv(recorded));
            }
            store.append(some_trial(session, static_cast<int>(recorded.size()) + 1));
            recorded.push_back(some_trial(session, static_cast<int>(recorded.size()) + 1));
        }
        store.end_session(session, SessionEnd::finished);
    }
    EXPECT_EQ(trials_csv(TrialStore::open(path).trials()), trials_csv(recorded));
    EXPECT_EQ(first_integrity_problem(path), "ok");
}

TEST(StoreFaults, ClosesOnAFullDiskWithoutLosingATrial) {
    // What the WAL holds can't be moved into the file when the store closes; it is read from where it is.
    const TemporaryFolder folder;
    const auto path = folder.path() / "study.sqlite";
    std::vector<Trial> recorded;
    {
        TrialStore store = TrialStore::create(path, "s", "{}");
        const int session = store.begin_session(some_session());
        for (int i = 1; i <= 300; ++i) {
            recorded.push_back(some_trial(session, i));
            store.append(recorded.back());
        }
        const FileSizeLimit limit(std::filesystem::file_size(path));
        { const TrialStore closes = std::move(store); }
        EXPECT_EQ(trials_csv(TrialStore::open(path).trials()), trials_csv(recorded));
    }
    EXPECT_EQ(trials_csv(TrialStore::open(path).trials()), trials_csv(recorded));
}

TEST(StoreFaults, MakesNoHalfADatabaseOnAFullDisk) {
    const TemporaryFolder folder;
    for (const rlim_t bytes : {0, 1000, 5000, 20000}) {
        const FileSizeLimit limit(bytes);
        EXPECT_THROW(TrialStore::create(folder.path() / "study.sqlite", "s", "{}"), FailureError) << bytes;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << bytes;
    }
}

/// A database with its WAL as a killed process leaves them, and what it had recorded.
struct LeftBehind {
    std::string file;
    std::string wal;
    std::vector<Trial> recorded;
};

LeftBehind left_behind(const std::filesystem::path& folder) {
    LeftBehind left;
    const auto path = folder / "whole.sqlite";
    TrialStore store = TrialStore::create(path, "s", "{}");
    const int session = store.begin_session(some_session());
    for (int i = 1; i <= 60; ++i) {
        left.recorded.push_back(some_trial(session, i));
        store.append(left.recorded.back());
    }
    left.file = read_file(path);
    left.wal = read_file(path.string() + "-wal");
    return left;
}

/// Opens a database with a spoilt WAL: what it reads must be the first of what was recorded, unless it says that it can't.
/// Returns how many trials it read.
size_t trials_read(const std::filesystem::path& folder, const LeftBehind& left, const std::string& wal) {
    const auto path = folder / "spoilt.sqlite";
    std::filesystem::remove(path.string() + "-shm");
    write_file(path, left.file);
    write_file(path.string() + "-wal", wal);
    std::vector<Trial> trials;
    try {
        trials = TrialStore::open(path).trials();
    } catch (const InputError&) {
        return 0;
    }
    EXPECT_LE(trials.size(), left.recorded.size());
    const std::vector<Trial> first(left.recorded.begin(), left.recorded.begin() + static_cast<long>(trials.size()));
    EXPECT_EQ(trials_csv(trials), trials_csv(first));
    return trials.size();
}

TEST(StoreFaults, ReadsAValidBeginningOfATruncatedLog) {
    const TemporaryFolder folder;
    const LeftBehind left = left_behind(folder.path());
    ASSERT_GT(left.wal.size(), 100'000u);
    EXPECT_EQ(trials_read(folder.path(), left, left.wal), 60u);
    Random random(1);
    std::vector<size_t> counts;
    for (int i = 0; i < 60; ++i) {
        const size_t length = random.below(left.wal.size());
        const size_t count = trials_read(folder.path(), left, left.wal.substr(0, length));
        // A trial takes one or more frames of the log: a longer one never holds fewer.
        counts.push_back(count);
        EXPECT_LE(count, 60 * (length + 40'000) / left.wal.size()) << length;
    }
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 30u);
}

TEST(StoreFaults, ReadsAValidBeginningOfALogWithChangedBytes) {
    const TemporaryFolder folder;
    const LeftBehind left = left_behind(folder.path());
    Random random(2);
    size_t most = 0;
    for (int i = 0; i < 60; ++i) {
        std::string wal = left.wal;
        for (uint64_t flips = 1 + random.below(3); flips > 0; --flips) {
            wal[random.below(wal.size())] ^= static_cast<char>(1u << random.below(8));
        }
        most = std::max(most, trials_read(folder.path(), left, wal));
    }
    EXPECT_GT(most, 10u);
}

}  // namespace
}  // namespace stairstep
