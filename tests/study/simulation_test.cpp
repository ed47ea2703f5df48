#include "study/simulation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(Simulation, ComesBackFromItsJson) {
    Simulation simulation{7, 18446744073709551615u, {}};
    simulation.population.step_slope = 1.0 / 3;
    simulation.population.shape.beta = 2.1;
    simulation.population.shape.delta = 0.03;
    simulation.population.response_bias = -0.1;
    simulation.population.drift = 0.01;
    simulation.population.fatigue = 0.02;
    simulation.population.redo_share = 0.05;
    const std::string text = to_json(simulation).dump();
    const Simulation back = simulation_from_json(text, "plan");
    EXPECT_EQ(back.observers, 7);
    EXPECT_EQ(back.seed, 18446744073709551615u);
    EXPECT_EQ(back.population.step_slope, 1.0 / 3);
    EXPECT_EQ(back.population.shape.beta, 2.1);
    EXPECT_EQ(to_json(back).dump(), text);
    // Every setting of the population is among them.
    EXPECT_EQ(nlohmann::json::parse(text)["population"], to_json(simulation.population));
}

TEST(Simulation, RefusesWhatNoneWrote) {
    for (const char* text :
         {"", "{}", "[1]", R"({"seed":-1})", R"({"seed":1.5})", R"({"seed":1,"observers":0})", R"({"seed":1,"more":1})",
          R"({"seed":1,"population":{"beta":-1}})", R"({"seed":1,"population":{"height":2}})"}) {
        EXPECT_THROW(simulation_from_json(text, "plan"), InputError) << text;
    }
}

TEST(Simulation, ObserversDependOnTheSeedAndTheirPlaceAlone) {
    const Simulation few{2, 5, {}};
    const Simulation many{20, 5, {}};
    const Simulation other{2, 6, {}};
    EXPECT_EQ(session_record(few, 1).seed, session_record(many, 1).seed);
    EXPECT_NE(session_record(few, 1).seed, session_record(few, 0).seed);
    EXPECT_NE(session_record(few, 1).seed, session_record(other, 1).seed);
    EXPECT_EQ(session_record(many, 11).observer, "sim12");
    const auto slope = [](const Simulation& s, int i) { return simulated_observer(s, i).true_slope(Pattern::step, 1); };
    EXPECT_EQ(slope(few, 1), slope(many, 1));
    EXPECT_NE(slope(few, 1), slope(few, 0));
    EXPECT_NE(slope(few, 1), slope(other, 1));
}

}  // namespace
}  // namespace stairstep
