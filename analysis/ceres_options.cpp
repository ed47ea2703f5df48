#include "analysis/ceres_options.h"

#include <cmath>
#include <utility>

namespace stairstep {

std::vector<double> standard_errors(ceres::Problem& problem, const double* parameters) {
    const int m = problem.NumResiduals();
    const int n = problem.ParameterBlockSize(parameters);
    if (m <= n) return {};
    double cost = 0;  // Σr²/2
    if (!problem.Evaluate({}, &cost, nullptr, nullptr, nullptr)) return {};
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;  // says false where J is rank-deficient, and takes badly scaled columns
    options.min_reciprocal_condition_number = 0;
    ceres::Covariance covariance(options);
    std::vector<double> matrix(static_cast<size_t>(n) * n);
    const std::vector<std::pair<const double*, const double*>> blocks{{parameters, parameters}};
    if (!covariance.Compute(blocks, &problem) ||
        !covariance.GetCovarianceBlock(parameters, parameters, matrix.data())) {
        return {};
    }
    std::vector<double> errors;
    for (int i = 0; i < n; ++i) {
        const double variance = 2 * cost / (m - n) * matrix[static_cast<size_t>(i) * n + i];
        if (!(variance >= 0) || !std::isfinite(variance)) return {};
        errors.push_back(std::sqrt(variance));
    }
    return errors;
}

}  // namespace stairstep
