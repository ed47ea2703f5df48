#include "analysis/psychometric_likelihood.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stairstep {
namespace {

constexpr int kCount = kPsychometricParameters;
using Vector = PsychometricVector;
using Jet = ceres::Jet<double, kCount>;
using Model = PsychometricLikelihood;
using Optimum = LikelihoodOptimum;
/// How close to a bound, as a share of the interval, counts as at it.
constexpr double kAtBound = 1e-7;
/// How far beyond the strengths shown a threshold is looked for, log10 units.
constexpr double kReach = 3;

template <typename T>
PsychometricParameters<T> parameters_at(const std::array<T, kCount>& theta) {
    using std::exp;
    return {theta[0], exp(theta[1]), theta[2], theta[3]};
}

/// −ln L over φ of the parameters that are free here.
class NegativeLogLikelihood : public ceres::FirstOrderFunction {
  public:
    NegativeLogLikelihood(const Model& model, const Vector& theta, std::vector<int> free)
        : model_(model), theta_(theta), free_(std::move(free)) {}

    int NumParameters() const override { return static_cast<int>(free_.size()); }
    Vector theta(const double* phi) const {
        Vector theta = theta_;
        for (size_t k = 0; k < free_.size(); ++k) {
            const int i = free_[k];
            theta[i] = model_.low()[i] + (model_.high()[i] - model_.low()[i]) * std::pow(std::sin(phi[k]), 2);
        }
        return theta;
    }
    /// A start away from the bounds, where φ would feel no slope.
    std::vector<double> phi(const Vector& theta) const {
        std::vector<double> phi;
        for (const int i : free_) {
            phi.push_back(std::asin(std::sqrt(std::clamp(model_.share(theta, i), 2e-3, 1 - 2e-3))));
        }
        return phi;
    }
    bool Evaluate(const double* phi, double* cost, double* gradient) const override {
        double value;
        Vector by_theta;
        if (!model_.evaluate(theta(phi), value, gradient ? &by_theta : nullptr)) return false;
        *cost = -value;
        for (size_t k = 0; gradient && k < free_.size(); ++k) {
            const int i = free_[k];
            gradient[k] = -by_theta[i] * (model_.high()[i] - model_.low()[i]) * std::sin(2 * phi[k]);
        }
        return true;
    }

  private:
    const Model& model_;
    Vector theta_;
    std::vector<int> free_;
};

}  // namespace

PsychometricLikelihood::PsychometricLikelihood(const std::vector<Level>& levels,
                                               const PsychometricFitSettings& settings)
    : levels_(levels), settings_(settings) {
    assert(!levels.empty());
    middle_ = (levels.front().strength + levels.back().strength) / 2;
    const double reach = (levels.back().strength - levels.front().strength) / 2 + kReach;
    low_ = {-reach, std::log(settings.slopes.first), 0, settings.guess_is_free ? 0 : settings.guess};
    high_ = {reach, std::log(settings.slopes.second), settings.largest_lapse,
             settings.guess_is_free ? settings.largest_guess : settings.guess};
}

PsychometricParameters<double> PsychometricLikelihood::parameters(const Vector& theta) const {
    return parameters_at(theta);
}

Vector PsychometricLikelihood::theta_of(const PsychometricParameters<double>& f) const {
    return {f.threshold - middle_, std::log(f.slope), f.lapse, f.guess};
}

bool PsychometricLikelihood::evaluate(const Vector& theta, double& value, Vector* gradient) const {
    if (!gradient) return sum<double>(theta, value);
    std::array<Jet, kCount> jets;
    for (int i = 0; i < kCount; ++i) jets[i] = Jet(theta[i], i);
    Jet total;
    if (!sum<Jet>(jets, total)) return false;
    value = total.a;
    for (int i = 0; i < kCount; ++i) (*gradient)[i] = total.v[i];
    return std::all_of(gradient->begin(), gradient->end(), [](double g) { return std::isfinite(g); });
}

