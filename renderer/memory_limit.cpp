#include "renderer/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace stairstep {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// Bytes of address space that the process uses; 0 where /proc doesn't tell.
size_t mapped_bytes() {
    size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

MemoryLimit::MemoryLimit(size_t bytes) {
    const size_t mapped = mapped_bytes();
    if (kSanitized || mapped == 0 || getrlimit(RLIMIT_AS, &before_) != 0) return;
    rlimit limit = before_;
    limit.rlim_cur = std::min<rlim_t>(before_.rlim_cur, mapped + bytes);
    active_ = setrlimit(RLIMIT_AS, &limit) == 0;
}

MemoryLimit::~MemoryLimit() {
    if (active_) setrlimit(RLIMIT_AS, &before_);
}

}  // namespace stairstep
