#include "study/bench/bench_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "stimuli/io/csv.h"

namespace stairstep {
namespace {

BenchTable made_table() {
    BenchTable table{.name = "made", .title = "Made up", .columns = {"method", "rmse"}};
    table.rows.push_back({{"a, \"b\"", {0.125, 3}}, at_most(0.125, 0.1, 1, 0.01)});
    table.rows.push_back({{"c", {std::nan(""), 2}}, at_least(std::nan(""), 3, 0)});
    table.rows.push_back({{"d", {12.0, 2}}});
    table.notes = {"A note."};
    return table;
}

TEST(BenchTable, BarsAreMetOnTheirOwnSideAndUnknownWithoutAFigure) {
    EXPECT_EQ(at_most(2, 2, 0).met, true);
    EXPECT_EQ(at_most(2.0001, 2, 0).met, false);
    EXPECT_EQ(at_least(0.92, 0.92, 2).met, true);
    EXPECT_EQ(at_least(0.9199, 0.92, 2).met, false);
    EXPECT_EQ(at_most(std::nan(""), 2, 0).met, std::nullopt);
    EXPECT_EQ(at_most(2.5, 2, 0).missed_by_se, std::nullopt);
    EXPECT_EQ(at_most(2.5, 2, 0, 0.25).missed_by_se, 2);
    EXPECT_EQ(at_least(2.5, 2, 0, 0.25).missed_by_se, std::nullopt);
    EXPECT_EQ(at_most(1, 0.0536, 4).text, "<= 0.0536");
}

TEST(BenchTable, TextAlignsNumbersToTheRight) {
    EXPECT_EQ(to_text(made_table()),
              "Made up\n\n"
              "method   rmse  bar     met\n"
              "a, \"b\"  0.125  <= 0.1  NO, by 2.5 SE\n"
              "c              >= 3    unknown\n"
              "d       12.00\n"
              "\nA note.\n");
}

TEST(BenchTable, MarkdownHasARowForEachRow) {
    EXPECT_EQ(to_markdown(made_table()),
              "## Made up\n\n"
              "| method | rmse | bar | met |\n"
              "|---|---:|---|---|\n"
              "| a, \"b\" | 0.125 | <= 0.1 | NO, by 2.5 SE |\n"
              "| c |  | >= 3 | unknown |\n"
              "| d | 12.00 |  |  |\n"
              "\n- A note.\n");
}

TEST(BenchTable, LongNotesAreWrapped) {
    BenchTable table = made_table();
    table.notes = {std::string(100, 'x') + " " + std::string(30, 'y') + " z"};
    const std::string text = to_markdown(table);
    EXPECT_TRUE(text.ends_with("- " + std::string(100, 'x') + "\n  " + std::string(30, 'y') + " z\n")) << text;
}

TEST(BenchTable, CsvAndJsonHaveNumbersInFull) {
    const CsvTable csv = CsvTable::parse(to_csv({made_table()}), "made.csv");
    ASSERT_EQ(csv.header(), (std::vector<std::string>{"table", "row", "column", "value"}));
    ASSERT_EQ(csv.row_count(), 9u);  // 4 + 3 + 2 cells that aren't empty
    EXPECT_EQ(csv.text(0, 3), "a, \"b\"");
    EXPECT_EQ(csv.number(1, 3), 0.125);
    EXPECT_EQ(csv.text(8, 2), "rmse");
    EXPECT_EQ(csv.number(8, 1), 3);

    const auto json = nlohmann::json::parse(to_json({made_table()}).dump()).at("made");
    EXPECT_EQ(json.at("title"), "Made up");
    EXPECT_EQ(json.at("rows").size(), 3u);
    EXPECT_EQ(json.at("rows")[0].at("rmse"), 0.125);
    EXPECT_EQ(json.at("rows")[0].at("met"), false);
    EXPECT_DOUBLE_EQ(json.at("rows")[0].at("missed_by_se").get<double>(), 2.5);
    EXPECT_TRUE(json.at("rows")[1].at("rmse").is_null());
    EXPECT_TRUE(json.at("rows")[1].at("met").is_null());
    EXPECT_FALSE(json.at("rows")[2].contains("bar"));
}

}  // namespace
}  // namespace stairstep
