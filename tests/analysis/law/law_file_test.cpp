#include "analysis/law/law_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

Law some_law() {
    Law law;
    law.kernel = KernelShape::disk;
    law.slope = 3.4;
    law.slope_ci95 = {3.1, 3.8};
    law.texel_range_px = {5, 30};
    law.observers = 10;
    law.trials = 1600;
    law.source = "a \"study\"";
    ConditionLaw condition;
    condition.pattern = Pattern::stair;
    condition.contrast = 0.5;
    condition.kernel = KernelShape::disk;
    condition.slope = 2.5;
    condition.slope_ci95 = {2.2, 2.9};
    condition.intercept_px = -0.5;
    condition.intercept_ci95 = {-2, 1};
    condition.exponent = 1.02;
    condition.exponent_ci95 = {0.95, 1.09};
    condition.between_observer_sd_ln = 0.16;
    condition.observers = 10;
    condition.trials = 400;
    law.conditions = {condition};
    return law;
}

TEST(LawFile, ReadsBackWhatItWrote) {
    const TemporaryFolder folder;
    write_law(folder.path() / "law.json", some_law());
    const Law law = read_law(folder.path() / "law.json");
    EXPECT_EQ(law.kernel, KernelShape::disk);
    EXPECT_EQ(law.slope, 3.4);
    EXPECT_EQ(law.slope_ci95, Interval(3.1, 3.8));
    EXPECT_EQ(law.source, "a \"study\"");
    ASSERT_EQ(law.conditions.size(), 1u);
    EXPECT_EQ(law.conditions[0].pattern, Pattern::stair);
    EXPECT_EQ(law.conditions[0].exponent_ci95, Interval(0.95, 1.09));
    EXPECT_EQ(law.conditions[0].intercept_px, -0.5);
}

TEST(LawFile, WritesNoNumberThatIsNone) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "law.json";
    for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
        Law law = some_law();
        law.conditions[0].exponent_ci95.second = bad;
        EXPECT_THROW(write_law(path, law), FailureError);
        law = some_law();
        law.conditions[0].estimates = {{"profile", 1, {1, bad}, "words"}};
        EXPECT_THROW(write_law(path, law), FailureError);
        law = some_law();
        law.criteria = {{0.75, bad, {1, 2}, {}, 1, 1}};
        EXPECT_THROW(write_law(path, law), FailureError);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(LawFile, LeavesOutAFormThatWasNotEstimated) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "law.json";
    Law law = some_law();
    law.conditions[0].has_form = false;
    law.conditions[0].form_method = "not estimated: one size";
    write_law(path, law);
    const auto json = nlohmann::json::parse(read_file(path));
    EXPECT_FALSE(json["conditions"][0].contains("intercept_px"));
    EXPECT_FALSE(json["conditions"][0].contains("exponent_ci95"));
    EXPECT_EQ(json["conditions"][0]["form_method"], "not estimated: one size");
    EXPECT_FALSE(read_law(path).conditions[0].has_form);
}

TEST(LawFile, ShipsKreuzers) {
    const Law law = law_named("kreuzer2017");
    EXPECT_EQ(law.slope, 3.47);
    EXPECT_EQ(law.kernel, KernelShape::box);
    EXPECT_EQ(law.threshold_probability, 0.82);
    const Law file = read_law(std::filesystem::path(STAIRSTEP_SOURCE_DIR) / "analysis/law/kreuzer2017.json");
    EXPECT_EQ(file.slope, law.slope);
}

TEST(LawFile, ConvertsBetweenKernelsAtEqualVariance) {
    Law law = some_law();
    law.kernel = KernelShape::box;
    EXPECT_DOUBLE_EQ(slope_for_kernel(law, KernelShape::box), 3.4);
    EXPECT_NEAR(slope_for_kernel(law, KernelShape::disk), 3.4 * 2 / std::sqrt(3), 1e-12);
}

TEST(LawFile, RefusesEveryTruncation) {
    const TemporaryFolder folder;
    write_law(folder.path() / "law.json", some_law());
    const std::string bytes = read_file(folder.path() / "law.json");
    const auto cut = folder.path() / "cut.json";
    for (size_t size = 0; size + 2 < bytes.size(); ++size) {
        std::ofstream(cut, std::ios::binary) << std::string_view(bytes).substr(0, size);
        EXPECT_THROW(read_law(cut), InputError) << size << " bytes";
    }
}

TEST(LawFile, RefusesEachKeyWhenMissingOrSpoilt) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "law.json";
    write_law(path, some_law());
    const auto good = nlohmann::json::parse(read_file(path));
    const auto refuses = [&](const nlohmann::json& law) {
        std::ofstream(path) << law.dump();
        try {
            read_law(path);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(refuses(good), "accepted");
    for (const auto& [key, value] : good.items()) {
        auto missing = good;
        missing.erase(key);
        EXPECT_NE(refuses(missing).find("\"" + key + "\""), std::string::npos) << refuses(missing);
        auto spoilt = good;
        spoilt[key] = nullptr;
        EXPECT_NE(refuses(spoilt).find("\"" + key + "\""), std::string::npos) << refuses(spoilt);
    }
    for (const auto& [key, value] :
         std::initializer_list<std::pair<const char*, nlohmann::json>>{{"slope", 0},
                                                                       {"slope", -3},
                                                                       {"slope", 1e308},
                                                                       {"slope_ci95", {4, 3}},
                                                                       {"slope_ci95", {1, 2}},
                                                                       {"kernel", "blob"},
                                                                       {"pattern", "line"},
                                                                       {"contrast", 2},
                                                                       {"threshold_probability", 1},
                                                                       {"observers", 1.5},
                                                                       {"observers", -1},
                                                                       {"trials", 1e300},
                                                                       {"format", "stairstep-law/2"},
                                                                       {"conditions", {1}}}) {
        auto spoilt = good;
        spoilt[key] = value;
        EXPECT_NE(refuses(spoilt), "accepted") << key << " = " << value;
    }
    auto extended = good;
    extended["added_later"] = {{"x", 1}};
    EXPECT_EQ(refuses(extended), "accepted");
}

}  // namespace
}  // namespace stairstep
