#include "stimuli/io/stimulus_table.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"
#include "stimuli/grid.h"
#include "stimuli/io/manifest.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

class StimulusTable : public testing::Test {
  protected:
    std::vector<Stimulus> read(const std::string& text) {
        write_file(folder_.path() / "grid.csv", text);
        return read_grid(folder_.path() / "grid.csv", {.width_px = 64, .height_px = 48});
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

TEST_F(StimulusTable, ReadsRowsInAnyColumnOrder) {
    const auto stimuli = read(
        "radius_px,texel_px,pattern,kernel,contrast,silhouette\n"
        "17.5,10,stair,box,0.5,stair\n0,0.1,line,box,1,stair\n");
    ASSERT_EQ(stimuli.size(), 2u);
    EXPECT_EQ(file_stem(stimuli[0]), "stair_box_a10_r17.5_c0.5");
    EXPECT_EQ(file_stem(stimuli[1]), "line-of-stair_box_a0.1_r0_c1");
    EXPECT_EQ(stimuli[0].width_px, 64);
}

TEST_F(StimulusTable, NamesTheLineThatIsWrong) {
    const std::string header = "pattern,kernel,contrast,texel_px,radius_px,width_px,silhouette\n";
    const std::string good = "step,box,1,10,35,640,step\n";
    for (const char* bad :
         {"blob,box,1,10,35,640,step", "step,cone,1,10,35,640,step", "step,box,0,10,35,640,step",
          "step,box,1.5,10,35,640,step", "step,box,1,-10,35,640,step", "step,box,1,nan,35,640,step",
          "step,box,1,10,-1,640,step", "step,box,1,10,1e39,640,step", "step,box,1,10,35,1000000000,step",
          "step,box,1,10,35,12.5,step", "line,box,1,10,35,640,line", "step,box,1,10,35,640,stair", "step,box,1,10"}) {
        const std::string error = error_of(header + good + bad + "\n");
        EXPECT_NE(error.find("line 3"), std::string::npos) << bad << ": " << error;
    }
    EXPECT_EQ(error_of(header + good), "");
    EXPECT_NE(error_of("pattern,kernel,contrast,texel_px,radius_px\nline,box,1,10,35\n").find("line 2"),
              std::string::npos);
}

TEST_F(StimulusTable, RefusesUnknownAndMissingColumns) {
    EXPECT_NE(error_of("pattern,kernel,contrast,texel_px,radius_px,colour\nstep,box,1,10,35,red\n").find("\"colour\""),
              std::string::npos);
    EXPECT_NE(error_of("pattern,kernel,contrast,texel_px\nstep,box,1,10\n").find("\"radius_px\""), std::string::npos);
    EXPECT_NE(error_of("pattern,kernel,contrast,texel_px,radius_px\n").find("no stimulus"), std::string::npos);
}

TEST_F(StimulusTable, ManifestReadsBackAsItWasWritten) {
    const StimulusGrid grid;
    const std::vector<Stimulus> stimuli = stimuli_of(grid);
    const Rendition rendition{{ImageFormat::tif, 16, *Transfer::named("gamma=2.2"), Dither::ordered}, "exact", 60.5};
    write_manifest(folder_.path() / "stimuli.csv", stimuli, rendition);
    const CsvTable manifest = CsvTable::read(folder_.path() / "stimuli.csv");
    const std::vector<std::string> first(manifest.header().begin(), manifest.header().begin() + 8);
    EXPECT_EQ(first, (std::vector<std::string>{"file", "pattern", "kernel", "contrast", "texel_px", "radius_px",
                                               "width_px", "height_px"}));
    ASSERT_EQ(manifest.row_count(), stimuli.size());
    for (size_t row = 0; row < manifest.row_count(); ++row) {
        const ManifestEntry entry = manifest_entry(manifest, row, folder_.path());
        EXPECT_EQ(description(entry.stimulus, entry.rendition), description(stimuli[row], rendition));
        EXPECT_EQ(entry.rendition.encoding.format, ImageFormat::tif);
    }
}

TEST_F(StimulusTable, ManifestThatNamesAnotherFileIsRefused) {
    const std::string header = "file,pattern,kernel,contrast,texel_px,radius_px,source,transfer,bits\n";
    const auto entry = [&](const std::string& row) {
        return manifest_entry(CsvTable::parse(header + row + "\n", "stimuli.csv"), 0, folder_.path());
    };
    EXPECT_EQ(entry("step_box_a10_r35_c1.png,step,box,1,10,35,exact,linear,8").rendition.encoding.bits, 8);
    EXPECT_THROW(entry("../step_box_a10_r35_c1.png,step,box,1,10,35,exact,linear,8"), InputError);
    EXPECT_THROW(entry("/etc/passwd,step,box,1,10,35,exact,linear,8"), InputError);
    EXPECT_THROW(entry("step_box_a10_r35_c1.png,step,box,1,10,35,exact,linear,1e300"), InputError);
    EXPECT_THROW(entry("step_box_a10_r35_c1.exr,step,box,1,10,35,exact,linear,8"), InputError);
    EXPECT_THROW(entry("step_box_a10_r35_c1.png,step,box,1,10,35,exact,absent.csv,8"), InputError);
    // Without an end: were it read, this test would have none either.
    EXPECT_THROW(entry("step_box_a10_r35_c1.png,step,box,1,10,35,exact,/dev/zero,8"), InputError);
    EXPECT_THROW(entry("step_box_a10_r35_c1.png,step,box,1,10,35,exact,../../../../../dev/zero,8"), InputError);
}

}  // namespace
}  // namespace stairstep
