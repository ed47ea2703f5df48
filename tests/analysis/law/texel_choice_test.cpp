#include "analysis/law/texel_choice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

rc::Gen<double> needs() {
    return rc::gen::map(rc::gen::inRange(-4000, 4000), [](int i) { return std::exp2(i / 200.0); });
}

RC_GTEST_PROP(TexelLadder, RungIsTheLargestOfFourBitsNotAbove, ()) {
    const double needed = *needs();
    const double rung = texel_on_ladder(needed);
    RC_ASSERT(rung <= needed);
    RC_ASSERT(needed < rung * 1.125 + 1e-12 * rung);
    int exponent = 0;
    const double eighths = std::frexp(rung, &exponent) * 16;
    RC_ASSERT(eighths == std::floor(eighths));
    RC_ASSERT(texel_on_ladder(rung) == rung);
}

TEST(TexelLadder, HasEightRungsAnOctave) {
    int rungs = 0;
    double last = 0;
    for (double needed = 1; needed < 2; needed += 0.001) {
        const double rung = texel_on_ladder(needed);
        rungs += rung != last;
        last = rung;
    }
    EXPECT_EQ(rungs, 8);
}

RC_GTEST_PROP(TexelChoice, IsNeverTooCoarse, ()) {
    TexelChoice choice;
    for (const double needed : *rc::gen::container<std::vector<double>>(needs())) {
        choice = choose_texel(choice, needed, {1.25, 3});
        RC_ASSERT(choice.texel <= texel_on_ladder(needed));
    }
}

RC_GTEST_PROP(TexelChoice, SettlesForGood, ()) {
    TexelChoice choice{*needs(), 0, 0};
    const double needed = *needs();
    const TexelPatience patience;
    for (int i = 0; i < patience.frames; ++i) choice = choose_texel(choice, needed, patience);
    const TexelChoice settled = choice;
    for (int i = 0; i < 100; ++i) {
        choice = choose_texel(choice, needed, patience);
        RC_ASSERT(choice.texel == settled.texel);
    }
    // No coarser one would do by more than the dead band and a rung.
    RC_ASSERT(texel_on_ladder(needed) < settled.texel * patience.dead_band);
}

TEST(TexelChoice, WithinTheDeadBandOnlyFinerEver) {
    TexelChoice choice = choose_texel({}, 1.0);
    int changes = 0;
    for (int i = 0; i < 1000; ++i) {
        const TexelChoice next = choose_texel(choice, 1.0 + 0.12 * std::sin(i * 0.1));
        changes += next.texel != choice.texel;
        EXPECT_LE(next.texel, choice.texel);
        choice = next;
    }
    EXPECT_LE(changes, 2) << "two rungs lie below the first";
    EXPECT_EQ(choice.texel, 0.875);
}

TEST(TexelChoice, FinerAtOnceCoarserLate) {
    const TexelPatience patience{1.25, 30};
    TexelChoice choice = choose_texel({}, 1.0, patience);
    EXPECT_EQ(choice.texel, 1);
    choice = choose_texel(choice, 0.3, patience);
    EXPECT_EQ(choice.texel, texel_on_ladder(0.3));
    int frames = 0;
    while (choice.texel < 1) {
        choice = choose_texel(choice, 1.0, patience);
        ++frames;
    }
    EXPECT_EQ(frames, 30);
}

// A finer need on the way starts the wait anew; what was needed on the way bounds what is chosen after it.
TEST(TexelChoice, WaitsForTheFinestOfTheWait) {
    const TexelPatience patience{1.25, 10};
    TexelChoice choice = choose_texel({}, 1.0, patience);
    for (int i = 0; i < 9; ++i) choice = choose_texel(choice, i == 4 ? 2.0 : 8.0, patience);
    EXPECT_EQ(choice.texel, 1);
    choice = choose_texel(choice, 8.0, patience);
    EXPECT_EQ(choice.texel, 2);
}

TEST(TexelChoice, NoNeedKeepsTheTexel) {
    TexelChoice choice = choose_texel({}, 1.0);
    for (int i = 0; i < 100; ++i) choice = choose_texel(choice, INFINITY);
    EXPECT_EQ(choice.texel, 1);
    EXPECT_EQ(choose_texel({}, INFINITY).texel, 0);
}

}  // namespace
}  // namespace stairstep
