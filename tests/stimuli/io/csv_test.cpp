#include "stimuli/io/csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "stimuli/error.h"

namespace stairstep {
namespace {

RC_GTEST_PROP(Csv, ReadsBackAnyTextItWrote, (const std::vector<std::vector<std::string>>& rows)) {
    CsvWriter writer;
    writer.row({"a", "b"});
    std::vector<std::vector<std::string>> written;
    for (const auto& row : rows) {
        const std::string text = row.empty() ? "" : row.front();
        if (text.find('\0') != std::string::npos) continue;
        // A field keeps its inner spaces; libcsv trims those around an unquoted one.
        written.push_back({"x" + text + "x", "\"q\",\n"});
        writer.row(written.back());
    }
    const CsvTable table = CsvTable::parse(writer.text(), "test");
    RC_ASSERT(table.row_count() == written.size());
    for (size_t i = 0; i < written.size(); ++i) {
        RC_ASSERT(table.text(i, 0) == written[i][0]);
        RC_ASSERT(table.text(i, 1) == written[i][1]);
    }
}

TEST(Csv, FindsColumnsByNameWhateverTheirOrder) {
    const CsvTable table = CsvTable::parse("\xEF\xBB\xBFradius_px,observer\r\n12.5,o1\r\n", "t.csv");
    EXPECT_EQ(table.number(0, table.column("radius_px")), 12.5);
    EXPECT_EQ(table.text(0, table.column("observer")), "o1");
    EXPECT_FALSE(table.find_column("absent"));
}

std::string error_of(const std::string& text) {
    try {
        const CsvTable table = CsvTable::parse(text, "t.csv");
        table.number(0, table.column("x"));
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(Csv, ErrorsNameFileLineAndColumn) {
    EXPECT_TRUE(error_of("").starts_with("t.csv: is empty"));
    EXPECT_TRUE(error_of("y\n1\n").starts_with("t.csv: has no column \"x\""));
    EXPECT_TRUE(error_of("x,x\n1,2\n").starts_with("t.csv: line 1 names a column twice"));
    EXPECT_TRUE(error_of("x,y\n1\n").starts_with("t.csv: line 2 has 1 fields where the header has 2"));
    EXPECT_TRUE(error_of("x\n\"1\n").starts_with("t.csv: line 2 has a stray or unclosed quote"));
    EXPECT_TRUE(error_of("x\nnan\n").starts_with("t.csv: line 2, column x: \"nan\" is no finite number"));
    EXPECT_TRUE(error_of(std::string("x\n1\0\n", 5)).starts_with("t.csv: is no text"));
}

}  // namespace
}  // namespace stairstep
