#include "stimuli/io/utf8.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(Utf8, KnowsTheEdgesOfItsForms) {
    for (const char* good : {"", "a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
                             "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "M\xc3\xbcller"}) {
        EXPECT_TRUE(is_utf8(good)) << good;
    }
    for (const char* bad :
         {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xed\xbf\xbf", "\xf0\x8f\xbf\xbf",
          "\xf4\x90\x80\x80", "\xf8\x80\x80\x80\x80", "\xff", "\xc3", "\xe2\x82", "M\xfcller"}) {
        EXPECT_FALSE(is_utf8(bad)) << bad;
    }
}

TEST(Utf8, AgreesWithTheJsonLibrary) {
    // Bytes that matter, so that both answers are frequent.
    constexpr uint8_t kBytes[] = {0x41, 0x80, 0x8f, 0x90, 0x9f, 0xa0, 0xbf, 0xc2,
                                  0xdf, 0xe0, 0xed, 0xef, 0xf0, 0xf4, 0xf5};
    Random random(1);
    int good = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text;
        for (uint64_t left = random.below(4) + 1; left > 0; --left) {
            text += static_cast<char>(kBytes[random.below(std::size(kBytes))]);
        }
        bool dumps = true;
        try {
            nlohmann::json(text).dump();
        } catch (const nlohmann::json::type_error&) {
            dumps = false;
        }
        EXPECT_EQ(is_utf8(text), dumps) << i;
        good += dumps;
    }
    EXPECT_GT(good, 500);
}

}  // namespace
}  // namespace stairstep
