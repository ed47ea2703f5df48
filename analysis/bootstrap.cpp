#include "analysis/bootstrap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "analysis/statistics.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

/// Estimates of all replicates, in no order but always the same.
std::vector<double> replicates(const BootstrapSettings& settings, const std::function<double(Random)>& replicate) {
    assert(settings.replicates >= 1);
    std::vector<double> values(static_cast<size_t>(settings.replicates));
    const Random random(settings.seed);
    run_in_parallel(values.size(), settings.jobs, [&](size_t i) { values[i] = replicate(random.stream(i)); });
    return values;
}

/// a, from estimates that leave out one unit each.
double jackknife_acceleration(size_t units, const Statistic& statistic) {
    std::vector<double> left_out(units);
    std::vector<size_t> indices;
    for (size_t j = 0; j < units; ++j) {
        indices.clear();
        for (size_t i = 0; i < units; ++i) {
            if (i != j) indices.push_back(i);
        }
        left_out[j] = statistic(indices);
    }
    const double mean = std::accumulate(left_out.begin(), left_out.end(), 0.0) / static_cast<double>(units);
    double squares = 0;
    double cubes = 0;
    for (const double value : left_out) {
        squares += (mean - value) * (mean - value);
        cubes += (mean - value) * (mean - value) * (mean - value);
    }
    return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

}  // namespace

BcaInterval bca_interval(size_t units, const Statistic& statistic, double level, const BootstrapSettings& settings) {
    assert(units >= 2 && level > 0 && level < 1);
    std::vector<size_t> all(units);
    std::iota(all.begin(), all.end(), size_t{0});
    BcaInterval result;
    result.estimate = statistic(all);
    std::vector<double> values = replicates(settings, [&](Random random) {
        std::vector<size_t> drawn(units);
        for (size_t& index : drawn) index = random.below(units);
        return statistic(drawn);
    });
    std::sort(values.begin(), values.end());
    if (values.front() == values.back()) {
        result.interval = {values.front(), values.back()};
        return result;
    }
    const double count = static_cast<double>(values.size());
    const auto [first_equal, last_equal] = std::equal_range(values.begin(), values.end(), result.estimate);
    const double below = static_cast<double>(first_equal - values.begin()) +
                         static_cast<double>(last_equal - first_equal) / 2;  // ties count half
    // All on one side would make z0 infinite: half a replicate is the least that is known.
    result.bias_correction = normal_quantile(std::clamp(below / count, 0.5 / count, 1 - 0.5 / count));
    result.acceleration = jackknife_acceleration(units, statistic);
    const auto end = [&](double p) {
        const double z = result.bias_correction + normal_quantile(p);
        return quantile_of_sorted(values, normal_cdf(result.bias_correction + z / (1 - result.acceleration * z)));
    };
    result.interval = {end((1 - level) / 2), end((1 + level) / 2)};
    return result;
}

std::pair<double, double> studentised_interval(const StudyEstimate& estimate,
                                               const std::function<StudyEstimate(Random)>& simulate,
                                               const BootstrapSettings& settings) {
    std::vector<double> t = replicates(settings, [&](Random random) {
        const StudyEstimate study = simulate(random);
        return study.se > 0 ? (study.mean - estimate.mean) / study.se : 0;
    });
    std::sort(t.begin(), t.end());
    return {estimate.mean - quantile_of_sorted(t, 0.975) * estimate.se,
            estimate.mean - quantile_of_sorted(t, 0.025) * estimate.se};
}

}  // namespace stairstep