template <typename T>
bool PsychometricLikelihood::sum(const std::array<T, kCount>& theta, T& total) const {
    using std::log;
    const PsychometricParameters<T> f = parameters_at(theta);
    const T z_p = sigmoid_at_threshold(settings_.sigmoid, settings_.p_threshold, f);
    total = T(0.0);
    for (const Level& level : levels_) {
        const T wrong = probability_wrong(settings_.sigmoid, f, z_p, level.strength - middle_);
        if (level.right > 0) {
            if (!(sigmoid::value_of(wrong) < 1)) return false;
            total += level.right * log(1.0 - wrong);
        }
        if (level.trials > level.right) {
            if (!(sigmoid::value_of(wrong) > 0)) return false;
            total += (level.trials - level.right) * log(wrong);
        }
    }
    return std::isfinite(sigmoid::value_of(total));
}

bool PsychometricLikelihood::is_at_upper_bound(const Vector& theta, int i) const {
    return share(theta, i) >= 1 - kAtBound;
}

std::vector<int> PsychometricLikelihood::not_fixed() const {
    std::vector<int> free;
    for (int i = 0; i < kCount; ++i) {
        if (!is_fixed(i)) free.push_back(i);
    }
    return free;
}

std::vector<int> PsychometricLikelihood::inside(const Vector& theta) const {
    std::vector<int> free = not_fixed();
    std::erase_if(free, [&](int i) { return !(share(theta, i) > kAtBound && share(theta, i) < 1 - kAtBound); });
    return free;
}

Optimum climb(const Model& model, const Vector& start, const std::vector<int>& free) {
    Optimum optimum{start, -INFINITY};
    if (free.empty()) {
        model.evaluate(start, optimum.value, nullptr);
        return optimum;
    }
    auto* function = new NegativeLogLikelihood(model, start, free);
    ceres::GradientProblem problem(function);
    std::vector<double> phi = function->phi(start);
    ceres::GradientProblemSolver::Options options;
    options.line_search_direction_type = ceres::BFGS;
    options.logging_type = ceres::SILENT;
    // Interpolation logs a complaint where the likelihood is flat, which separable answers make it.
    options.line_search_interpolation_type = ceres::BISECTION;
    options.function_tolerance = 1e-15;
    options.gradient_tolerance = 1e-9;
    options.parameter_tolerance = 1e-13;
    options.max_num_iterations = 300;
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(options, problem, phi.data(), &summary);  // where it ends is judged by the caller
    const Vector theta = function->theta(phi.data());
    double value;
    if (model.evaluate(theta, value, nullptr)) optimum = {theta, value};
    return optimum;
}

std::optional<Eigen::MatrixXd> information(const Model& model, const Vector& theta, const std::vector<int>& free) {
    const int n = static_cast<int>(free.size());
    Eigen::MatrixXd matrix(n, n);
    for (int k = 0; k < n; ++k) {
        const int i = free[k];
        const double room = std::min(theta[i] - model.low()[i], model.high()[i] - theta[i]);
        const double step = std::min(1e-5, room / 2);
        Vector up = theta, down = theta, above, below;
        up[i] += step;
        down[i] -= step;
        double value;
        if (!model.evaluate(up, value, &above) || !model.evaluate(down, value, &below)) return std::nullopt;
        for (int j = 0; j < n; ++j) matrix(j, k) = (below[free[j]] - above[free[j]]) / (up[i] - down[i]);
    }
    return (matrix + matrix.transpose()) / 2;
}

bool finish(const Model& model, Optimum& optimum) {
    for (int step = 0; step < 30; ++step) {
        const std::vector<int> free = model.inside(optimum.theta);
        if (free.empty()) return true;
        const auto matrix = information(model, optimum.theta, free);
        Vector gradient;
        double value;
        if (!matrix || !model.evaluate(optimum.theta, value, &gradient)) return false;
        Eigen::VectorXd g(free.size());
        for (size_t k = 0; k < free.size(); ++k) g[k] = gradient[free[k]];
        const Eigen::LDLT<Eigen::MatrixXd> factors(*matrix);
        if (factors.info() != Eigen::Success || !factors.isPositive()) return g.norm() < 1e-6;
        const Eigen::VectorXd move = factors.solve(g);
        const double gain = g.dot(move) / 2;
        if (!std::isfinite(gain)) return g.norm() < 1e-6;
        if (gain < 1e-13 * std::max(1.0, std::abs(value))) return true;
        Optimum next = optimum;
        bool within = true;
        for (size_t k = 0; k < free.size(); ++k) {
            const int i = free[k];
            next.theta[i] += move[k];
            within = within && next.theta[i] > model.low()[i] && next.theta[i] < model.high()[i];
        }
        if (!within || !model.evaluate(next.theta, next.value, nullptr) || next.value < optimum.value)
            return gain < 1e-9;
        optimum = next;
    }
    return false;
}

