#include "stimuli/io/csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdio>
#include <memory>

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
        written.push_back({text, "\"q\",\n"});
        writer.row(written.back());
    }
    const CsvTable table = CsvTable::parse(writer.text(), "test");
    RC_ASSERT(table.row_count() == written.size());
    for (size_t i = 0; i < written.size(); ++i) {
        RC_ASSERT(table.text(i, 0) == written[i][0]);
        RC_ASSERT(table.text(i, 1) == written[i][1]);
    }
}

TEST(Csv, KeepsSpacesAroundAField) {
    CsvWriter writer;
    writer.row({"a", "b"});
    writer.row({" x", "y\t"});
    const CsvTable table = CsvTable::parse(writer.text(), "test");
    EXPECT_EQ(table.text(0, 0), " x");
    EXPECT_EQ(table.text(0, 1), "y\t");
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

/// All of a stream's rows, or the error's text alone.
std::vector<std::vector<std::string>> streamed(const std::string& text) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
    std::fwrite(text.data(), 1, text.size(), file.get());
    std::rewind(file.get());
    std::vector<std::vector<std::string>> rows;
    try {
        CsvStream stream(file.get(), "t.csv");
        const size_t x = stream.column("x");
        const size_t y = stream.column("y");
        while (stream.next()) rows.push_back({std::string(stream.text(x)), std::string(stream.text(y))});
    } catch (const InputError& e) {
        return {{e.what()}};
    }
    return rows;
}

RC_GTEST_PROP(CsvStream, ReadsWhatTheTableReads, (const std::vector<std::pair<std::string, std::string>>& rows)) {
    CsvWriter writer;
    writer.row({"y", "x"});
    for (const auto& [y, x] : rows) {
        if ((y + x).find('\0') == std::string::npos) writer.row({"\"" + y + "\n", "a" + x + "\r\n,"});
    }
    const CsvTable table = CsvTable::parse(writer.text(), "t.csv");
    const auto read = streamed(writer.text());
    RC_ASSERT(read.size() == table.row_count());
    for (size_t i = 0; i < read.size(); ++i) {
        RC_ASSERT(read[i][0] == table.text(i, 1));
        RC_ASSERT(read[i][1] == table.text(i, 0));
    }
}

TEST(CsvStream, TakesAnyEndOfLineAndManyBlocks) {
    const std::vector<std::vector<std::string>> expected{{"1", "2"}, {"3", "4"}};
    EXPECT_EQ(streamed("x,y\n1,2\n3,4\n"), expected);
    EXPECT_EQ(streamed("\xEF\xBB\xBFx,y\r\n1,2\r\n\r\n3,4"), expected);
    EXPECT_EQ(streamed("x,y\r1,2\r3,4\r"), expected);
    std::string text = "x,y\r\n";
    for (int i = 0; i < 50000; ++i) text += std::to_string(i) + "," + std::to_string(2 * i) + "\r\n";
    const auto rows = streamed(text);
    ASSERT_EQ(rows.size(), 50000u);
    for (size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i], (std::vector<std::string>{std::to_string(i), std::to_string(2 * i)}));
    }
}

TEST(CsvStream, ErrorsNameTheLine) {
    const auto error = [](const std::string& text) { return streamed(text).at(0).at(0); };
    EXPECT_TRUE(error("").starts_with("t.csv: is empty"));
    EXPECT_TRUE(error("\n\n").starts_with("t.csv: is empty"));
    EXPECT_TRUE(error("x,z\n1,2\n").starts_with("t.csv: has no column \"y\""));
    EXPECT_TRUE(error("x,x\n1,2\n").starts_with("t.csv: line 1 names a column twice"));
    // Blank lines count, as in an editor; so do the lines within a quoted field.
    EXPECT_TRUE(error("x,y\n1,2\n\n3\n").starts_with("t.csv: line 4 has 1 fields where the header has 2"));
    EXPECT_TRUE(error("x,y\r\n1,2\r\n\r\n3\r\n").starts_with("t.csv: line 4 has 1 fields"));
    EXPECT_TRUE(error("x,y\n\"1\n\n\",2\n3\n").starts_with("t.csv: line 5 has 1 fields"));
    EXPECT_TRUE(error("x,y\n1,2\n\"3,4\n5,6\n").starts_with("t.csv: line 3 has a stray or unclosed quote"));
    EXPECT_TRUE(error("x,y\n1,2\n\"" + std::string(3 << 20, 'a')).starts_with("t.csv: line 3 is longer than 1 MiB"));
    EXPECT_TRUE(error("x,y\n\"" + std::string(2 << 20, '\n')).starts_with("t.csv: line 2 is longer than 1 MiB"));
    EXPECT_TRUE(error(std::string("x,y\n1,\0\n", 9)).starts_with("t.csv: is no text"));
}

}  // namespace
}  // namespace stairstep
