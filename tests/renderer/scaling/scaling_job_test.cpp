// Curves measured end to end on tiny pictures: files, figures and exponents hold together.
#include "renderer/scaling/scaling_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "renderer/scaling/power_law.h"
#include "renderer/scaling/scaling_csv.h"
#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep::scaling {
namespace {

namespace fs = std::filesystem;

/// Times that are each their own, with digits that rounding would lose.
bench::MedianTimes planted_times(double scale) {
    bench::MedianTimes times;
    times.frame = {scale * 10 / 3, scale / 7};
    times.depth.cpu_ms = scale * 0.1;
    times.surfaces.cpu_ms = scale * 0.3;
    times.lighting.cpu_ms = scale * 1e-7 / 3;
    times.need.cpu_ms = 0;
    times.fit_ms = scale * 1e5 / 3;
    times.processor_ms = scale / 11;
    return times;
}

TEST(ScalingCsv, ReadsBackAsWritten) {
    std::vector<AxisCurves> axes{{"radius", "m", {{bench::auto_pcf(), {}}, {all_techniques().front(), {}}}},
                                 {"height", "px", {{bench::fixed_pcss(), {}}}}};
    double scale = 1;
    for (AxisCurves& axis : axes) {
        for (Curve& curve : axis.curves) {
            for (const double value : {0.1, 1.0 / 3, 2160.0}) {
                curve.points.push_back({value, 854, 480, 37, 41, planted_times(scale *= 1.7)});
            }
        }
    }
    const std::string text = scaling_csv(axes, {"a, \"renderer\"", "osmesa", 7});
    EXPECT_TRUE(
        text.starts_with("axis,value,technique,size,frame_ms,depth_ms,prepare_ms,surfaces_ms,lighting_ms,"
                         "need_ms,fit_ms,processor_ms,texels,"));
    const CsvTable table = CsvTable::parse(text, "scaling.csv");
    ASSERT_EQ(table.row_count(), 9u);
    size_t row = 0;
    for (const AxisCurves& axis : axes) {
        for (const Curve& curve : axis.curves) {
            for (const Point& point : curve.points) {
                const auto number = [&](const char* column) { return table.number(row, table.column(column)); };
                const auto field = [&](const char* column) { return table.text(row, table.column(column)); };
                EXPECT_EQ(field("axis"), axis.axis);
                EXPECT_EQ(field("technique"), curve.configuration.technique);
                EXPECT_EQ(field("renderer"), "a, \"renderer\"");
                EXPECT_EQ(number("value"), point.value);
                EXPECT_EQ(number("frame_ms"), point.times.frame.cpu_ms);
                EXPECT_EQ(number("depth_ms"), point.times.depth.cpu_ms);
                EXPECT_EQ(number("surfaces_ms"), point.times.surfaces.cpu_ms);
                EXPECT_EQ(number("lighting_ms"), point.times.lighting.cpu_ms);
                EXPECT_EQ(number("need_ms"), 0);
                EXPECT_EQ(number("fit_ms"), point.times.fit_ms);
                EXPECT_EQ(number("processor_ms"), point.times.processor_ms);
                EXPECT_EQ(number("gpu_frame_ms"), point.times.frame.gpu_ms);
                EXPECT_EQ(number("texels"), 37 * 41);
                EXPECT_EQ(number("frames"), 7);
                ++row;
            }
        }
    }
    EXPECT_EQ(table.text(0, table.column("size")), "auto");
    EXPECT_EQ(table.text(3, table.column("size")), "none");
    EXPECT_EQ(table.text(6, table.column("size")), "4096");
}

class SmallScaling : public testing::Test {
  protected:
    ScalingJob small_job(const std::vector<std::string>& names) const {
        ScalingJob job = quick_job();
        std::erase_if(job.axes, [&](const Axis& axis) { return std::ranges::find(names, axis.name) == names.end(); });
        // A large map takes longer than all else here.
        for (bench::Configuration& one : job.techniques) {
            if (one.side && one.entry != "none") one.side = 256;
        }
        job.scenario.width = 64;
        job.scenario.height = 36;
        job.scenario.cells = 1;
        job.frames = 2;
        job.largest_size = 1024;
        job.out = folder_.path() / "scaling";
        return job;
    }
    TemporaryFolder folder_;
};

TEST_F(SmallScaling, ExponentsAreThoseOfTheCsv) {
    const ScalingJob job = small_job({"triangles", "radius", "light-size"});
    const nlohmann::ordered_json result = run_scaling(job);
    const CsvTable table = CsvTable::read(job.out / "scaling.csv");
    const size_t value = table.column("value");
    const size_t frame = table.column("frame_ms");
    // Five techniques by triangles, three by radius, three by light size.
    ASSERT_EQ(table.row_count(), 3 * (5u + 3 + 3));
    ASSERT_EQ(result["axes"].size(), 3u);
    size_t row = 0;
    for (const auto& axis : result["axes"]) {
        for (const auto& one : axis["techniques"]) {
            std::vector<double> values, times;
            for (size_t i = 0; i < one["value"].size(); ++i, ++row) {
                EXPECT_EQ(table.text(row, table.column("axis")), axis["axis"]);
                EXPECT_EQ(table.text(row, table.column("technique")), one["technique"]);
                EXPECT_EQ(table.text(row, table.column("size")), one["size"]);
                values.push_back(table.number(row, value));
                times.push_back(table.number(row, frame));
                EXPECT_EQ(values.back(), one["value"][i]);
                EXPECT_EQ(times.back(), one["frame_ms"][i]);
                EXPECT_GT(times.back(), 0);
                EXPECT_GT(table.number(row, table.column("processor_ms")), 0);
                EXPECT_EQ(table.number(row, table.column("texels")) > 0, one["technique"] != "none");
            }
            const auto law = fit_power_law(values, times);
            ASSERT_TRUE(law);
            EXPECT_DOUBLE_EQ(one["exponent"], law->exponent);
            EXPECT_DOUBLE_EQ(one["exponent_se"], *law->exponent_se);
            EXPECT_DOUBLE_EQ(one["growth"], times.back() / times.front());
        }
    }
    EXPECT_EQ(result["axes"][0]["techniques"][0]["value"], (std::vector<double>{1010, 4034, 9074})) << "as drawn";
}

// What can't be noise: the law's texels go as 1/radius² where pixels are finer than they are, and a fixed map's stay.
TEST_F(SmallScaling, TexelsFollowTheRadius) {
    ScalingJob job = small_job({"radius"});
    job.axes.front().values = {0.4, 0.8, 1.6};
    job.scenario.width = 640;
    job.scenario.height = 360;
    job.frames = 1;
    const nlohmann::ordered_json result = run_scaling(job);
    for (const auto& one : result["axes"][0]["techniques"]) {
        if (one["size"] == "none") continue;
        const auto law =
            fit_power_law(one["value"].get<std::vector<double>>(), one["texels"].get<std::vector<double>>());
        ASSERT_TRUE(law);
        // The map also covers what a wider filter reaches.
        EXPECT_NEAR(law->exponent, one["size"] == "auto" ? -2 : 0, 0.2) << one["technique"];
    }
}

TEST_F(SmallScaling, ThePageHasItsFilesBesideIt) {
    ScalingJob job = small_job({"height"});
    job.axes.front().values = {18, 36, 72};
    run_scaling(job);
    const std::string page = read_file(job.out / "index.html");
    EXPECT_EQ(page.find("{{"), std::string::npos);
    EXPECT_EQ(page.find("http"), std::string::npos) << "it needs no network";
    const std::regex link("(src|href)=\"([^\"]+)\"");
    int links = 0;
    for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++links) {
        EXPECT_TRUE(fs::is_regular_file(job.out / (*at)[2].str())) << (*at)[2];
    }
    EXPECT_EQ(links, 2) << "the CSV and a figure";
    const std::string figure = read_file(job.out / "height.svg");
    EXPECT_NE(figure.find("</svg>"), std::string::npos);
    for (const bench::Configuration& one : job.techniques) {
        EXPECT_NE(figure.find(label(one) + ":"), std::string::npos) << label(one) << " with its exponent in the key";
    }
    EXPECT_NE(figure.find("±"), std::string::npos);
}

TEST_F(SmallScaling, RefusesWhatItCannotDoBeforeItDraws) {
    ScalingJob job = small_job({"radius"});
    job.axes.push_back(job.axes.front());
    EXPECT_THROW(run_scaling(job), InputError);
    job.axes.clear();
    EXPECT_THROW(run_scaling(job), InputError);
    EXPECT_FALSE(fs::exists(job.out));
    job = small_job({"radius"});
    write_file(job.out, "a file, no folder");
    EXPECT_THROW(run_scaling(job), FailureError);
}

}  // namespace
}  // namespace stairstep::scaling
