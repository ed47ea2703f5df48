#include "renderer/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "renderer/memory_limit.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr int kFinished = 0;
constexpr int kThrew = 1;

/// Closes what it holds.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { reset(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return number_; }
    void reset() {
        if (number_ >= 0) close(number_);
        number_ = -1;
    }

  private:
    int number_;
};

[[noreturn]] void fail(const std::string& what) {
    throw FailureError("the importer's process", what + " (" + std::strerror(errno) + ")", "free memory or processes");
}

bool write_all(int file, const std::string& bytes) {
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(file, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        done += static_cast<size_t>(count);
    }
    return true;
}

std::string read_all(int file) {
    struct stat status;
    if (fstat(file, &status) != 0) fail("can't be read");
    std::string bytes(static_cast<size_t>(status.st_size), '\0');
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t count = pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("can't be read");
        done += static_cast<size_t>(count);
    }
    return bytes;
}

/// The child's life. Nothing of the parent's may be flushed or destroyed, hence _exit.
[[noreturn]] void live(const std::function<std::string()>& work, const ChildLimits& limits, int output) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const rlimit cpu{static_cast<rlim_t>(limits.cpu_s), static_cast<rlim_t>(limits.cpu_s)};
    setrlimit(RLIMIT_CPU, &cpu);
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
    int code = kThrew;
    try {
        const MemoryLimit memory(limits.memory);
        if (write_all(output, work())) code = kFinished;
    } catch (...) {
    }
    _exit(code);
}

/// Waits until the other end of the pipe is closed, which the child's death does; false if that takes too long.
bool wait_for_end(int pipe, std::chrono::seconds limit) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        pollfd waiting{pipe, POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::max<int64_t>(left.count(), 0)));
        if (ready > 0) return true;
        if (ready == 0) return false;
        if (errno != EINTR) fail("can't be waited for");
    }
}

}  // namespace

ChildOutcome run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
    const Descriptor output(memfd_create("output", MFD_CLOEXEC));
    int ends[2] = {-1, -1};
    if (output.get() < 0 || pipe2(ends, O_CLOEXEC) != 0) fail("can't be prepared");
    const Descriptor read_end(ends[0]);
    Descriptor write_end(ends[1]);
    const pid_t child = fork();
    if (child < 0) fail("can't be started");
    if (child == 0) live(work, limits, output.get());
    write_end.reset();

    const bool in_time = wait_for_end(read_end.get(), std::chrono::seconds(4 * limits.cpu_s));
    if (!in_time) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail("can't be waited for");
    }
    if (!in_time) return {ChildOutcome::End::out_of_time, {}};
    if (WIFEXITED(status) && WEXITSTATUS(status) == kFinished) {
        return {ChildOutcome::End::finished, read_all(output.get())};
    }
    // Where the soft and the hard limit are one, the kernel kills at it.
    const bool spent = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    return {spent ? ChildOutcome::End::out_of_time : ChildOutcome::End::crashed, {}};
}

}  // namespace stairstep
