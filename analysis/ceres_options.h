// How the project's least-squares fits run Ceres, in one place, so that what is checked against NIST's reference data
// (tests/analysis/nist_test.cpp) is what fits use.
//
// For few parameters of order 1 (scale them: Ceres' Jacobian scaling is not enough for columns that differ by 10⁸) and up to
// thousands of residuals. Tolerances are those of doubles: a fit runs until it can't improve.
#pragma once

#include <ceres/ceres.h>

#include <vector>

namespace stairstep {

/// `initial_trust_region_radius`: Ceres' default where starts may be far off; 10¹² gives plain Gauss-Newton steps for problems
/// that are nearly linear.
inline ceres::Solver::Options least_squares_options(double initial_trust_region_radius = 1e4) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.initial_trust_region_radius = initial_trust_region_radius;
    options.max_trust_region_radius = 1e32;
    options.function_tolerance = 1e-18;
    options.gradient_tolerance = 1e-18;
    options.parameter_tolerance = 1e-14;
    options.max_num_iterations = 10000;
    return options;
}

/// Standard errors of the parameters of an unweighted least-squares fit: √ of the diagonal of s²(JᵀJ)⁻¹ with the residual variance
/// s² = Σr²/(m − n). Ceres' own covariance takes residuals to have unit variance. Empty where Ceres finds J rank-deficient, or
/// m ≤ n. The problem has the one parameter block `parameters` of n numbers, at the optimum.
std::vector<double> standard_errors(ceres::Problem& problem, const double* parameters);

}  // namespace stairstep
