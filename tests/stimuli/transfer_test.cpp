#include "stimuli/transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

/// Black at 2 % of white, and a bend.
Transfer measured() {
    return Transfer::table({{0, 0.02}, {0.25, 0.1}, {0.5, 0.3}, {1, 1}});
}

TEST(Transfer, SrgbGivesTheStandardsValues) {
    const Transfer srgb = *Transfer::named("srgb");
    EXPECT_EQ(srgb.encode(0), 0);
    EXPECT_NEAR(srgb.encode(1), 1, 1e-15);
    EXPECT_NEAR(srgb.encode(0.001), 0.01292, 1e-15);  // on the straight piece, 12.92·L
    EXPECT_NEAR(srgb.encode(0.2140411), 0.5, 1e-7);
    EXPECT_NEAR(srgb.encode(0.18), 0.4613561, 1e-7);
    EXPECT_NEAR(srgb.encode(0.5), 0.7353570, 1e-7);
}

TEST(Transfer, GammaIsAPower) {
    EXPECT_NEAR(Transfer::named("gamma=2")->encode(0.25), 0.5, 1e-15);
    EXPECT_NEAR(Transfer::named("gamma=2.2")->encode(0.5), 0.7297401, 1e-7);  // 2^(−1/2.2)
    EXPECT_EQ(Transfer::named("gamma=1")->encode(0.3), 0.3);
    EXPECT_EQ(Transfer::named("gamma=2.20")->name(), "gamma=2.2");
}

TEST(Transfer, TableIsInterpolatedAndInverted) {
    const Transfer table = measured();
    EXPECT_NEAR(table.encode(0.1), 0.25, 1e-15);
    EXPECT_NEAR(table.encode(0.2), 0.375, 1e-15);  // halfway from 0.1 to 0.3
    EXPECT_NEAR(table.encode(0.65), 0.75, 1e-15);
    EXPECT_NEAR(table.decode(0.75), 0.65, 1e-15);
    EXPECT_EQ(table.encode(1), 1);
    EXPECT_EQ(table.encode(0.01), 0) << "darker than the display's black";
}

TEST(Transfer, DecodingUndoesEncodingAndBothIncrease) {
    for (const Transfer& transfer : {Transfer(), *Transfer::named("srgb"), *Transfer::named("gamma=2.2"),
                                     *Transfer::named("gamma=0.5"), measured()}) {
        double before = -1;
        for (int i = 0; i <= 1000; ++i) {
            const double level = i / 1000.0;
            const double shown = transfer.decode(level);
            EXPECT_NEAR(transfer.encode(shown), level, 1e-6) << transfer.name();  // sRGB's two pieces meet to 1e-7
            EXPECT_GT(shown, before) << transfer.name();
            before = shown;
        }
    }
}

TEST(Transfer, NamesTellTransfersApart) {
    EXPECT_EQ(Transfer().name(), "linear");
    EXPECT_EQ(measured().name(), measured().name());
    EXPECT_NE(measured().name(), Transfer::table({{0, 0.02}, {1, 1}}).name());
    EXPECT_FALSE(Transfer::named("sRGB"));
    EXPECT_FALSE(Transfer::named(""));
    for (const char* text : {"gamma=", "gamma=x", "gamma=0", "gamma=-1", "gamma=nan", "gamma=1e9"}) {
        EXPECT_THROW(Transfer::named(text), InputError) << text;
    }
}

}  // namespace
}  // namespace stairstep
