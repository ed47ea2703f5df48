#include "stimuli/io/transfer_file.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

class TransferFile : public testing::Test {
  protected:
    Transfer read(const std::string& text) {
        write_file(folder_.path() / "table.csv", text);
        return read_transfer("table.csv", folder_.path());
    }
    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    TemporaryFolder folder_;
};

TEST_F(TransferFile, LevelsRunTo1Or255AndLuminanceInAnyUnit) {
    const Transfer bytes = read("level,luminance\n0,0.5\n51,20\n255,100\n");
    const Transfer shares = read("luminance,level\n0.5,0\n20,0.2\n100,1\n");
    EXPECT_EQ(bytes.name(), shares.name());
    EXPECT_NEAR(bytes.encode(0.2), 0.2, 1e-15);
    EXPECT_NEAR(bytes.encode(0.6), 0.6, 1e-15);
    EXPECT_NEAR(bytes.decode(0), 0.005, 1e-15);
}

TEST_F(TransferFile, KeepsATableUnderItsNameAndReadsTheSame) {
    const Transfer table = read("level,luminance\n0,0.3\n100,17.1\n200,55.7\n255,91.3\n");
    write_transfer_table(folder_.path(), table);
    EXPECT_EQ(read_transfer(table.name(), folder_.path()).name(), table.name());
    const auto count = [&] { return std::distance(std::filesystem::directory_iterator(folder_.path()), {}); };
    const auto before = count();
    write_transfer_table(folder_.path(), *Transfer::named("srgb"));
    EXPECT_EQ(count(), before);
}

TEST_F(TransferFile, NamesTheLineThatIsWrong) {
    const auto names = [](const std::string& error, const char* part) {
        return error.find(part) != std::string::npos ? "" : "\"" + error + "\" doesn't name " + part;
    };
    EXPECT_EQ(names(error_of("level,luminance\n0,1\n1,2\n1,3\n"), "line 4, column level"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,1\n0.5,5\n1,5\n"), "line 4, column luminance"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,1\n0.5,5\n0.7,4\n1,9\n"), "line 4, column luminance"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,-1\n1,5\n"), "line 2"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,0\n1,nan\n"), "line 3"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0.1,0\n1,1\n"), "line 2"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,0\n254,1\n"), "line 3"), "");
    EXPECT_EQ(names(error_of("level,luminance\n0,0\n"), "two measurements"), "");
    // 5e-324 is the least double; divided by 255 it is 0.
    EXPECT_EQ(names(error_of("level,luminance\n0,0\n5e-324,0.5\n255,1\n"), "line 3, column level"), "");
    EXPECT_EQ(names(error_of("level,cd\n0,0\n1,1\n"), "\"luminance\""), "");
    EXPECT_THROW(read_transfer("absent.csv", folder_.path()), InputError);
    EXPECT_THROW(read_transfer("", folder_.path()), InputError);
}

}  // namespace
}  // namespace stairstep
