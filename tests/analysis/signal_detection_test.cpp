#include "analysis/signal_detection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

double phi(double z) {
    return std::erfc(-z / std::sqrt(2.0)) / 2;
}

TEST(SignalDetection, PublishedAndClosedForms) {
    constexpr int n = 100000000;
    const Sensitivity yes_no = sensitivity({84134475, n, 15865525, n}, Task::yes_no);
    EXPECT_NEAR(yes_no.d_prime, 2, 1e-6);
    EXPECT_NEAR(yes_no.criterion, 0, 1e-6);
    // Φ(1/√2) = .76025 right on either side: d′ = 1.
    const Sensitivity two = sensitivity({76024994, n, n - 76024994, n}, Task::two_alternative);
    EXPECT_NEAR(two.d_prime, 1, 1e-6);
    // Macmillan & Creelman's (2005, p. 8) observer: H = .8, F = .4 give d′ = 1.095, c = −.294.
    const Sensitivity classic = sensitivity({80000000, n, 40000000, n}, Task::yes_no);
    EXPECT_NEAR(classic.d_prime, 1.095, 5e-4);
    EXPECT_NEAR(classic.criterion, -0.294, 5e-4);
}

TEST(SignalDetection, IsFiniteAtRatesOfZeroAndOne) {
    const Sensitivity s = sensitivity({20, 20, 0, 20}, Task::yes_no);
    // Φ⁻¹(20.5/21) = 1.98075…, twice.
    EXPECT_NEAR(phi(s.d_prime / 2), 20.5 / 21, 1e-12);
    EXPECT_NEAR(s.criterion, 0, 1e-14);
    EXPECT_TRUE(std::isfinite(s.d_prime_ci95.first) && std::isfinite(s.d_prime_ci95.second));
    EXPECT_NE(sensitivity({3, 10, 0, 0}, Task::yes_no).reason, "");
    EXPECT_NE(sensitivity({0, 0, 1, 4}, Task::two_alternative).reason, "");
    EXPECT_THROW(sensitivity({11, 10, 0, 5}, Task::yes_no), InputError);
}

TEST(SignalDetection, IntervalsCover) {
    for (const double d_prime : {0.5, 1.5, 2.5}) {
        for (const double criterion : {0.0, 0.5}) {
            const double hit = phi(d_prime / 2 - criterion);
            const double false_alarm = phi(-d_prime / 2 - criterion);
            Random random(3);
            int covered = 0, criterion_covered = 0;
            constexpr int kRuns = 1500;
            for (int run = 0; run < kRuns; ++run) {
                ResponseCounts counts{0, 60, 0, 60};
                for (int i = 0; i < 60; ++i) {
                    counts.hits += random.uniform() < hit;
                    counts.false_alarms += random.uniform() < false_alarm;
                }
                const Sensitivity s = sensitivity(counts, Task::yes_no);
                covered += s.d_prime_ci95.first <= d_prime && d_prime <= s.d_prime_ci95.second;
                criterion_covered += s.criterion_ci95.first <= criterion && criterion <= s.criterion_ci95.second;
            }
            EXPECT_GE(covered, 0.93 * kRuns) << d_prime << " " << criterion;
            EXPECT_LE(covered, 0.985 * kRuns) << d_prime << " " << criterion;
            EXPECT_GE(criterion_covered, 0.93 * kRuns) << d_prime << " " << criterion;
        }
    }
}

TEST(SignalDetection, CountsEvidenceByObserverAndCondition) {
    std::vector<Trial> trials;
    for (int i = 0; i < 80; ++i) {
        Trial trial;
        trial.observer = i % 2 == 0 ? "a" : "b";
        trial.condition.texel_px = i < 40 ? 5 : 10;
        trial.stimulus = i % 4 < 2 ? Judgement::artifact : Judgement::line;
        trial.response = i % 5 == 0 ? Judgement::line : Judgement::artifact;
        trial.is_void = i == 7;
        if (i == 9) trial.kind = TrialKind::practice;
        trials.push_back(trial);
    }
    const std::vector<SensitivityRow> rows = sensitivity_table(trials);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[0].observer, "a");
    EXPECT_EQ(rows[0].condition.texel_px, 5);
    EXPECT_TRUE(rows[4].is_total);
    ResponseCounts sum;
    for (size_t i = 0; i < 4; ++i) {
        sum.hits += rows[i].sensitivity.counts.hits;
        sum.artifacts += rows[i].sensitivity.counts.artifacts;
        sum.false_alarms += rows[i].sensitivity.counts.false_alarms;
        sum.lines += rows[i].sensitivity.counts.lines;
    }
    EXPECT_EQ(sum.artifacts + sum.lines, 78);
    EXPECT_EQ(rows[4].sensitivity.counts.hits, sum.hits);
    EXPECT_EQ(rows[4].sensitivity.counts.lines, sum.lines);
}

}  // namespace
}  // namespace stairstep
