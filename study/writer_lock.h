// One writer at a time: a lock on a part of a database that a second process is refused, told whose it is.
//
// The operating system holds the lock (flock on a small file beside the database), so that it vanishes with its process,
// however that ends, and no process number is ever taken for another's. What the file says is for people only. It goes away
// when the lock is released; a killed process leaves it behind, which means nothing.
#pragma once

#include <filesystem>
#include <string>

namespace stairstep {

class WriterLock {
  public:
    /// Takes the lock of a part of a database ("session-3"): the file DATABASE.PART.lock. Throws FailureError where another
    /// holder has it, naming the process, its host, user and since when, and where the folder can't be written.
    WriterLock(const std::filesystem::path& database, const std::string& part);
    /// Releases it.
    ~WriterLock();
    WriterLock(WriterLock&& other) noexcept;
    WriterLock& operator=(WriterLock&&) = delete;

    /// Removes the files that killed holders of a database's locks left behind.
    static void tidy_up(const std::filesystem::path& database);

  private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace stairstep
