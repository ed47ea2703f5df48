// The study and the analysis together: laws planted in simulated observers come back, and 95 % intervals hold them about
// that often.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/law_fit.h"
#include "study/session.h"
#include "study/simulated_observer.h"

namespace stairstep {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kStudies = 3;  // a tenth of the speed
#else
constexpr int kStudies = 40;
#endif
constexpr int kObservers = 10;

TEST(PlantedLaw, IsRecoveredWithoutBiasAndCovered) {
    const SimulatedPopulation population;
    int covered = 0;
    int fits = 0;
    double bias = 0;
    double log_exponent = 0;
    for (int study = 0; study < kStudies; ++study) {
        std::vector<Trial> trials;
        for (int i = 0; i < kObservers; ++i) {
            Random random = Random(2017 + study).stream(static_cast<uint64_t>(i));
            const SessionIdentity identity{"o" + std::to_string(i), i, 1, random.bits()};
            SimulatedObserver observer(population, random.stream(0), 0);
            Session session({}, identity);
            run_session(session, observer, {[&](const Trial& trial) { trials.push_back(trial); }});
        }
        const LawFit fit = fit_law(trials, 0.82, "simulated");
        ASSERT_EQ(fit.law.conditions.size(), 4u);
        for (const ConditionLaw& law : fit.law.conditions) {
            const double planted = median_slope(population, law.pattern, law.contrast);
            covered += law.slope_ci95.first <= planted && planted <= law.slope_ci95.second;
            bias += std::log(law.slope / planted);
            log_exponent += law.exponent - 1;
            ++fits;
        }
    }
    bias /= fits;
    log_exponent /= fits;
    RecordProperty("coverage_percent", 100 * covered / fits);
    std::printf("coverage %.3f of %d intervals, bias of ln c %+.4f, of the exponent %+.4f\n",
                covered / static_cast<double>(fits), fits, bias, log_exponent);
    // Conditions of a study share observers: treat a study as one unit with SD .05 of ln c and .03 of coverage at most.
    EXPECT_LT(std::abs(bias), 0.01 + 3 * 0.05 / std::sqrt(kStudies));
    EXPECT_LT(std::abs(log_exponent), 0.01 + 3 * 0.04 / std::sqrt(kStudies));
    if (kStudies >= 40) {
        // 160 intervals, four a study: at .95 fewer than .86 comes about once in 5,000 runs of independent studies.
        EXPECT_GE(covered / static_cast<double>(fits), 0.86);
    }
}

}  // namespace
}  // namespace stairstep
