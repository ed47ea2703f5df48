// Times of pieces of work.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace stairstep {

/// Wall time.
template <typename Work>
double seconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of all threads together: on a machine that others use, what the work itself costs.
template <typename Work>
double processor_seconds(const Work& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The upper of the two in the middle where their number is even; of one value or more.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace stairstep
