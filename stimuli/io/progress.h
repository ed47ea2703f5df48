// A progress bar on stderr for work of over a second; silent where stderr is no terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace stairstep {

class Progress {
  public:
    /// `label` says what is being done; total units of it, 0 where that isn't known.
    Progress(std::string label, long total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// More units are done. Any thread.
    void advance(long units = 1);

  private:
    void draw(long done);

    std::string label_;
    long total_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::atomic<long> done_ = 0;
    std::mutex drawing_;
    std::chrono::steady_clock::time_point next_draw_;
    bool drawn_ = false;
};

}  // namespace stairstep
