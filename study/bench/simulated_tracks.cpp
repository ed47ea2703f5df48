#include "study/bench/simulated_tracks.h"

#include <algorithm>

namespace stairstep {

ErrorSummary summarise(std::span<const TrackResult> results) {
    const auto count = static_cast<double>(results.size());
    double sum = 0, squares = 0, fourths = 0, covered = 0;
    std::vector<double> sizes;
    for (const TrackResult& result : results) {
        const double square = result.error * result.error;
        sum += result.error;
        squares += square;
        fourths += square * square;
        covered += result.is_covered;
        sizes.push_back(std::abs(result.error));
    }
    ErrorSummary summary{.runs = static_cast<int>(results.size())};
    const double mean_square = squares / count;
    summary.rmse = std::sqrt(mean_square);
    const double mean_square_se = std::sqrt(std::max(0.0, fourths / count - mean_square * mean_square) / (count - 1));
    summary.rmse_se = summary.rmse > 0 ? mean_square_se / (2 * summary.rmse) : 0;
    summary.bias = sum / count;
    summary.bias_se = std::sqrt(std::max(0.0, mean_square - summary.bias * summary.bias) / (count - 1));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    summary.robust_sd = 1.4826 * *middle;
    summary.coverage = covered / count;
    summary.coverage_se = std::sqrt(summary.coverage * (1 - summary.coverage) / count);
    return summary;
}

}  // namespace stairstep
