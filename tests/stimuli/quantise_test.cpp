#include "stimuli/quantise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace stairstep {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

double mean_shown(const std::vector<float>& levels, const Transfer& transfer, int bits) {
    double sum = 0;
    for (const float level : levels) sum += transfer.decode(level / ((1 << bits) - 1.0));
    return sum / static_cast<double>(levels.size());
}

TEST(Quantise, RoundsToTheNearestLevelAndTiesUp) {
    const std::vector<double> luminance{0, 0.5, 1, 100.49 / 255, 100.51 / 255, 0.25};
    EXPECT_EQ(quantise(luminance, 3, {}, 8, Dither::none), (std::vector<float>{0, 128, 255, 100, 101, 64}));
    EXPECT_EQ(quantise(luminance, 3, {}, 16, Dither::none), (std::vector<float>{0, 32768, 65535, 25826, 25831, 16384}));
    // 0.735357·255 = 187.5 − 0.016 and 0.735357·65535 = 48191.6
    const Transfer srgb = *Transfer::named("srgb");
    EXPECT_EQ(quantise({{0.5}}, 1, srgb, 8, Dither::none), std::vector<float>{188});
    EXPECT_EQ(quantise({{0.5}}, 1, srgb, 16, Dither::none), std::vector<float>{48192});
}

TEST(Quantise, DitherKeepsTheMeanLuminanceThatIsShown) {
    const Transfer table = Transfer::table({{0, 0.02}, {0.5, 0.3}, {1, 1}});
    for (const Transfer& transfer : {Transfer(), *Transfer::named("srgb"), *Transfer::named("gamma=2.2"), table}) {
        for (const double luminance : {0.03, 0.18, 0.5004, 0.7531, 0.9999}) {
            const std::vector<double> field(kWidth * kHeight, luminance);
            // The widest step between two levels near this luminance.
            const double level = std::floor(transfer.encode(luminance) * 255);
            const double step = transfer.decode((level + 1) / 255) - transfer.decode(level / 255);
            const auto mean = [&](Dither dither) {
                return mean_shown(quantise(field, kWidth, transfer, 8, dither), transfer, 8);
            };
            EXPECT_NEAR(mean(Dither::ordered), luminance, step * 1.001 / 128) << transfer.name();
            // What the last row owes below it is lost: at most half a step a pixel of that row.
            EXPECT_NEAR(mean(Dither::error_diffusion), luminance, step * 0.5 / kHeight) << transfer.name();
        }
    }
}

TEST(Quantise, DitherTakesTheLevelsAroundTheValueAlone) {
    const std::vector<double> field(kWidth * kHeight, 100.3 / 255);
    for (const Dither dither : {Dither::ordered, Dither::error_diffusion}) {
        const std::vector<float> levels = quantise(field, kWidth, {}, 8, dither);
        EXPECT_EQ(std::set<float>(levels.begin(), levels.end()), (std::set<float>{100, 101})) << name(dither);
    }
}

TEST(Quantise, DitherLeavesWhatLevelsHoldExactly) {
    for (const Dither dither : {Dither::ordered, Dither::error_diffusion}) {
        for (const int bits : {8, 16}) {
            for (const double luminance : {0.0, 0.2, 1.0}) {  // 51/255 and 13107/65535
                const std::vector<double> field(kWidth * kHeight, luminance);
                EXPECT_EQ(quantise(field, kWidth, {}, bits, dither), quantise(field, kWidth, {}, bits, Dither::none));
            }
        }
    }
}

TEST(Quantise, OrderedDitherFollowsBayersMatrix) {
    // 37/64 of the way between two levels: the 37 places of the lowest ranks go up in every 8 × 8 block.
    const std::vector<double> field(64, (100 + 37.0 / 64) / 255);
    const std::vector<float> levels = quantise(field, 8, {}, 8, Dither::ordered);
    EXPECT_EQ(std::count(levels.begin(), levels.end(), 101.0f), 37);
    // Bayer's 2 × 2 pattern (0 2; 3 1): at a quarter only every second column of every second row goes up.
    const std::vector<float> quarter = quantise(std::vector<double>(64, 100.25 / 255), 8, {}, 8, Dither::ordered);
    for (int i = 0; i < 64; ++i) EXPECT_EQ(quarter[i], i % 8 % 2 == 0 && i / 8 % 2 == 0 ? 101 : 100) << i;
}

TEST(Quantise, NamesReadBack) {
    for (const Dither dither : {Dither::none, Dither::ordered, Dither::error_diffusion}) {
        EXPECT_EQ(dither_named(name(dither)), dither);
    }
    EXPECT_FALSE(dither_named("noise"));
}

}  // namespace
}  // namespace stairstep