std::optional<Eigen::MatrixXd> invert(const Model& model, const Eigen::MatrixXd& information,
                                      const std::vector<int>& free) {
    constexpr double kFlat = 1e-7;
    const Eigen::VectorXd diagonal = information.diagonal();
    for (size_t k = 0; k < free.size(); ++k) {
        const double width = model.high()[free[k]] - model.low()[free[k]];
        if (!(diagonal[static_cast<long>(k)] * width * width > 1e-3)) return std::nullopt;
    }
    const Eigen::VectorXd unit = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = unit.asDiagonal() * information * unit.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
    if (eigen.info() != Eigen::Success || !(eigen.eigenvalues().minCoeff() > kFlat)) return std::nullopt;
    const Eigen::MatrixXd inverse = scaled.inverse();
    return Eigen::MatrixXd(unit.asDiagonal() * inverse * unit.asDiagonal());
}

Optimum best_of_starts(const Model& model) {
    // The likelihood on a coarse lattice, then the climb from its best points.
    std::vector<Optimum> starts;
    const double first = model.levels().front().strength - model.middle();
    const double width = model.levels().back().strength - model.levels().front().strength;
    for (int t = 0; t <= 12; ++t) {
        for (const double slope : {0.7, 2.0, 4.0, 8.0, 20.0}) {
            for (const double lapse : {0.02, 0.5}) {
                Optimum start;
                start.theta = {first + width * (t - 2) / 8,
                               std::clamp(std::log(slope), model.low()[1], model.high()[1]),
                               model.is_fixed(2) ? model.low()[2] : lapse * model.high()[2], model.settings().guess};
                start.theta[0] = std::clamp(start.theta[0], model.low()[0], model.high()[0]);
                if (model.evaluate(start.theta, start.value, nullptr)) starts.push_back(start);
            }
        }
    }
    std::sort(starts.begin(), starts.end(), [](const Optimum& a, const Optimum& b) { return a.value > b.value; });
    Optimum best;
    // The best, and others that don't lie beside it.
    for (size_t k = 0; k < starts.size() && k < 9; k += 4) {
        const Optimum optimum = climb(model, starts[k].theta, model.not_fixed());
        if (optimum.value > best.value) best = optimum;
    }
    return best;
}

double profile_end(const Model& model, const Optimum& best, double bound, double direction, double step) {
    std::vector<int> others = model.not_fixed();
    std::erase(others, 0);
    Vector start = best.theta;
    const auto excess = [&](double t) {
        Vector from = start;
        from[0] = t;
        Optimum at = climb(model, from, others);
        from = best.theta;  // the way along the profile may have led into a valley of its own
        from[0] = t;
        const Optimum afresh = climb(model, from, others);
        if (afresh.value > at.value) at = afresh;
        if (std::isfinite(at.value)) start = at.theta;
        return 2 * (best.value - at.value) - bound;
    };
    const double limit = direction < 0 ? model.low()[0] : model.high()[0];
    double within = best.theta[0];
    double beyond = within;
    for (;; step *= 1.7) {
        beyond = direction < 0 ? std::max(limit, within - step) : std::min(limit, within + step);
        if (excess(beyond) > 0) break;
        if (beyond == limit) return direction * INFINITY;
        within = beyond;
    }
    for (int k = 0; k < 40 && std::abs(beyond - within) > 1e-8; ++k) {
        const double middle = (within + beyond) / 2;
        (excess(middle) > 0 ? beyond : within) = middle;
    }
    return (within + beyond) / 2 + model.middle();
}

}  // namespace stairstep
