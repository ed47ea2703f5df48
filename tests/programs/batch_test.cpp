// Batches as a job array runs them: killed, resumed, split, checked.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/stored_image.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "stimuli/random.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// 300 stimuli.
constexpr const char* kGrid =
    "stairstep-stimuli --texel 3,5,8,13,21 --radius 0:1:14 --contrast 1 --size 64x48 --transfer table.csv ";
/// 60 of them.
constexpr const char* kSmallGrid =
    "stairstep-stimuli --texel 3 --radius 0:1:14 --contrast 1 --size 64x48 --transfer table.csv ";
constexpr const char* kTable = "level,luminance\n0,0.4\n64,3\n128,20\n192,51\n255,99\n";

/// Every file of a folder, hidden ones too, with its bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        files[entry.path().filename().string()] = read_file(entry.path());
    }
    return files;
}

class BatchProgram : public testing::Test {
  protected:
    BatchProgram() { write_file(file("table.csv"), kTable); }

    CommandResult attempt(const std::string& command) {
        return run_command("cd " + folder_.path().string() + " && PATH=" + STAIRSTEP_BIN_DIR + ":$PATH && " + command);
    }
    CommandResult run(const std::string& command) {
        const CommandResult result = attempt(command);
        EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.errors;
        return result;
    }
    fs::path file(const std::string& name) const { return folder_.path() / name; }

    TemporaryFolder folder_;
};

TEST_F(BatchProgram, KilledAtAnyMomentAndResumedLeavesTheSameBytes) {
    const auto start = std::chrono::steady_clock::now();
    run(std::string(kGrid) + "--out undisturbed --jobs 2");
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto expected = contents(file("undisturbed"));
    ASSERT_EQ(expected.size(), 302u);  // 300 images, the manifest, the table

    Random random(3);
    int killed = 0;
    int leftovers = 0;
    for (int round = 0; killed < 20 && round < 40; ++round) {
        const std::string out = "out" + std::to_string(round);
        const std::string command = std::string(kGrid) + "--resume --jobs 2 --out " + out;
        for (int kill = 0; kill < 5; ++kill) {
            const std::string moment = format_fixed(0.01 + 0.5 * seconds * random.uniform(), 4);
            if (attempt("timeout -s KILL " + moment + " " + command).exit_code != 137) break;
            ++killed;
            if (!fs::exists(file(out))) continue;
            for (const auto& entry : fs::directory_iterator(file(out))) {
                leftovers += partial_file_stem(entry.path().filename().string()).has_value();
            }
        }
        run(command);
        EXPECT_EQ(contents(file(out)), expected) << round;
        fs::remove_all(file(out));
    }
    EXPECT_GE(killed, 20);
    RecordProperty("killed", killed);
    RecordProperty("leftovers", leftovers);
}

TEST_F(BatchProgram, ResumeWritesNothingTwiceAndRewritesWhatDiffers) {
    run(std::string(kSmallGrid) + "--out a");
    const fs::path image = file("a/step_box_a3_r0_c1.png");
    const auto written = fs::last_write_time(image);
    EXPECT_NE(run(std::string(kSmallGrid) + "--out a --resume").output.find("wrote 0 stimuli"), std::string::npos);
    EXPECT_EQ(fs::last_write_time(image), written);

    const auto before = contents(file("a"));
    fs::remove(file("a/step_box_a3_r1_c1.png"));
    write_stored_image(image, {1, 1, 8, {0}}, "another picture");
    write_file(file("a/step_box_a3_r2_c1.png"), "no picture");
    write_file(file("a/.step_box_a3_r3_c1.partial-123.png"), "half");
    write_file(file("a/.mine.partial-123.png"), "not of this grid");
    EXPECT_NE(run(std::string(kSmallGrid) + "--out a --resume").output.find("wrote 3 stimuli"), std::string::npos);
    EXPECT_TRUE(fs::remove(file("a/.mine.partial-123.png"))) << "removed what wasn't its own";
    EXPECT_EQ(contents(file("a")), before);

    // Another transfer is another picture.
    EXPECT_NE(run("stairstep-stimuli --texel 3 --radius 0 --contrast 1 --size 64x48 --out a --resume")
                  .output.find("wrote 4 stimuli"),
              std::string::npos);
}

TEST_F(BatchProgram, ShardsCoverTheGridAndJoin) {
    run(std::string(kSmallGrid) + "--out whole --jobs 1");
    std::set<std::string> listed;
    for (const char* shard : {"3/4", "1/4", "4/4", "2/4"}) {
        run(std::string(kSmallGrid) + "--out parts --jobs 3 --shard " + shard);
        const std::string name = "parts/stimuli." + std::string(1, shard[0]) + "-of-4.csv";
        const CsvTable part = CsvTable::read(file(name));
        EXPECT_EQ(part.row_count(), 15u);
        for (size_t row = 0; row < part.row_count(); ++row) {
            EXPECT_TRUE(listed.insert(part.text(row, part.column("file"))).second);
        }
        fs::remove(file(name));
    }
    EXPECT_EQ(listed.size(), 60u);
    EXPECT_FALSE(fs::exists(file("parts/stimuli.csv")));
    EXPECT_NE(run(std::string(kSmallGrid) + "--out parts --resume").output.find("wrote 0 stimuli"), std::string::npos);
    EXPECT_EQ(contents(file("parts")), contents(file("whole")));
}

