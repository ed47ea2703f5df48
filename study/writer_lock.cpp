#include "study/writer_lock.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

#include "stimuli/error.h"

namespace stairstep {
namespace {

std::string user_name() {
    std::vector<char> memory(16384);
    passwd entry{};
    passwd* found = nullptr;
    getpwuid_r(geteuid(), &entry, memory.data(), memory.size(), &found);
    return found ? found->pw_name : std::to_string(geteuid());
}

std::string host_name() {
    char name[256] = "";
    if (gethostname(name, sizeof name - 1) != 0) return "unknown host";
    return name;
}

/// "process 4711 of ann on lab-pc since 2026-01-31T09:30:00Z".
std::string this_process() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char since[32];
    std::strftime(since, sizeof since, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return "process " + std::to_string(getpid()) + " of " + user_name() + " on " + host_name() + " since " + since;
}

/// Whoever tidies up holds a lock for microseconds: it takes more than one refusal to be refused.
constexpr int kRefusals = 10;

/// What a holder wrote into its file. It may be about to: wait a little for it.
std::string holder(int descriptor) {
    for (int attempt = 0; attempt < 20; ++attempt) {
        char text[512];
        const ssize_t length = pread(descriptor, text, sizeof text, 0);
        if (length > 0 && text[length - 1] == '\n') return std::string(text, static_cast<size_t>(length) - 1);
        usleep(5000);
    }
    return "another process";
}

/// Whether the file of this name is the one that is open, and not a newer one in its place.
bool is_still_named(int descriptor, const std::filesystem::path& path) {
    struct stat open_file {};
    struct stat named {};
    return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named) == 0 && open_file.st_ino == named.st_ino &&
           open_file.st_dev == named.st_dev;
}

}  // namespace

WriterLock::WriterLock(const std::filesystem::path& database, const std::string& part) {
    const std::string subject = database.string() + ", " + part;
    const auto fail = [&](const std::string& problem, const std::string& remedy) {
        if (descriptor_ >= 0) close(descriptor_);
        throw FailureError(subject, problem, remedy);
    };
    std::error_code error;
    file_ = std::filesystem::canonical(database, error);  // one lock, however the database is named
    if (error) fail(error.message(), "check the path");
    file_ += "." + part + ".lock";
    for (int refusals = 0;;) {
        descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
        if (descriptor_ < 0) {
            fail(std::string("can't make its lock (") + std::strerror(errno) + ")",
                 "check the permissions of " + file_.string());
        }
        if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
            // Its last holder may have removed the file between our opening and our locking it.
            if (is_still_named(descriptor_, file_)) break;
        } else if (errno != EWOULDBLOCK && errno != EINTR) {
            fail(std::strerror(errno), "put the database on a file system with locks");
        } else if (++refusals == kRefusals) {
            fail("is being written by " + holder(descriptor_), "wait for it or stop it");
        } else {
            usleep(5000);
        }
        close(descriptor_);
    }
    // For whoever asks; the lock holds without it, on a full disk too.
    const std::string text = this_process() + "\n";
    if (ftruncate(descriptor_, 0) == 0) (void)!pwrite(descriptor_, text.data(), text.size(), 0);
}

WriterLock::~WriterLock() {
    if (descriptor_ < 0) return;
    unlink(file_.c_str());  // while it is still ours
    close(descriptor_);
}

void WriterLock::tidy_up(const std::filesystem::path& database) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(database, error);
    const std::string start = path.filename().string() + ".";
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), error)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(start) || !name.ends_with(".lock")) continue;
        const int file = open(entry.path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (file < 0) continue;
        if (flock(file, LOCK_EX | LOCK_NB) == 0 && is_still_named(file, entry.path())) unlink(entry.path().c_str());
        close(file);
    }
}

WriterLock::WriterLock(WriterLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace stairstep
