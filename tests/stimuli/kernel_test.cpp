#include "stimuli/kernel.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace stairstep