TEST_F(BatchProgram, EveryFormatIsWhatItsManifestSays) {
    for (const char* encoding : {"--bits 8 --dither ordered --transfer table.csv", "--bits 16 --transfer gamma=2.2",
                                 "--format tif --transfer srgb", "--format tif --bits 16 --dither error-diffusion",
                                 "--format exr --transfer table.csv"}) {
        const std::string command =
            "stairstep-stimuli --texel 7 --radius 0,9.5 --contrast 0.7 --size 64x48 "
            "--pixels-per-degree 60 " +
            std::string(encoding);
        run(command + " --jobs 1 --out one");
        run(command + " --jobs 4 --out many");
        EXPECT_EQ(contents(file("one")), contents(file("many"))) << encoding;
        EXPECT_EQ(run("stairstep-stimuli verify one").output, "8 of 8 images are as listed\n") << encoding;
        const CsvTable manifest = CsvTable::read(file("one/stimuli.csv"));
        EXPECT_EQ(manifest.number(0, manifest.column("pixels_per_degree")), 60);
        EXPECT_NE(stored_description(file("one/" + manifest.text(0, 0)))->find(";pixels_per_degree=60"),
                  std::string::npos);
        fs::remove_all(file("one"));
        fs::remove_all(file("many"));
    }
}

TEST_F(BatchProgram, VerifyFindsAFlippedPixelAMissingFileAndAFalseDescription) {
    run("stairstep-stimuli --texel 5 --radius 0:5:20 --contrast 1 --size 64x48 --out s");
    const auto change = [&](const char* name, auto&& edit) {
        const fs::path path = file(name);
        StoredImage image = read_stored_image(path);
        std::string text = *stored_description(path);
        edit(image, text);
        write_stored_image(path, image, text);
    };
    change("s/step_box_a5_r0_c1.png", [](StoredImage& image, std::string&) { image.values[100] = 252; });
    change("s/stair_box_a5_r5_c1.png", [](StoredImage&, std::string& text) { text += "0"; });
    change("s/stair_box_a5_r0_c1.png", [](StoredImage& image, std::string&) { image = {1, 1, 8, {0}}; });
    fs::remove(file("s/step_box_a5_r10_c1.png"));
    write_file(file("s/step_box_a5_r15_c1.png"), "no picture");

    const CommandResult result = attempt("stairstep-stimuli verify s --json");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
    const auto report = nlohmann::json::parse(result.output);
    EXPECT_EQ(report["images"], 20);
    EXPECT_EQ(report["equal"], 15);
    std::map<std::string, std::string> problems;
    for (const auto& fault : report["faults"]) problems[fault["file"]] = fault["problem"];
    EXPECT_EQ(problems, (std::map<std::string, std::string>{{"step_box_a5_r0_c1.png", "other pixels"},
                                                            {"stair_box_a5_r5_c1.png", "another description"},
                                                            {"stair_box_a5_r0_c1.png", "another shape"},
                                                            {"step_box_a5_r10_c1.png", "missing"},
                                                            {"step_box_a5_r15_c1.png", "unreadable"}}));
    EXPECT_EQ(report["faults"][0]["pixels"], 1);
    EXPECT_EQ(report["faults"][0]["largest_difference"], 3);
    EXPECT_NE(attempt("stairstep-stimuli verify s").output.find("step_box_a5_r0_c1.png: other pixels, 1 by up to 3"),
              std::string::npos);
}

TEST_F(BatchProgram, AFullDiskIsSaidAndLeavesNoPartialFile) {
    for (const char* format : {"png", "tif", "exr"}) {
        const std::string out = std::string("full-") + format;
        // A limit on file size stands in for a full disk.
        const CommandResult result = attempt(
            "trap '' XFSZ; ulimit -f 1; stairstep-stimuli --texel 7 --radius 9.5 "
            "--contrast 0.7 --size 320x240 --pattern stair --format " +
            std::string(format) + " --dither none --out " + out);
        EXPECT_EQ(result.exit_code, 1) << format;
        EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
        EXPECT_TRUE(fs::is_empty(file(out))) << format;
    }
}

TEST_F(BatchProgram, TwoStimuliOfOneNameStopTheBatchBeforeItStarts) {
    write_file(file("grid.csv"),
               "pattern,kernel,contrast,texel_px,radius_px,width_px\nstep,box,1,5,5,64\nstep,box,1,5,5,65\n");
    const CommandResult result = attempt("stairstep-stimuli --grid grid.csv --out s");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.errors.find("same file name step_box_a5_r5_c1"), std::string::npos) << result.errors;
    EXPECT_FALSE(fs::exists(file("s")));
}

TEST_F(BatchProgram, AGridFileGivesItsRowsInItsOrder) {
    write_file(file("grid.csv"), "texel_px,pattern,kernel,contrast,radius_px\n8,stair,box,1,3\n5,step,box,0.5,0.25\n");
    run("stairstep-stimuli --grid grid.csv --size 64x48 --out s");
    const CsvTable manifest = CsvTable::read(file("s/stimuli.csv"));
    ASSERT_EQ(manifest.row_count(), 2u);
    EXPECT_EQ(manifest.text(0, 0), "stair_box_a8_r3_c1.png");
    EXPECT_EQ(manifest.text(1, 0), "step_box_a5_r0.25_c0.5.png");
    EXPECT_EQ(read_stored_image(file("s/" + manifest.text(1, 0))).width_px, 64);
}

}  // namespace
}  // namespace stairstep
