#include "renderer/shadow_settings.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(SkipsWithout, NothingLeavesAllOn) {
    const Skips skips = skips_without("");
    EXPECT_EQ(skips, Skips{});
    for (const SkipName& skip : kSkips) EXPECT_TRUE(skips.*skip.skip) << skip.name;
}

TEST(SkipsWithout, AllTurnsEveryOneOff) {
    for (const std::string names : {"all", "even-texels,all", "all,unseen-shadows"}) {
        const Skips skips = skips_without(names);
        for (const SkipName& skip : kSkips) EXPECT_FALSE(skips.*skip.skip) << names << ": " << skip.name;
    }
    // The list of names has every member: of those left out none is false now.
    EXPECT_EQ(sizeof(Skips), std::size(kSkips) * sizeof(bool));
}

TEST(SkipsWithout, ANameTurnsOffItsOwnAlone) {
    for (const SkipName& named : kSkips) {
        const Skips skips = skips_without(std::string(named.name));
        for (const SkipName& skip : kSkips) EXPECT_EQ(skips.*skip.skip, skip.name != named.name) << named.name;
    }
}

TEST(SkipsWithout, ListsAreUnions) {
    for (const SkipName& a : kSkips) {
        for (const SkipName& b : kSkips) {
            Skips wanted;
            wanted.*a.skip = false;
            wanted.*b.skip = false;
            EXPECT_EQ(skips_without(std::string(a.name) + "," + std::string(b.name)), wanted);
        }
    }
    EXPECT_EQ(skips_without(kDrawsUnchanged), skips_without("unchanged-pixels,unchanged-maps"));
}

TEST(SkipsWithout, OtherNamesAreErrorsThatListAll) {
    for (const std::string names :
         {"shadows", "even-texels,", ",all", "even-texels, all", "ALL", "all;all", "hidden"}) {
        try {
            skips_without(names);
            ADD_FAILURE() << "accepted \"" << names << "\"";
        } catch (const InputError& e) {
            const std::string text = e.what();
            EXPECT_NE(text.find("--no-skip"), std::string::npos);
            EXPECT_NE(text.find("all"), std::string::npos);
            for (const SkipName& skip : kSkips) EXPECT_NE(text.find(skip.name), std::string::npos) << skip.name;
        }
    }
}

}  // namespace
}  // namespace stairstep
