// Independent work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace stairstep {

/// Runs task(0 … count − 1), each once, on `jobs` threads, 0 for one a core; which thread takes which is open, so a
/// task writes to its own place alone. After an exception no further task starts, and the first one is thrown on.
void run_in_parallel(size_t count, int jobs, const std::function<void(size_t)>& task);

}  // namespace stairstep
