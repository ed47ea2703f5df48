// stairstep-render from the command line: results, exit codes and the one line an error is.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "stimuli/io/image_file.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

const std::string kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";

CommandResult run(const std::string& arguments) {
    return run_command(program("stairstep-render") + " " + arguments);
}

void expect_error(const std::string& arguments, int exit_code, const std::string& part) {
    const CommandResult outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.errors;
    EXPECT_TRUE(is_one_error_line(outcome.errors)) << arguments << "\n" << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
}

class RenderProgram : public testing::Test {
  protected:
    std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

    size_t file_count() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
    }

    TemporaryFolder folder_;
};

TEST_F(RenderProgram, SizePrintsTheAnchor) {
    EXPECT_EQ(run("size --radius 0.4 --extent 28").output, "243\n");
    EXPECT_EQ(run("size --law kreuzer2017 --radius 0.4 --extent 28 --smallest-texel 1").output, "28\n");
    const nlohmann::json json = nlohmann::json::parse(run("size --radius 0.4 --extent 28 --json").output);
    EXPECT_EQ(json["texels"], 243);
    EXPECT_EQ(json["limited_by"], "law");
}

// Period and texel are one: gaps show or don't (analysis/law/grating_error.h).
TEST_F(RenderProgram, SizeSaysWhatBecomesOfGaps) {
    const std::string gaps = "size --radius 3.47 --extent 28 --gap 0.5 --period 1";
    EXPECT_EQ(run(gaps).output, "28\ngaps of 0.50 texels every 1.00: visibility off by 0.500 root mean square\n");
    const nlohmann::json json = nlohmann::json::parse(run(gaps + " --json").output);
    EXPECT_NEAR(json["grating"]["visibility_rmse"], 0.5, 5e-4);
    expect_error("size --radius 3.47 --extent 28 --gap 0.5", 2, "--period");
    expect_error("size --radius 3.47 --extent 28 --gap 2 --period 1", 2, "gap");
}

TEST_F(RenderProgram, SizeRefusesNonsense) {
    for (const std::string radius : {"0", "-1", "nan", "inf", "soft", "\"\""}) {
        const CommandResult outcome = run("size --extent 28 --radius=" + radius);
        EXPECT_EQ(outcome.exit_code, 2) << radius << "\n" << outcome.errors;
    }
    expect_error("size --radius 0.4 --extent 0", 2, "extent");
    expect_error("size --radius 0.4 --extent 28 --largest-size 0", 2, "largest");
    expect_error("size --radius 0.4 --extent 28 --law " + at("none.json"), 2, "none.json");
    expect_error("size --radius 0.4", 2, "--extent");
    expect_error("", 2, "subcommand");
}

TEST_F(RenderProgram, SizeSaysWhenNoMapIsLargeEnough) {
    expect_error("size --radius 0.0001 --extent 28", 1, "wants 971600 texels");
    expect_error("size --radius 1e-300 --extent 1e300", 1, "more than a million billion");
}

