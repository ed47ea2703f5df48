#include "analysis/worst_case.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "analysis/statistics.h"
#include "stimuli/parallel.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

constexpr size_t kStudies = 4000;
/// Studies that one task simulates, from one stream.
constexpr size_t kBatch = 100;

/// One condition, its observers in the order of all observers.
struct Column {
    RandomEffects fit;
    /// Weight share of each observer, 0 where the condition lacks them.
    std::vector<double> weight;
    /// (y_j − m)·√w_j over the root of their mean square: what conditions may have in common. 0 where the condition lacks them.
    std::vector<double> residual;
    double observers = 0;
};

Column column_of(const EffectsByObserver& effects, const std::vector<std::string>& observers) {
    std::vector<Effect> values;
    for (const auto& [observer, effect] : effects) values.push_back(effect);
    Column column{fit_random_effects(values), {}, {}, static_cast<double>(values.size())};
    double squares = 0;
    size_t next = 0;
    for (const std::string& observer : observers) {
        const auto found = effects.find(observer);
        const double weight = found == effects.end() ? 0 : column.fit.weight[next++];
        column.weight.push_back(weight);
        const double residual = weight > 0 ? (found->second.value - column.fit.mean) * std::sqrt(weight) : 0;
        column.residual.push_back(residual);
        squares += residual * residual;
    }
    for (double& r : column.residual) r = squares > 0 ? r / std::sqrt(squares) : 0;
    return column;
}

/// max_k of the t statistics of a study in which all means are 0.
double largest_t(const std::vector<Column>& columns, size_t observers, Random& random) {
    std::vector<double> draws(observers);
    std::vector<std::vector<double>> study(columns.size(), std::vector<double>(observers));
    for (size_t j = 0; j < observers; ++j) {
        for (double& draw : draws) draw = random.normal();
        for (size_t k = 0; k < columns.size(); ++k) {
            double value = 0;
            for (size_t i = 0; i < observers; ++i) value += draws[i] * columns[k].residual[i];
            study[k][j] = value;  // variance 1
        }
    }
    double largest = -INFINITY;
    for (size_t k = 0; k < columns.size(); ++k) {
        const std::vector<double>& weight = columns[k].weight;
        double mean = 0;
        for (size_t j = 0; j < observers; ++j) mean += std::sqrt(weight[j]) * study[k][j];  // w·(u/√w), Σ w = 1
        double squares = 0;
        for (size_t j = 0; j < observers; ++j) {
            if (weight[j] == 0) continue;
            const double deviation = study[k][j] - mean * std::sqrt(weight[j]);
            squares += deviation * deviation;
        }
        // A condition without spread has no t of its own and an interval that is a point.
        if (squares > 0) largest = std::max(largest, mean / std::sqrt(squares / (columns[k].observers - 1)));
    }
    return largest;
}

/// The .975 quantile of `largest_t`; −∞ where no condition has a spread.
double simultaneous_t(const std::vector<Column>& columns, size_t observers, uint64_t seed, int jobs) {
    std::vector<double> largest(kStudies);
    const Random random(seed);
    run_in_parallel(kStudies / kBatch, jobs, [&](size_t batch) {
        Random stream = random.stream(batch);
        for (size_t i = 0; i < kBatch; ++i) largest[batch * kBatch + i] = largest_t(columns, observers, stream);
    });
    if (*std::max_element(largest.begin(), largest.end()) == -INFINITY) return -INFINITY;
    std::sort(largest.begin(), largest.end());
    return quantile_of_sorted(largest, 0.975);
}

}  // namespace

WorstCase worst_case(const std::vector<EffectsByObserver>& conditions, uint64_t seed, int jobs,
                     const std::vector<ConditionMean>& means) {
    assert(!conditions.empty());
    std::vector<std::string> observers;
    for (const EffectsByObserver& effects : conditions) {
        assert(effects.size() >= 2);
        for (const auto& [observer, effect] : effects) observers.push_back(observer);
    }
    std::sort(observers.begin(), observers.end());
    observers.erase(std::unique(observers.begin(), observers.end()), observers.end());
    std::vector<Column> columns;
    for (const EffectsByObserver& effects : conditions) columns.push_back(column_of(effects, observers));

    assert(means.empty() || means.size() == conditions.size());

    WorstCase worst;
    double alone = 0;
    for (size_t k = 0; k < columns.size(); ++k) {
        const ConditionMean mean = means.empty() ? ConditionMean{columns[k].fit.mean, columns[k].fit.se} : means[k];
        const double t = t_quantile(0.975, columns[k].observers - 1);
        alone = std::max(alone, t);
        if (k == 0 || mean.mean > worst.mean) {
            worst.mean = mean.mean;
            worst.condition = k;
        }
        const double upper = mean.mean + t * mean.se;
        worst.ci95.second = k == 0 ? upper : std::max(worst.ci95.second, upper);
    }
    worst.critical_value =
        columns.size() > 1 ? std::max(alone, simultaneous_t(columns, observers.size(), seed, jobs)) : alone;
    for (size_t k = 0; k < columns.size(); ++k) {
        const ConditionMean mean = means.empty() ? ConditionMean{columns[k].fit.mean, columns[k].fit.se} : means[k];
        const double lower = mean.mean - worst.critical_value * mean.se;
        worst.ci95.first = k == 0 ? lower : std::max(worst.ci95.first, lower);
    }
    return worst;
}

}  // namespace stairstep
