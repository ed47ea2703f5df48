// A bound on memory for a stretch of code that reads files others wrote. A 309-byte model may claim 10¹¹
// vertices: without a bound, the machine swaps for minutes before the importer gives up; with it,
// std::bad_alloc comes at once.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace stairstep {

/// While it lives, the whole process can map only `bytes` more than it had. Does nothing under the address
/// sanitizer, which maps terabytes for itself.
class MemoryLimit {
  public:
    explicit MemoryLimit(size_t bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

  private:
    rlimit before_{};
    bool active_ = false;
};

}  // namespace stairstep
