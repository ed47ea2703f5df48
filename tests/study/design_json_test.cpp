#include "study/design_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(DesignJson, AnEmptyObjectIsTheThesissDesign) {
    EXPECT_EQ(to_json(design_from_json("{}", "empty")).dump(), to_json(Design()).dump());
}

TEST(DesignJson, ReadsBackWhatItWrites) {
    Design design;
    design.name = "pilot";
    design.patterns = {Pattern::stair};
    design.contrasts = {0.3};
    design.texels_px = {7.5, 12};
    design.kernel = KernelShape::disk;
    design.task = Task::two_alternative;
    design.guess_radius_texels = 2.5;
    std::get<QuestSettings>(design.engine).shape.beta = 2;
    std::get<QuestSettings>(design.engine).guess_sd = 0.3;
    design.stop = {5, 60, 0.07};
    design.easy = {8, 0.05, 0.25};
    design.break_every_trials = 100;
    design.smallest_radius_px = 1;
    design.largest_radius_px = 99;
    design.width_px = 800;
    design.height_px = 600;
    design.viewing = Viewing{700, 0.27};
    const std::string text = to_json(design).dump(2);
    const Design back = design_from_json(text, "design.json");
    EXPECT_EQ(to_json(back).dump(2), text);
    EXPECT_EQ(std::get<QuestSettings>(back.engine).shape.beta, 2);
    EXPECT_EQ(back.task, Task::two_alternative);
    EXPECT_EQ(back.stop.converged_sd, 0.07);
}

TEST(DesignJson, ReadsBackEveryEngine) {
    const std::vector<std::string> engines{
        R"({"name": "quest", "placement": "quantile", "quantile_order": 0.6, "prior": "uniform", "beta": 2})",
        R"({"name": "minimum-entropy", "guess_sd": 0.3, "delta": 0.02})",
        R"({"name": "psi-marginal", "beta": [2, 6], "beta_count": 5, "gamma": [0.4, 0.5], "gamma_count": 2})",
        R"({"name": "staircase", "down_after": 1, "up_over_down": 4.5, "steps": [0.3, 0.1], "beta": 3})",
        R"({"name": "constant-stimuli", "levels": [-0.2, 0, 0.2], "guess_sd": 1})",
        R"({"name": "law-directed", "betas": [2, 4], "deltas": [0.02], "deviation_sd": 0.1, "longest_lead": 3})"};
    for (const std::string& engine : engines) {
        const Design design = design_from_json("{\"engine\": " + engine + "}", "d");
        const nlohmann::ordered_json written = to_json(design);
        EXPECT_EQ(to_json(design_from_json(written.dump(), "d")), written) << engine;
        // What was asked for is there, and isn't what the engine has by default.
        const auto asked = nlohmann::json::parse(engine);
        const auto defaults = to_json(design_from_json(R"({"engine": {"name": )" + asked["name"].dump() + "}}", "d"));
        for (const auto& [key, value] : asked.items()) {
            EXPECT_EQ(nlohmann::json(written["engine"][key]), value) << key;
            if (key == "name") continue;
            EXPECT_NE(nlohmann::json(defaults["engine"].value(key, nlohmann::json())), value) << key;
        }
    }
}

TEST(DesignJson, AskingForFewTrialsIsEnough) {
    EXPECT_EQ(design_from_json(R"({"stop": {"most_trials": 2}})", "d").stop.least_trials, 2);
}

TEST(DesignJson, PixelsPerDegreeFollowFromTheGeometry) {
    // At 57.29 cm a degree is 1 cm on the screen: 40 pixels of 0.25 mm.
    EXPECT_NEAR((Viewing{572.9, 0.25}.pixels_per_degree()), 40, 0.01);
}

TEST(DesignJson, RefusesWhatCannotBe) {
    const std::vector<std::pair<const char*, const char*>> faults{
        {R"({"texel_px": [5]})", "texel_px"},
        {R"({"texels_px": [5, 10, 5]})", "texels_px"},
        {R"({"texels_px": []})", "texels_px"},
        {R"({"texels_px": [5, -1]})", "texels_px"},
        {R"({"texels_px": [5, "10"]})", "texels_px"},
        {R"({"texels_px": 5})", "texels_px"},
        {R"({"contrasts": [1, 0.5, 1]})", "contrasts"},
        {R"({"contrasts": [1.5]})", "contrasts"},
        {R"({"patterns": ["step", "step"]})", "patterns"},
        {R"({"patterns": ["line"]})", "patterns"},
        {R"({"kernel": "triangle"})", "kernel"},
        {R"({"name": ""})", "name"},
        {R"({"task": {"name": "3afc"}})", "name"},
        {R"({"task": {"line_share": 0.33}})", "line_share"},
        {R"({"task": {"line_share": 1}})", "line_share"},
        {R"({"engine": {"name": "guesswork"}})", "name"},
        {R"({"engine": {"betta": 3}})", "betta"},
        {R"({"engine": {"beta": -3}})", "psychometric shape"},
        {R"({"engine": {"placement": "anywhere"}})", "placement"},
        {R"({"engine": {"prior": "flat"}})", "prior"},
        {R"({"engine": {"name": "minimum-entropy", "prior": "uniform"}})", "prior"},
        {R"({"engine": {"name": "law-directed", "betas": []}})", "betas"},
        {R"({"engine": {"name": "psi-marginal", "beta": 3}})", "beta"},
        {R"({"engine": {"guess_sd": 0}})", "guess SD"},
        {R"({"stop": {"most_trials": 0}})", "stop"},
        {R"({"stop": {"most_trials": 2.5}})", "most_trials"},
        {R"({"stop": {"least_trials": 50}})", "stop"},
        {R"({"stop": {"converged_sd": 0}})", "converged_sd"},
        {R"({"catch_share": 0.7})", "catch_share"},
        {R"({"practice_trials": -1})", "practice_trials"},
        {R"({"radius_px": [5]})", "radius_px"},
        {R"({"radius_px": [50, 5]})", "radius_px"},
        {R"({"size_px": [640, 1e300]})", "size_px"},
        {R"({"viewing": {"distance_mm": 0}})", "viewing"},
        {R"([])", "d.json"},
        {R"({"name": )", "d.json"},
    };
    for (const auto& [text, named] : faults) {
        try {
            design_from_json(text, "d.json");
            ADD_FAILURE() << "took " << text;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << text << " gives: " << e.what();
        }
    }
}

TEST(DesignJson, RefusesListsThatTakeForEver) {
    for (const char* key : {"contrasts", "texels_px"}) {
        nlohmann::json values = nlohmann::json::array();
        for (int i = 1; i <= 100; ++i) values.push_back(i / 100.0);
        EXPECT_NO_THROW(design_from_json(nlohmann::json{{key, values}}.dump(), "d")) << key;
        for (int i = 1; i <= 100'000; ++i) values.push_back(i / 1e6 + 1e-9);
        EXPECT_THROW(design_from_json(nlohmann::json{{key, values}}.dump(), "d"), InputError) << key;
    }
    const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
    EXPECT_THROW(design_from_json("{\"task\": {\"name\": " + deep + "}}", "d"), InputError);
}

}  // namespace
}  // namespace stairstep
