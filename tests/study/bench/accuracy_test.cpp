#include "study/bench/accuracy.h"

#include <gtest/gtest.h>

#include <set>

namespace stairstep {
namespace {

TEST(Accuracy, FisherBoundIsThePublishedOne) {
    EXPECT_NEAR(fisher_bound({}, 0.5, 20), 0.0527, 5e-5);
    EXPECT_NEAR(fisher_bound({}, 0.5, 40), 0.0374, 5e-5);
    EXPECT_NEAR(fisher_bound({}, 0.5, 60), 0.0306, 5e-5);
    EXPECT_DOUBLE_EQ(fisher_bound({}, 0.5, 0), 0.5);
}

TEST(Accuracy, EveryMethodLearnsAndNoneBeatsTheBound) {
    std::set<std::string> names;
    TrackSimulation simulation{.checkpoints = {20, 80}, .runs = 60};
    for (const BenchMethod& method : bench_methods()) {
        SCOPED_TRACE(method.name);
        EXPECT_TRUE(names.insert(method.name).second);
        const auto results = method.simulate(simulation);
        const ErrorSummary early = summarise(results[0]);
        const ErrorSummary late = summarise(results[1]);
        EXPECT_LT(early.rmse, 0.5);
        EXPECT_LT(late.rmse, early.rmse);
        EXPECT_GT(early.rmse + 2 * early.rmse_se, fisher_bound({}, 0.5, 20));
        EXPECT_GT(late.rmse + 2 * late.rmse_se, fisher_bound({}, 0.5, 80));
    }
}

}  // namespace
}  // namespace stairstep
