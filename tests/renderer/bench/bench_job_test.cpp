// The whole bench on small pictures.
#include "renderer/bench/bench_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>

#include "analysis/law/law_file.h"
#include "renderer/scenes/scenes.h"
#include "renderer/truth/area_light_truth.h"
#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

namespace fs = std::filesystem;

/// What readers of bench.csv rely on.
const std::string kFirstColumns =
    "scene,technique,sizing,resolution,search_taps,filter_taps,frame_ms,depth_ms,lighting_ms,texels,error_rmse,"
    "error_max,";

Configuration rotated(int side, int taps) {
    return {"pcf-rotated", "pcf", FilterMode::rotated, side, taps};
}

std::vector<Configuration> few_configurations() {
    return {{"none", "none", FilterMode::automatic, 1, 0},
            {"hard", "hard", FilterMode::automatic, 512, 0},
            auto_pcf(),
            {"pcf-exact", "pcf", FilterMode::exact, 8192, 0},
            rotated(1024, 9),
            rotated(1024, 49),
            auto_pcss(),
            {"pcss", "pcss", FilterMode::rotated, 512, 9},
            {"vsm", "vsm", FilterMode::automatic, std::nullopt, 0},
            {"esm", "esm", FilterMode::automatic, 512, 0}};
}

BenchJob small_job(const fs::path& folder) {
    BenchJob job;
    job.scenes = {"crane", "clutter"};
    job.configurations = few_configurations();
    job.measurement.width = 96;
    job.measurement.height = 54;
    job.measurement.frames = 2;
    job.measurement.largest_size = 1024;
    job.truth.light_samples = 64;
    job.truth.filter_side = 2048;
    job.truth.filter_taps = 400;
    job.truth.cache = folder / "cache";
    job.wobble.reset();
    job.out = folder / "bench";
    return job;
}

class SmallBench : public testing::Test {
  protected:
    CsvTable table() const { return CsvTable::read(folder_.path() / "bench" / "bench.csv"); }
    double number(const CsvTable& table, size_t row, const std::string& column) const {
        return table.number(row, table.column(column));
    }

    TemporaryFolder folder_;
};

/// By a sweep over (cost, error) of rows: the flags of the frontier.
std::map<std::pair<double, double>, bool> swept(std::vector<std::pair<double, double>> points) {
    std::sort(points.begin(), points.end());
    std::map<std::pair<double, double>, bool> flags;
    double least = INFINITY;
    for (const auto& point : points) {
        flags[point] = point.second < least;
        least = std::min(least, point.second);
    }
    return flags;
}

TEST_F(SmallBench, MeasuresEachConfiguration) {
    const nlohmann::ordered_json result = run_bench(small_job(folder_.path()));
    const fs::path out = folder_.path() / "bench";
    EXPECT_TRUE(read_file(out / "bench.csv").starts_with(kFirstColumns));
    const CsvTable rows = table();
    // The exact filter over 8192 texels is over 128 of them wide, which a note says.
    const size_t per_scene = few_configurations().size() - 1;
    ASSERT_EQ(rows.row_count(), 2 * per_scene);
    for (size_t scene = 0; scene < 2; ++scene) {
        EXPECT_EQ(result["scenes"][scene]["notes"].size(), 1u);
        std::map<std::string, double> errors;
        std::map<std::string, double> bleedings;
        std::map<std::string, std::vector<std::pair<double, double>>> points;
        for (size_t row = scene * per_scene; row < (scene + 1) * per_scene; ++row) {
            const std::string technique = rows.text(row, rows.column("technique"));
            for (const std::string column : {"frame_ms", "error_rmse", "error_max", "penumbra_rmse", "time_ratio"}) {
                EXPECT_TRUE(std::isfinite(number(rows, row, column))) << technique << " " << column;
            }
            const bool has_map = technique != "none";
            EXPECT_EQ(number(rows, row, "texels") > 0, has_map) << technique;
            EXPECT_EQ(number(rows, row, "texels"), number(rows, row, "width") * number(rows, row, "height"));
            EXPECT_GT(number(rows, row, "frame_ms"), 0);
            EXPECT_LE(number(rows, row, "error_rmse"), number(rows, row, "error_max"));
            const double bleeding = number(rows, row, "light_bleeding");
            EXPECT_LE(bleeding, number(rows, row, "error_max")) << technique;
            bleedings[technique] = bleeding;
            errors[technique + " " + rows.text(row, rows.column("filter_taps"))] = number(rows, row, "error_rmse");
            const std::string family = rows.text(row, rows.column("truth")) == "area-light" ? "light" : "filter";
            points[family].emplace_back(number(rows, row, "frame_ms"), number(rows, row, "error_rmse"));
        }
        for (size_t row = scene * per_scene; row < (scene + 1) * per_scene; ++row) {
            const std::string family = rows.text(row, rows.column("truth")) == "area-light" ? "light" : "filter";
            EXPECT_EQ(number(rows, row, "on_frontier") != 0,
                      swept(points[family])[std::pair(number(rows, row, "frame_ms"), number(rows, row, "error_rmse"))]);
        }
        for (const auto& [technique, error] : errors) {
            if (technique == "none 0") continue;
            EXPECT_LT(error, errors["none 0"]) << technique;
        }
        // All of the light is where none should be, but for surfaces that are turned away.
        EXPECT_GT(bleedings["none"], 0.2);
        for (const auto& [technique, bleeding] : bleedings) {
            if (technique != "none") {
                EXPECT_LT(bleeding, 0.2 * bleedings["none"]) << technique;
            }
        }
        EXPECT_LT(errors["pcf-rotated 49"], errors["pcf-rotated 9"]) << "more taps come closer to the filter";
    }
}

