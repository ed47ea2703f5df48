#include "stimuli/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stairstep {
namespace {

TEST(Kernel, NamesReadBack) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson}) {
        EXPECT_EQ(kernel_shape_named(name(shape)), shape);
    }
    EXPECT_FALSE(kernel_shape_named("blob"));
}

TEST(Kernel, AxisDeviationEqualsTheIntegralOfTheSquaredOffset) {
    constexpr int kCells = 4000;
    double box = 0, disk = 0, disk_mass = 0, gaussian = 0, gaussian_mass = 0;
    for (int i = 0; i < kCells; ++i) {
        const double x = -1.5 + 3 * (i + 0.5) / kCells;
        const double w = 3.0 / kCells;
        if (std::abs(x) < 1) {
            box += x * x * w / 2;
            disk += x * x * w * std::sqrt(1 - x * x);
            disk_mass += w * std::sqrt(1 - x * x);
        }
        gaussian += x * x * w * std::exp(-x * x / 0.5);
        gaussian_mass += w * std::exp(-x * x / 0.5);
    }
    EXPECT_NEAR(axis_deviation(KernelShape::box), std::sqrt(box), 1e-3);
    EXPECT_NEAR(axis_deviation(KernelShape::disk), std::sqrt(disk / disk_mass), 1e-3);
    EXPECT_NEAR(axis_deviation(KernelShape::gaussian), std::sqrt(gaussian / gaussian_mass), 1e-6);
}

TEST(Kernel, BoxTapsHaveUnitMassAndLieInTheBoxSymmetrically) {
    for (const int side : {1, 2, 5, 16}) {
        double mass = 0, x = 0, y = 0;
        for (const KernelTap& tap : box_taps(side)) {
            mass += tap.weight;
            x += tap.x * tap.weight;
            y += tap.y * tap.weight;
            EXPECT_LT(std::abs(tap.x), 1);
            EXPECT_LT(std::abs(tap.y), 1);
        }
        EXPECT_NEAR(mass, 1, 1e-5);
        EXPECT_NEAR(x, 0, 1e-6);
        EXPECT_NEAR(y, 0, 1e-6);
    }
}

TEST(Kernel, PoissonTapsAreAsManyAsAskedInsideTheDiskAndSpread) {
    for (const int count : {1, 2, 9, 25, 64, 333}) {
        for (const uint64_t seed : {1u, 2u, 99u}) {
            const std::vector<KernelTap> taps = poisson_taps(count, seed);
            ASSERT_EQ(static_cast<int>(taps.size()), count);
            double mass = 0;
            double closest = 4;
            for (size_t i = 0; i < taps.size(); ++i) {
                mass += taps[i].weight;
                EXPECT_LE(std::hypot(taps[i].x, taps[i].y), 1);
                for (size_t j = 0; j < i; ++j) {
                    closest = std::min<double>(closest, std::hypot(taps[i].x - taps[j].x, taps[i].y - taps[j].y));
                }
            }
            EXPECT_NEAR(mass, 1, 1e-5);
            // Random points would come as near as 1/count; a relaxed set keeps more than half the densest packing's distance.
            EXPECT_GT(closest, count == 1 ? 0 : 0.5 * std::sqrt(2 * 3.14159 / (std::sqrt(3.0) * count))) << count;
        }
    }
}

TEST(Kernel, PoissonTapsAreTheSameForTheSameSeedOnly) {
    const auto first = [](uint64_t seed) { return poisson_taps(25, seed).front().x; };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
}

TEST(Kernel, RotationsAreSpreadOverTheCircle) {
    double c = 0, s = 0;
    constexpr int kSide = 100;
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            c += std::cos(rotation_at(column, row, 1)) / (kSide * kSide);
            s += std::sin(rotation_at(column, row, 1)) / (kSide * kSide);
        }
    }
    EXPECT_LT(std::hypot(c, s), 0.03);  // of 10,000 random directions: mean length .0089
    EXPECT_NE(rotation_at(1, 2, 1), rotation_at(2, 1, 1));
}

}  // namespace
}  // namespace stairstep
