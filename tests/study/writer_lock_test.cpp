#include "study/writer_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

class WriterLockTest : public testing::Test {
  protected:
    WriterLockTest() { write_file(database_, "any file"); }

    std::string refusal() const {
        try {
            const WriterLock lock(database_, "session-3");
        } catch (const FailureError& e) {
            return e.what();
        }
        return "";
    }

    TemporaryFolder folder_;
    std::filesystem::path database_ = folder_.path() / "study.sqlite";
    std::filesystem::path file_ = folder_.path() / "study.sqlite.session-3.lock";
};

/// A process that runs this and then waits to be killed.
class WaitingChild {
  public:
    explicit WaitingChild(const std::function<void()>& action) {
        int ends[2];
        EXPECT_EQ(pipe(ends), 0);
        id_ = fork();
        if (id_ == 0) {
            action();
            (void)!write(ends[1], "x", 1);
            while (true) pause();
        }
        char mark;
        EXPECT_EQ(read(ends[0], &mark, 1), 1);
        close(ends[0]);
        close(ends[1]);
    }
    ~WaitingChild() { end(); }
    void end() {
        if (id_ > 0) {
            kill(id_, SIGKILL);
            waitpid(id_, nullptr, 0);
        }
        id_ = 0;
    }
    pid_t id() const { return id_; }

  private:
    pid_t id_;
};

TEST_F(WriterLockTest, RefusesASecondHolderAndNamesTheFirst) {
    WaitingChild holder([&] { new WriterLock(database_, "session-3"); });
    const std::string text = refusal();
    EXPECT_NE(text.find("session-3"), std::string::npos) << text;
    EXPECT_NE(text.find("process " + std::to_string(holder.id()) + " of "), std::string::npos) << text;
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    EXPECT_NE(text.find(std::string(" on ") + host + " since 20"), std::string::npos) << text;
    const WriterLock another(database_, "session-4");

    holder.end();  // by SIGKILL: nothing was tidied up
    EXPECT_TRUE(std::filesystem::exists(file_));
    EXPECT_EQ(refusal(), "");
}

TEST_F(WriterLockTest, GoesWithItsFileWhenReleased) {
    {
        const WriterLock lock(database_, "session-3");
        EXPECT_TRUE(std::filesystem::exists(file_));
        EXPECT_NE(refusal(), "");  // not even to the same process
    }
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_EQ(refusal(), "");
}

TEST_F(WriterLockTest, TidiesUpAfterTheKilledOnly) {
    const WriterLock held(database_, "session-1");
    write_file(file_, "process 1 of root on here since 2026-01-01T00:00:00Z\n");
    write_file(folder_.path() / "other.sqlite.session-3.lock", "");
    WriterLock::tidy_up(database_);
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "study.sqlite.session-1.lock"));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "other.sqlite.session-3.lock"));
}

TEST_F(WriterLockTest, IsNotFooledByAFileThatNamesALivingProcess) {
    write_file(file_, "process 1 of root on here since 2026-01-01T00:00:00Z\n");
    EXPECT_EQ(refusal(), "");
}

TEST_F(WriterLockTest, IsOneHoweverTheDatabaseIsNamed) {
    std::filesystem::create_symlink(database_, folder_.path() / "link.sqlite");
    const WriterLock lock(folder_.path() / "link.sqlite", "session-3");
    EXPECT_NE(refusal(), "");
}

TEST_F(WriterLockTest, NeverHasTwoHoldersWhileProcessesComeAndGo) {
    // Each holder makes a file that must not be there yet, and removes it before it lets go.
    const auto inside = folder_.path() / "inside";
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            for (int taken = 0; taken < 100;) {
                try {
                    const WriterLock lock(database_, "session-3");
                    const int file = open(inside.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
                    if (file < 0) _exit(1);
                    close(file);
                    ++taken;
                    unlink(inside.c_str());
                } catch (const FailureError&) {
                }
            }
            _exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
}

}  // namespace
}  // namespace stairstep