TEST_F(SmallBench, ThePageHasItsFilesBesideIt) {
    BenchJob job = small_job(folder_.path());
    job.scenes = {"crane"};
    job.configurations = {auto_pcf(), fixed_pcf()};
    job.measurement.frames = 1;
    WobbleSettings wobble;
    wobble.steps = 1;
    wobble.width = 48;
    wobble.height = 27;
    wobble.truth = job.truth;
    job.wobble = wobble;
    const nlohmann::ordered_json result = run_bench(job);
    EXPECT_EQ(result["scenes"][0]["bars"].size(), 2u) << "PCF's time and wobble";
    const std::string page = read_file(job.out / "index.html");
    EXPECT_EQ(page.find("{{"), std::string::npos);
    const std::regex link("(src|href)=\"([^\"]+)\"");
    int links = 0;
    for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at) {
        EXPECT_TRUE(fs::is_regular_file(job.out / (*at)[2].str())) << (*at)[2];
        ++links;
    }
    EXPECT_EQ(links, 1 + 1 + 6) << "the CSV, a figure, and for each of two: truth, picture and difference";
    EXPECT_NE(read_file(job.out / "crane-frontier.svg").find("</svg>"), std::string::npos);
    EXPECT_EQ(read_image(job.out / "crane-pcf-auto.png").width, 96);
    const CsvTable rows = table();
    ASSERT_EQ(rows.row_count(), 2u);
    EXPECT_EQ(number(rows, 1, "time_ratio"), 1) << "the baseline against itself";
    for (size_t row = 0; row < 2; ++row) {
        EXPECT_NEAR(number(rows, row, "wobble"),
                    (number(rows, row, "wobble_light") + number(rows, row, "wobble_caster") +
                     number(rows, row, "wobble_camera")) /
                        3,
                    1e-12);
        EXPECT_GT(number(rows, row, "wobble"), 0);
    }
    // What is kept on disk is what would be made: the same errors to the last digit.
    const std::string first_error = rows.text(0, rows.column("error_rmse"));
    run_bench(job);
    EXPECT_EQ(table().text(0, rows.column("error_rmse")), first_error);
}

// The disk is larger than the box by as much as makes their variances equal.
TEST_F(SmallBench, FilterTruthsOfBoxAndDiskBlurAlike) {
    const auto context = gl::make_osmesa_context();
    const AnimatedScene animated = scene_named("clutter");
    const GpuScene scene = upload(animated.scene);
    const SceneState state = animated.state(Motion::still, 0);
    TruthSettings settings = small_job(folder_.path()).truth;
    SceneTruth truth(animated.scene, scene, animated.radius, settings, 96, 54);
    const std::vector<float> box = truth.visibility(TruthKind::box_filter, state);
    const std::vector<float> disk = truth.visibility(TruthKind::disk_filter, state);
    const VisibilityError between = compare_visibility(disk, box);
    EXPECT_GT(between.penumbra_share, 0.01);
    EXPECT_LT(between.penumbra_rmse, 0.03) << "equal variances";
    EXPECT_GT(between.penumbra_rmse, 0) << "but not one kernel";
    // Another radius is another truth, not the one on disk.
    SceneTruth wider(animated.scene, scene, 2 * animated.radius, settings, 96, 54);
    EXPECT_GT(compare_visibility(wider.visibility(TruthKind::box_filter, state), box).rmse, 0.01);
}

template <typename Error>
void expect_refused(const BenchJob& job, const std::string& part) {
    try {
        run_bench(job);
        ADD_FAILURE() << "accepted: " << part;
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

TEST_F(SmallBench, RefusesBadInputBeforeAnythingIsWritten) {
    const BenchJob good = small_job(folder_.path());
    const auto with = [&](auto change) {
        BenchJob job = good;
        change(job);
        return job;
    };
    expect_refused<InputError>(with([](BenchJob& job) { job.scenes = {"crane", "castle"}; }), "castle");
    expect_refused<InputError>(with([](BenchJob& job) { job.scenes = {"crane", "crane"}; }), "twice");
    expect_refused<InputError>(with([](BenchJob& job) { job.scenes = {}; }), "empty");
    for (const double radius : {0.0, -1.0, std::nan(""), 1e9}) {
        expect_refused<InputError>(with([&](BenchJob& job) { job.radius = radius; }), "--radius");
    }
    Law law = kreuzer2017_law();
    law.kernel = KernelShape::disk;
    const fs::path disk = folder_.path() / "disk.json";
    write_law(disk, law);
    expect_refused<InputError>(with([&](BenchJob& job) { job.law = disk.string(); }), "disk");
    EXPECT_FALSE(fs::exists(good.out));
    write_file(folder_.path() / "file", "");
    expect_refused<FailureError>(with([&](BenchJob& job) { job.out = folder_.path() / "file"; }), "file");
}

}  // namespace
}  // namespace stairstep::bench
