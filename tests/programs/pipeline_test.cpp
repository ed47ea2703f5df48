// The pipeline as scripts run it: four programs that hand each other files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/law/law_file.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

class Pipeline : public testing::Test {
  protected:
    CommandResult run(const std::string& command) {
        const CommandResult result =
            run_command("cd " + folder_.path().string() + " && PATH=" + STAIRSTEP_BIN_DIR + ":$PATH && " + command);
        EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.errors;
        return result;
    }
    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

    TemporaryFolder folder_;
};

TEST_F(Pipeline, StimuliAreListedWrittenAndWhatTheyClaim) {
    run("stairstep-stimuli --texel 10 --radius 0,35 --contrast 1,0.5 --size 64x48 --out stimuli --contact-sheet "
        "sheet.png");
    const CsvTable manifest = CsvTable::read(file("stimuli/stimuli.csv"));
    ASSERT_EQ(manifest.row_count(), 4u * 2u * 2u);
    for (size_t row = 0; row < manifest.row_count(); ++row) {
        const Image image = read_image(file("stimuli/" + manifest.text(row, manifest.column("file"))));
        EXPECT_EQ(image.width, manifest.number(row, manifest.column("width_px")));
        EXPECT_EQ(image.height, manifest.number(row, manifest.column("height_px")));
        EXPECT_EQ(image.channels, 1);
        if (manifest.number(row, manifest.column("radius_px")) == 0) {
            const double contrast = manifest.number(row, manifest.column("contrast"));
            EXPECT_EQ(*image.at(0, 0), contrast == 1 ? 255 : 128);
            EXPECT_EQ(*image.at(63, 47), 0);
        }
    }
    EXPECT_GT(read_image(file("sheet.png")).width, 100);
}

TEST_F(Pipeline, AShadowMapDrawsTheSameStimuli) {
    const std::string grid = "stairstep-stimuli --texel 10 --radius 0,15,35 --contrast 1 --size 64x48 --jobs 3 ";
    run(grid + "--out exact");
    run(grid + "--source shadow-map --out drawn");
    const CsvTable manifest = CsvTable::read(file("drawn/stimuli.csv"));
    ASSERT_EQ(manifest.row_count(), 4u * 3u);
    for (size_t row = 0; row < manifest.row_count(); ++row) {
        const bool is_line = manifest.text(row, manifest.column("pattern")) == "line";
        EXPECT_EQ(manifest.text(row, manifest.column("source")), is_line ? "exact" : "shadow-map");
        const std::string name = manifest.text(row, manifest.column("file"));
        const Image exact = read_image(file("exact/" + name));
        const Image drawn = read_image(file("drawn/" + name));
        ASSERT_EQ(drawn.pixels.size(), exact.pixels.size());
        for (size_t i = 0; i < exact.pixels.size(); ++i) EXPECT_NEAR(drawn.pixels[i], exact.pixels[i], 1) << name;
    }
}

TEST_F(Pipeline, OneAndManyThreadsWriteTheSameBytes) {
    run("stairstep-stimuli --texel 5,10 --radius 0:5:20 --size 80x60 --out one --jobs 1");
    run("stairstep-stimuli --texel 5,10 --radius 0:5:20 --size 80x60 --out many --jobs 4");
    EXPECT_EQ(run("diff -r one many").output, "");
}

TEST_F(Pipeline, SameSeedSameStudyAndTheDatabaseAndItsExportGiveTheSameLaw) {
    run("stairstep-study simulate --observers 4 --seed 5 --db a.sqlite && stairstep-study export --db a.sqlite --out "
        "a");
    run("stairstep-study simulate --observers 4 --seed 5 --db b.sqlite && stairstep-study export --db b.sqlite --out "
        "b");
    EXPECT_EQ(read_file(file("a/trials.csv")), read_file(file("b/trials.csv")));
    run("stairstep-analyze fit a.sqlite --out from-database.json");
    run("stairstep-analyze fit a/trials.csv --out from-table.json");
    const Law from_database = read_law(file("from-database.json"));
    const Law from_table = read_law(file("from-table.json"));
    EXPECT_EQ(from_database.slope, from_table.slope);
    EXPECT_EQ(from_database.slope_ci95, from_table.slope_ci95);
    EXPECT_EQ(from_database.conditions.size(), 4u);

    const auto status = nlohmann::json::parse(run("stairstep-study status --db a.sqlite --json").output);
    EXPECT_EQ(status["trials"], from_database.trials);
    EXPECT_EQ(status["sessions"].size(), 4u);
}

TEST_F(Pipeline, AnotherPlantedLawIsFound) {
    run("stairstep-study simulate --observers 8 --seed 11 --law-slope 6 --between-observer-sd 0.05 --db s.sqlite");
    run("stairstep-analyze fit s.sqlite --out law.json");
    for (const ConditionLaw& law : read_law(file("law.json")).conditions) {
        const double planted = 6 * (law.pattern == Pattern::stair ? 2.5 / 3.47 : 1) * (law.contrast == 1 ? 1 : 0.96);
        EXPECT_NEAR(std::log(law.slope / planted), 0, 0.12) << name(law.pattern) << law.contrast;
    }
}

TEST_F(Pipeline, TheRendererTakesTheLawThatTheAnalysisWrote) {
    run("stairstep-study simulate --observers 3 --seed 2 --db s.sqlite && stairstep-analyze fit s.sqlite --out "
        "law.json");
    const double slope = read_law(file("law.json")).slope;
    const int size = std::stoi(run("stairstep-render size --law law.json --radius 0.4 --extent 28").output);
    EXPECT_EQ(size, static_cast<int>(std::ceil(slope * 28 / 0.4)));
    EXPECT_EQ(run("stairstep-render size --law kreuzer2017 --radius 0.4 --extent 28").output, "243\n");
}

}  // namespace
}  // namespace stairstep
