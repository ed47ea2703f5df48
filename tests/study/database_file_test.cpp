// Databases in places that can't be written, and files that are no databases.
#include "study/database_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/store.h"
#include "tests/support/stored_trials.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// Runs an action as a user who isn't root, for whom permissions count; returns what it returns, or 99 where it throws.
int as_plain_user(const std::function<int()>& action) {
    const pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(98);
        try {
            _exit(action());
        } catch (const FailureError& e) {
            _exit(1);
        } catch (const InputError& e) {
            _exit(2);
        } catch (...) {
            _exit(99);
        }
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 100;
}

/// A database of 40 trials, in a folder that can't be written in the end.
class UnwritableDatabase : public testing::Test {
  protected:
    void record(TrialStore& store, int trials) {
        const int session = store.begin_session(some_session());
        for (int i = 1; i <= trials; ++i) store.append(some_trial(session, i));
    }
    /// As a process leaves it that was killed with all trials in the WAL.
    void record_and_be_killed() {
        const pid_t child = fork();
        if (child == 0) {
            TrialStore store = TrialStore::create(path_, "s", "{}");
            record(store, 40);
            _exit(0);  // nothing is closed
        }
        waitpid(child, nullptr, 0);
        fs::remove(path_.string() + ".session-1.lock");
        ASSERT_GT(fs::file_size(path_.string() + "-wal"), 0u);
    }
    void forbid_writing() {
        for (const auto& entry : fs::directory_iterator(folder_.path())) chmod(entry.path().c_str(), 0444);
        chmod(folder_.path().c_str(), 0555);
    }
    void TearDown() override { chmod(folder_.path().c_str(), 0755); }

    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename());
        return names;
    }
    void expect_all_is_read_and_nothing_changed() {
        const std::set<std::string> before = files();
        EXPECT_EQ(as_plain_user([&] { return static_cast<int>(TrialStore::open(path_).trials().size()); }), 40);
        EXPECT_EQ(files(), before);
        EXPECT_EQ(as_plain_user([&] { return TrialStore::open_to_write(path_).sessions().empty(); }), 1);
        EXPECT_EQ(files(), before);
    }

    TemporaryFolder folder_;
    fs::path path_ = folder_.path() / "a study, 100%?#1.sqlite";
};

TEST_F(UnwritableDatabase, IsReadWhereItWasClosed) {
    {
        TrialStore store = TrialStore::create(path_, "s", "{}");
        record(store, 40);
    }
    forbid_writing();
    expect_all_is_read_and_nothing_changed();
}

TEST_F(UnwritableDatabase, IsReadWithALogThatAKilledProcessLeft) {
    record_and_be_killed();
    forbid_writing();
    expect_all_is_read_and_nothing_changed();
}

TEST_F(UnwritableDatabase, IsReadWithALogWithoutItsIndex) {
    record_and_be_killed();
    fs::remove(path_.string() + "-shm");
    forbid_writing();
    expect_all_is_read_and_nothing_changed();
}

TEST_F(UnwritableDatabase, IsReadWhileAnotherUserWrites) {
    TrialStore store = TrialStore::create(path_, "s", "{}");
    record(store, 40);
    for (const auto& entry : fs::directory_iterator(folder_.path())) chmod(entry.path().c_str(), 0644);
    chmod(folder_.path().c_str(), geteuid() == 0 ? 0755 : 0555);
    const auto count = [&] { return static_cast<int>(TrialStore::open(path_).trials().size()); };
    EXPECT_EQ(as_plain_user(count), 40);
    record(store, 10);
    EXPECT_EQ(as_plain_user(count), 50);
}

TEST_F(UnwritableDatabase, IsReadWhereTheFileAloneIsReadOnly) {
    {
        TrialStore store = TrialStore::create(path_, "s", "{}");
        record(store, 40);
    }
    chmod(path_.c_str(), 0444);
    chmod(folder_.path().c_str(), 0777);
    expect_all_is_read_and_nothing_changed();
}

TEST_F(UnwritableDatabase, IsSaidToBeOneThatCantBeRead) {
    { TrialStore::create(path_, "s", "{}"); }
    chmod(path_.c_str(), 0);
    chmod(folder_.path().c_str(), 0755);
    EXPECT_EQ(as_plain_user([&] { return TrialStore::open(path_).trials().empty() ? 10 : 11; }), 1);
}

TEST(DatabaseFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    for (const char* name : {"pipe", "absent", "."}) {
        EXPECT_THROW(open_as_it_is(folder.path() / name), InputError);
        EXPECT_THROW(open_database_to_write(folder.path() / name), InputError);
    }
    EXPECT_THROW(open_as_it_is(":memory:"), InputError);
    EXPECT_THROW(open_as_it_is(""), InputError);
}

TEST(DatabaseFile, TakesNoNameThatIsTaken) {
    const TemporaryFolder folder;
    fs::create_symlink("nowhere", folder.path() / "link");
    write_file(folder.path() / "text", "text");
    for (const char* name : {"link", "text", "."}) {
        EXPECT_THROW(TrialStore::create(folder.path() / name, "s", "{}"), InputError) << name;
    }
    EXPECT_EQ(read_file(folder.path() / "text"), "text");
    EXPECT_THROW(TrialStore::create("", "s", "{}"), FailureError);
}

}  // namespace
}  // namespace stairstep
