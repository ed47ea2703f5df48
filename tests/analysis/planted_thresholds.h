// Thresholds of made-up observers whose true slopes are known: studies that take microseconds.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/threshold_fit.h"
#include "stimuli/random.h"

namespace stairstep {

inline Threshold planted_threshold(const std::string& observer, const Condition& condition, double radius_px,
                                   double ln_sd) {
    Threshold t;
    t.observer = observer;
    t.condition = condition;
    t.log_threshold = std::log10(condition.texel_px / radius_px);
    t.log_threshold_sd = ln_sd / std::log(10.0);
    t.trials = 40;
    return t;
}

struct PlantedStudy {
    /// Slope of each condition; the first two are step at 100 % and 50 %, then stair likewise.
    std::vector<double> slopes{3.47, 3.33, 2.5, 2.4};
    int observers = 10;
    std::vector<double> texels_px{5, 10, 20, 30};
    /// SD of ln c between observers, and the share of its variance that conditions have in common.
    double between_sd = 0.16;
    double common_share = 0.75;
    /// SD of a threshold's logarithm; each track's own is this times e^{±½}, known to the fit.
    double threshold_sd = 0.12;

    std::vector<Threshold> thresholds(Random random) const {
        std::vector<Threshold> all;
        for (int j = 0; j < observers; ++j) {
            const double common = std::sqrt(common_share) * random.normal();
            for (size_t k = 0; k < slopes.size(); ++k) {
                const double effect = between_sd * (common + std::sqrt(1 - common_share) * random.normal());
                for (const double a : texels_px) {
                    const double sd = threshold_sd * std::exp(random.uniform() - 0.5);
                    const Condition condition{k < 2 ? Pattern::step : Pattern::stair, KernelShape::box,
                                              k % 2 == 0 ? 1 : 0.5, a};
                    all.push_back(planted_threshold("o" + std::to_string(j), condition,
                                                    a * slopes[k] * std::exp(effect + sd * random.normal()), sd));
                }
            }
        }
        return all;
    }
};

}  // namespace stairstep
