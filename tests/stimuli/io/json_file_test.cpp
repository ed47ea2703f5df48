#include "stimuli/io/json_file.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(JsonFile, NamesSourceAndKeyOfWhatIsWrong) {
    const auto json = parse_json(R"({"a": 1, "b": "text", "c": [2, 1], "d": [1, 2]})", "f.json");
    EXPECT_EQ(json_number(json, "a", "f.json"), 1);
    EXPECT_EQ(json_text(json, "b", "f.json"), "text");
    EXPECT_EQ(json_range(json, "d", "f.json"), std::pair(1.0, 2.0));
    EXPECT_THROW(json_number(json, "b", "f.json"), InputError);
    EXPECT_THROW(json_number(json, "z", "f.json"), InputError);
    EXPECT_THROW(json_text(json, "a", "f.json"), InputError);
    EXPECT_THROW(json_range(json, "c", "f.json"), InputError);
    EXPECT_THROW(json_range(json, "a", "f.json"), InputError);
    try {
        json_number(json, "z", "f.json");
    } catch (const InputError& e) {
        EXPECT_TRUE(std::string(e.what()).starts_with("f.json: \"z\" is missing")) << e.what();
    }
    EXPECT_THROW(parse_json("{", "f.json"), InputError);
    EXPECT_THROW(parse_json("[1]", "f.json"), InputError);
    EXPECT_THROW(json_number(parse_json(R"({"a": 1e999})", "f"), "a", "f"), InputError);
}

TEST(JsonFile, RefusesWhatNestsDeeperThanTheStack) {
    const auto nested = [](size_t depth) {
        return "{\"a\": " + std::string(depth, '[') + std::string(depth, ']') + "}";
    };
    EXPECT_NO_THROW(parse_json(nested(50), "f.json"));
    EXPECT_THROW(parse_json(nested(1'000'000), "f.json"), InputError);
}

}  // namespace
}  // namespace stairstep
