#include "stimuli/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stairstep {

void run_in_parallel(size_t count, int jobs, const std::function<void(size_t)>& task) {
    const size_t wanted = jobs > 0 ? static_cast<size_t>(jobs) : std::max(1u, std::thread::hardware_concurrency());
    std::atomic<size_t> next = 0;
    std::atomic<bool> failed = false;
    std::mutex guard;
    std::exception_ptr failure;
    const auto work = [&] {
        for (size_t i; !failed && (i = next++) < count;) {
            try {
                task(i);
            } catch (...) {
                const std::scoped_lock lock(guard);
                if (!failure) failure = std::current_exception();
                failed = true;
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (size_t i = 1; i < std::min(wanted, count); ++i) threads.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace stairstep
