#include "renderer/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace stairstep {
namespace {

using End = ChildOutcome::End;
constexpr ChildLimits kLimits{size_t{1} << 30, 2};

TEST(ChildProcess, HandsBackWhatTheWorkReturns) {
    for (const size_t size : {size_t{0}, size_t{1}, size_t{10'000'000}}) {
        std::string bytes(size, '\0');
        for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 31);
        const ChildOutcome outcome = run_in_child([&] { return bytes; }, kLimits);
        EXPECT_EQ(outcome.end, End::finished);
        EXPECT_EQ(outcome.output, bytes);
    }
}

TEST(ChildProcess, TheWorkChangesNothingHere) {
    int value = 1;
    const ChildOutcome outcome = run_in_child([&] { return std::to_string(++value); }, kLimits);
    EXPECT_EQ(outcome.output, "2");
    EXPECT_EQ(value, 1);
}

TEST(ChildProcess, ACrashIsAnOutcome) {
    EXPECT_EQ(run_in_child([]() -> std::string { std::abort(); }, kLimits).end, End::crashed);
    EXPECT_EQ(run_in_child([]() -> std::string { throw std::runtime_error("no"); }, kLimits).end, End::crashed);
    EXPECT_EQ(run_in_child(
                  []() -> std::string {
                      raise(SIGSEGV);
                      return {};
                  },
                  kLimits)
                  .end,
              End::crashed);
    EXPECT_EQ(run_in_child([]() -> std::string { _exit(7); }, kLimits).end, End::crashed);
    // And the next one is as the first.
    EXPECT_EQ(run_in_child([] { return std::string("fine"); }, kLimits).output, "fine");
}

TEST(ChildProcess, WhatNeverEndsIsEnded) {
    const auto start = std::chrono::steady_clock::now();
    const ChildLimits one_second{size_t{1} << 30, 1};
    const auto spin = []() -> std::string {
        for (std::atomic<int> i = 0;;) ++i;
    };
    EXPECT_EQ(run_in_child(spin, one_second).end, End::out_of_time);
    // One that waits takes no processor time.
    EXPECT_EQ(run_in_child(
                  []() -> std::string {
                      for (;;) pause();
                  },
                  one_second)
                  .end,
              End::out_of_time);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

#ifndef __SANITIZE_ADDRESS__
TEST(ChildProcess, MemoryIsBounded) {
    const auto allocate = [](size_t bytes) {
        return run_in_child([=] { return std::to_string(std::vector<char>(bytes).size()); }, {size_t{64} << 20, 2}).end;
    };
    EXPECT_EQ(allocate(size_t{8} << 20), End::finished);
    EXPECT_EQ(allocate(size_t{256} << 20), End::crashed);
}
#endif

}  // namespace
}  // namespace stairstep
