#include "stimuli/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace stairstep {
namespace {

TEST(Parallel, RunsEveryTaskOnce) {
    for (const int jobs : {0, 1, 4, 100}) {
        std::vector<std::atomic<int>> runs(37);
        run_in_parallel(runs.size(), jobs, [&](size_t i) { ++runs[i]; });
        for (const auto& count : runs) EXPECT_EQ(count, 1);
    }
    run_in_parallel(0, 4, [](size_t) { FAIL(); });
}

TEST(Parallel, ThrowsWhatATaskThrewAndStartsNoMore) {
    std::atomic<int> runs = 0;
    const auto task = [&](size_t i) {
        ++runs;
        if (i == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(run_in_parallel(1000, 1, task), std::runtime_error);
    EXPECT_EQ(runs, 4);
    EXPECT_THROW(run_in_parallel(1000, 4, task), std::runtime_error);
}

}  // namespace
}  // namespace stairstep