TEST_F(RenderProgram, ImageDrawsComparesAndMeasures) {
    const CommandResult outcome =
        run("image " + kTruck + " --resolution 1024,auto --size 320x180 --frames 1 --truth --out " + at("img.png") +
            " --stats " + at("stats.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const nlohmann::json stats = read_json(at("stats.json"));
    EXPECT_EQ(stats["triangles"], 3624);
    ASSERT_EQ(stats["renderings"].size(), 2u);
    const nlohmann::json& fixed = stats["renderings"][0];
    const nlohmann::json& sized = stats["renderings"][1];
    EXPECT_EQ(fixed["width"], 1024);
    EXPECT_EQ(fixed["filter"], "sampled");
    EXPECT_EQ(fixed["taps"], 25);
    EXPECT_EQ(sized["filter"], "exact");
    EXPECT_LT(sized["texels"].get<double>(), 200 * 200);
    // Texels are rounded down to 12 bits.
    const double slope = stats["law"]["slope"];
    EXPECT_GE(sized["radius_in_texels"].get<double>(), slope * (1 - 1e-9));
    EXPECT_LE(sized["radius_in_texels"].get<double>(), slope * (1 + 1.0 / 2048));
    for (const nlohmann::json& rendering : stats["renderings"]) {
        EXPECT_GT(rendering["frame_ms"].get<double>(), 0);
        EXPECT_LT(rendering["visibility_error"]["rmse"].get<double>(), 0.06);
        EXPECT_GT(rendering["visibility_error"]["penumbra_share"].get<double>(), 0.01);
        const Image picture = read_image(at(rendering["file"].get<std::string>()));
        EXPECT_EQ(picture.width, 320);
        EXPECT_EQ(picture.height, 180);
    }
    EXPECT_TRUE(fs::exists(at("img-difference.png")));
    EXPECT_TRUE(fs::exists(at("img-truth.png")));
    EXPECT_GT(stats["speedup"].get<double>(), 0);
    EXPECT_EQ(file_count(), 5u) << "nothing but what was asked for";
}

TEST_F(RenderProgram, OneResolutionTakesTheNameItself) {
    const CommandResult outcome =
        run("image " + kTruck + " --size 160x90 --frames 1 --show visibility --json --out " + at("v.png"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(nlohmann::json::parse(outcome.output)["renderings"][0]["file"], at("v.png"));
    EXPECT_EQ(read_image(at("v.png")).channels, 1);
    EXPECT_EQ(file_count(), 1u);
}

// No two runs differ but in their times.
TEST_F(RenderProgram, PicturesAreReproducible) {
    for (const std::string name : {"a.png", "b.png"}) {
        ASSERT_EQ(run("image " + kTruck + " --resolution 512 --size 160x90 --frames 1 --out " + at(name)).exit_code, 0);
    }
    EXPECT_EQ(read_image(at("a.png")).pixels, read_image(at("b.png")).pixels);
}

TEST_F(RenderProgram, ImageRefusesBadInput) {
    const std::string image = "image " + kTruck + " --out " + at("x.png") + " ";
    for (const std::string resolution : {"0", "1000000000", "-5", "nan", "1.5", "big", "auto,auto", "\"\""}) {
        expect_error(image + "--resolution=" + resolution, 2, "--resolution");
    }
    for (const std::string size : {"0x720", "1280x1000000000", "1280", "axb", "1x2x3"}) {
        expect_error(image + "--size " + size, 2, "--size");
    }
    for (const std::string radius : {"0", "-1", "nan", "inf", "1e30"}) {
        expect_error(image + "--radius=" + radius, 2, "--radius");
    }
    expect_error(image + "--camera 0,-30", 2, "--camera");
    expect_error(image + "--camera 0,30,1,2", 2, "--camera");
    expect_error(image + "--light 0", 2, "--light");
    expect_error(image + "--light 0,nan", 2, "--light");
    expect_error(image + "--technique ray", 2, "pcf");
    expect_error(image + "--technique vsm --bleeding 1", 2, "--bleeding");
    expect_error(image + "--depth-bits 8", 2, "--depth-bits 8");
    expect_error(image + "--spot-depth logarithmic", 2, "--spot-depth");
    expect_error(image + "--technique pcss --spot-depth linear", 2, "--spot-depth linear");
    expect_error(image + "--samples 32", 1, "samples");
    expect_error(image + "--filter sampled --taps 24", 2, "--taps");
    expect_error(image + "--resolution 4096 --filter exact", 2, "--filter exact");
    expect_error("image " + kTruck + " --out " + at("x.jpg"), 2, ".png");
    expect_error("image " + at("none.gltf") + " --out " + at("x.png"), 2, "none.gltf");
    EXPECT_EQ(file_count(), 0u);
}

TEST_F(RenderProgram, ALawOfAnotherKernelMustBeConvertedKnowingly) {
    nlohmann::ordered_json law =
        nlohmann::ordered_json::parse(read_file(std::string(STAIRSTEP_SOURCE_DIR) + "/analysis/law/kreuzer2017.json"));
    law["kernel"] = "disk";
    write_json(at("disk.json"), law);
    const std::string image =
        "image " + kTruck + " --size 64x36 --frames 1 --json --law " + at("disk.json") + " --out " + at("x.png");
    expect_error(image, 2, "--convert-kernel");
    const CommandResult outcome = run(image + " --convert-kernel");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const nlohmann::json stats = nlohmann::json::parse(outcome.output);
    EXPECT_TRUE(stats["law"]["kernel_converted"]);
    EXPECT_NEAR(stats["law"]["slope_for_box"].get<double>(), 3.47 * 0.5 * std::sqrt(3.0), 1e-9);
}

TEST_F(RenderProgram, WhatCantBeWrittenLeavesNothing) {
    expect_error("image " + kTruck + " --out /nonexistent/x.png", 1, "/nonexistent");
    expect_error("image " + kTruck + " --size 64x36 --frames 1 --out " + at("x.png") + " --stats /nonexistent/s.json",
                 1, "/nonexistent");
    EXPECT_EQ(file_count(), 0u);
}

}  // namespace
}  // namespace stairstep
