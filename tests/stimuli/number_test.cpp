#include "stimuli/number.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

RC_GTEST_PROP(Number, ReadsBackWhatItWrote, (double value)) {
    RC_PRE(std::isfinite(value));
    RC_ASSERT(parse_number(format_number(value)) == value);
}

TEST(Number, ParsesOnlyWholeFiniteNumbers) {
    EXPECT_EQ(parse_number("12.5"), 12.5);
    EXPECT_EQ(parse_number("-1e-3"), -1e-3);
    for (const char* text : {"", " 1", "1 ", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5"}) {
        EXPECT_FALSE(parse_number(text)) << text;
    }
}

TEST(Number, ListsTakeValuesAndRanges) {
    EXPECT_EQ(parse_number_list("5,10,20", "--x"), (std::vector<double>{5, 10, 20}));
    EXPECT_EQ(parse_number_list("0:2:6", "--x"), (std::vector<double>{0, 2, 4, 6}));
    EXPECT_EQ(parse_number_list("0:0.1:0.3", "--x").size(), 4u);  // 0.3 is met up to rounding
    EXPECT_EQ(parse_number_list("1,2:3:9", "--x"), (std::vector<double>{1, 2, 5, 8}));
    for (const char* text : {"1,,2", "a", "1:2", "0:0:5", "5:1:0", "0:1e-9:1", "1,nan"}) {
        EXPECT_THROW(parse_number_list(text, "--x"), InputError) << text;
    }
}

}  // namespace
}  // namespace stairstep
