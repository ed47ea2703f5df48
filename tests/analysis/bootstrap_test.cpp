#include "analysis/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics.h"

namespace stairstep {
namespace {

/// Statistic of some of the values.
Statistic mean_of(const std::vector<double>& values) {
    return [&values](std::span<const size_t> indices) {
        double sum = 0;
        for (const size_t i : indices) sum += values[i];
        return sum / static_cast<double>(indices.size());
    };
}

Statistic variance_of(const std::vector<double>& values) {
    return [&values](std::span<const size_t> indices) {
        const double mean = mean_of(values)(indices);
        double squares = 0;
        for (const size_t i : indices) squares += (values[i] - mean) * (values[i] - mean);
        return squares / static_cast<double>(indices.size());
    };
}

TEST(Bca, IsEfronAndTibshiranisOnTheSpatialTest) {
    // Efron & Tibshirani (1993), ch. 14: 26 children's scores A, variance 171.5, a = .061, z0 = .146 and the 90 % interval
    // [115.8, 259.6], from 2,000 replicates of theirs.
    const std::vector<double> scores{48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                     0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};
    const BcaInterval bca = bca_interval(26, variance_of(scores), 0.9, {.replicates = 20000, .seed = 3, .jobs = 2});
    EXPECT_NEAR(bca.estimate, 171.5, 0.05);
    EXPECT_NEAR(bca.acceleration, 0.061, 5e-4);
    EXPECT_NEAR(bca.bias_correction, 0.146, 0.085);  // theirs has an SD of .028, from 2,000 replicates
    EXPECT_NEAR(bca.interval.first, 115.8, 3);
    EXPECT_NEAR(bca.interval.second, 259.6, 6);
}

TEST(Bca, AcceleratesAMeanByItsSkewness) {
    // The jackknife's d_j are (x_j − x̄)/(n − 1): a = Σ(x − x̄)³/(6·(Σ(x − x̄)²)^{3/2}).
    const std::vector<double> values{1, 2, 2.5, 3, 9};
    double squares = 0, cubes = 0;
    for (const double v : values) {
        squares += (v - 3.5) * (v - 3.5);
        cubes += (v - 3.5) * (v - 3.5) * (v - 3.5);
    }
    const BcaInterval bca = bca_interval(5, mean_of(values), 0.95, {.replicates = 500});
    EXPECT_NEAR(bca.acceleration, cubes / (6 * std::pow(squares, 1.5)), 1e-12);
}

TEST(Bca, IsNormalWhereNothingNeedsCorrecting) {
    // Of a symmetric sample's mean: ±1.96·sd/√n with divisor n, here of 200 even values.
    std::vector<double> values;
    for (int i = 0; i < 200; ++i) values.push_back(i - 99.5);
    const BcaInterval bca = bca_interval(200, mean_of(values), 0.95, {.replicates = 20000, .seed = 9, .jobs = 2});
    const double half_width = 1.959964 * std::sqrt((200.0 * 200 - 1) / 12 / 200);  // variance of 200 even values
    EXPECT_NEAR(bca.interval.first, -half_width, 0.03 * half_width);
    EXPECT_NEAR(bca.interval.second, half_width, 0.03 * half_width);
}

TEST(Bca, SameSeedSameBytesOnAnyNumberOfThreads) {
    const std::vector<double> values{1, 2, 2.5, 3, 9, 4, 1.5};
    const auto with = [&](uint64_t seed, int jobs) {
        return bca_interval(7, mean_of(values), 0.95, {.replicates = 2000, .seed = seed, .jobs = jobs}).interval;
    };
    EXPECT_EQ(with(1, 1), with(1, 2));
    EXPECT_EQ(with(1, 1), with(1, 5));
    EXPECT_NE(with(1, 1), with(2, 1));
}

TEST(Bca, OfEqualValuesIsAPoint) {
    const std::vector<double> values(6, 2.0);
    EXPECT_EQ(bca_interval(6, mean_of(values), 0.95, {.replicates = 300}).interval, std::pair(2.0, 2.0));
    const std::vector<double> two{1, 3};
    const BcaInterval bca = bca_interval(2, mean_of(two), 0.95, {.replicates = 300});
    EXPECT_TRUE(1 <= bca.interval.first && bca.interval.second <= 3);
}

TEST(StudentisedInterval, IsStudentsTForNormalStudies) {
    const StudyEstimate estimate{2, 0.5};
    const auto simulate = [](Random random) {
        std::vector<double> values;
        for (int j = 0; j < 6; ++j) values.push_back(2 + random.normal());
        const MeanEstimate mean = mean_with_interval(values);
        return StudyEstimate{mean.mean, mean.sd / std::sqrt(6.0)};
    };
    const auto one = studentised_interval(estimate, simulate, {.replicates = 40000, .seed = 1, .jobs = 1});
    const auto two = studentised_interval(estimate, simulate, {.replicates = 40000, .seed = 1, .jobs = 2});
    EXPECT_EQ(one, two);
    const double half_width = t_quantile(0.975, 5) * 0.5;
    EXPECT_NEAR(one.first, 2 - half_width, 0.03 * half_width);
    EXPECT_NEAR(one.second, 2 + half_width, 0.03 * half_width);
}

}  // namespace
}  // namespace stairstep
