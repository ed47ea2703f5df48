#include "stimuli/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(Shard, PartsCoverEverythingOnce) {
    std::vector<int> items(101);
    std::iota(items.begin(), items.end(), 0);
    for (const int count : {1, 2, 7, 101, 150}) {
        std::vector<int> together;
        for (int index = 1; index <= count; ++index) {
            const std::vector<int> part = Shard{index, count}.of(items);
            EXPECT_LE(part.size(), 101u / count + 1);
            together.insert(together.end(), part.begin(), part.end());
        }
        std::sort(together.begin(), together.end());
        EXPECT_EQ(together, items) << count;
    }
}

TEST(Shard, ParsesOnlyAPartOfAWhole) {
    EXPECT_EQ(parse_shard("2/4").index, 2);
    EXPECT_EQ(parse_shard("2/4").count, 4);
    for (const char* text : {"", "2", "0/4", "5/4", "-1/4", "1/0", "1.5/4", "1/4/4", "a/b", "1/1e9", "nan/2"}) {
        EXPECT_THROW(parse_shard(text), InputError) << text;
    }
}

}  // namespace
}  // namespace stairstep
