#include "renderer/bench/bars.h"

#include <gtest/gtest.h>

namespace stairstep::bench {
namespace {

Measurement measured(const Configuration& configuration, double time_ratio, double rmse, double penumbra_rmse,
                     double wobble) {
    Measurement one;
    one.configuration = configuration;
    one.time_ratio = time_ratio;
    one.error.rmse = rmse;
    one.error.penumbra_rmse = penumbra_rmse;
    one.wobble = MotionWobble{wobble, wobble, wobble};
    return one;
}

std::vector<bool> met(const std::vector<Measurement>& measurements) {
    std::vector<bool> result;
    for (const Bar& bar : bars_of(measurements)) result.push_back(bar.met);
    return result;
}

TEST(Bars, AreMetUpToTheirLimits) {
    EXPECT_EQ(met({measured(auto_pcf(), 0.4, 0.5, 0.019, 0.1), measured(fixed_pcf(), 1, 0.1, 0.02, 0.1),
                   measured(auto_pcss(), 0.5, 0.3, 0.2, 0.1), measured(fixed_pcss(), 1, 0.1, 0.2, 0.1)}),
              (std::vector<bool>{true, true, true, true}));
}

TEST(Bars, AreMissedBeyondThem) {
    const Measurement pcf = measured(fixed_pcf(), 1, 0.1, 0.02, 0.1);
    const Measurement pcss = measured(fixed_pcss(), 1, 0.1, 0.2, 0.1);
    EXPECT_EQ(met({measured(auto_pcf(), 0.41, 0, 0, 0.11), pcf, measured(auto_pcss(), 0.51, 0, 0, 0.11), pcss}),
              (std::vector<bool>{false, false, false, false}));
    EXPECT_EQ(met({measured(auto_pcf(), 0.1, 0, 0.02, 0), pcf, measured(auto_pcss(), 0.1, 0, 0.21, 0), pcss}),
              (std::vector<bool>{false, false, true, true}))
        << "PCF's error has to be lower, PCSS's no higher";
}

TEST(Bars, TellOnlyOfWhatWasMeasured) {
    EXPECT_TRUE(bars_of({}).empty());
    Measurement sized = measured(auto_pcf(), 0.1, 0, 0, 0);
    sized.wobble.reset();
    EXPECT_EQ(met({sized, measured(fixed_pcf(), 1, 0.1, 0.02, 0.1)}), std::vector<bool>{true});
    EXPECT_TRUE(bars_of({measured(auto_pcss(), 0.1, 0, 0, 0)}).empty());
}

}  // namespace
}  // namespace stairstep::bench
