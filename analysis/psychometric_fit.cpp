#include "analysis/psychometric_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

constexpr int kCount = kPsychometricParameters;
using Vector = std::array<double, kCount>;
using Jet = ceres::Jet<double, kCount>;
/// χ² with one degree of freedom, .95.
constexpr double kChiSquare95 = 3.841458820694124;
/// How close to a bound, as a share of the interval, counts as at it.
constexpr double kAtBound = 1e-7;
/// How far beyond the strengths shown a threshold is looked for, log10 units.
constexpr double kReach = 3;

/// Optimisation happens in threshold (about a middle), ln slope, lapse, guess.
struct Model {
    const std::vector<Level>& levels;
    const PsychometricFitSettings& settings;
    double middle;
    Vector low{}, high{};

    Model(const std::vector<Level>& all, const PsychometricFitSettings& s)
        : levels(all), settings(s), middle((all.front().strength + all.back().strength) / 2) {
        const double reach = (all.back().strength - all.front().strength) / 2 + kReach;
        low = {-reach, std::log(s.slopes.first), 0, s.guess_is_free ? 0 : s.guess};
        high = {reach, std::log(s.slopes.second), s.largest_lapse, s.guess_is_free ? s.largest_guess : s.guess};
    }

    template <typename T>
    PsychometricParameters<T> parameters(const std::array<T, kCount>& theta) const {
        using std::exp;
        return {theta[0], exp(theta[1]), theta[2], theta[3]};
    }

    /// ln L and its gradient; false where an answer is impossible.
    bool evaluate(const Vector& theta, double& value, Vector* gradient) const {
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
    bool sum(const std::array<T, kCount>& theta, T& total) const {
        using std::log;
        const PsychometricParameters<T> f = parameters(theta);
        const T z_p = sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, f);
        total = T(0.0);
        for (const Level& level : levels) {
            const T wrong = probability_wrong(settings.sigmoid, f, z_p, level.strength - middle);
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

    bool is_fixed(int i) const { return !(high[i] > low[i]); }
    double share(const Vector& theta, int i) const { return (theta[i] - low[i]) / (high[i] - low[i]); }
};

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
            theta[i] = model_.low[i] + (model_.high[i] - model_.low[i]) * std::pow(std::sin(phi[k]), 2);
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
            gradient[k] = -by_theta[i] * (model_.high[i] - model_.low[i]) * std::sin(2 * phi[k]);
        }
        return true;
    }

  private:
    const Model& model_;
    Vector theta_;
    std::vector<int> free_;
};

struct Optimum {
    Vector theta{};
    double value = -INFINITY;
};

/// ln L at its largest over the free parameters, from `start`.
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

/// −∂²ln L over some parameters, by central differences of the gradient. nullopt where ln L ends too soon.
std::optional<Eigen::MatrixXd> information(const Model& model, const Vector& theta, const std::vector<int>& free) {
    const int n = static_cast<int>(free.size());
    Eigen::MatrixXd matrix(n, n);
    for (int k = 0; k < n; ++k) {
        const int i = free[k];
        const double room = std::min(theta[i] - model.low[i], model.high[i] - theta[i]);
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

std::vector<int> not_fixed(const Model& model) {
    std::vector<int> free;
    for (int i = 0; i < kCount; ++i) {
        if (!model.is_fixed(i)) free.push_back(i);
    }
    return free;
}

/// Of those, the ones that are not at a bound.
std::vector<int> inside(const Model& model, const Vector& theta) {
    std::vector<int> free = not_fixed(model);
    std::erase_if(free,
                  [&](int i) { return !(model.share(theta, i) > kAtBound && model.share(theta, i) < 1 - kAtBound); });
    return free;
}

/// Newton steps while they gain; whether the last would have gained next to nothing.
bool finish(const Model& model, Optimum& optimum) {
    for (int step = 0; step < 30; ++step) {
        const std::vector<int> free = inside(model, optimum.theta);
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
            within = within && next.theta[i] > model.low[i] && next.theta[i] < model.high[i];
        }
        if (!within || !model.evaluate(next.theta, next.value, nullptr) || next.value < optimum.value)
            return gain < 1e-9;
        optimum = next;
    }
    return false;
}

/// Covariance from information; nullopt where the likelihood is flat in some direction, to what differences can tell.
std::optional<Eigen::MatrixXd> invert(const Model& model, const Eigen::MatrixXd& information,
                                      const std::vector<int>& free) {
    constexpr double kFlat = 1e-7;
    const Eigen::VectorXd diagonal = information.diagonal();
    for (size_t k = 0; k < free.size(); ++k) {
        const double width = model.high[free[k]] - model.low[free[k]];
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
    const double first = model.levels.front().strength - model.middle;
    const double width = model.levels.back().strength - model.levels.front().strength;
    for (int t = 0; t <= 12; ++t) {
        for (const double slope : {0.7, 2.0, 4.0, 8.0, 20.0}) {
            for (const double lapse : {0.02, 0.5}) {
                Optimum start;
                start.theta = {first + width * (t - 2) / 8, std::clamp(std::log(slope), model.low[1], model.high[1]),
                               model.is_fixed(2) ? model.low[2] : lapse * model.high[2], model.settings.guess};
                start.theta[0] = std::clamp(start.theta[0], model.low[0], model.high[0]);
                if (model.evaluate(start.theta, start.value, nullptr)) starts.push_back(start);
            }
        }
    }
    std::sort(starts.begin(), starts.end(), [](const Optimum& a, const Optimum& b) { return a.value > b.value; });
    Optimum best;
    // The best, and others that don't lie beside it.
    for (size_t k = 0; k < starts.size() && k < 9; k += 4) {
        const Optimum optimum = climb(model, starts[k].theta, not_fixed(model));
        if (optimum.value > best.value) best = optimum;
    }
    return best;
}

/// Where the profile likelihood of T falls to the limit, on one side.
double profile_end(const Model& model, const Optimum& best, double direction, double step) {
    std::vector<int> others = not_fixed(model);
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
        return 2 * (best.value - at.value) - kChiSquare95;
    };
    const double limit = direction < 0 ? model.low[0] : model.high[0];
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
    return (within + beyond) / 2 + model.middle;
}

void require(bool holds, const char* problem, const char* remedy) {
    if (!holds) throw InputError("psychometric fit", problem, remedy);
}

void require_valid(const PsychometricFitSettings& s) {
    require(s.guess >= 0 && s.guess < 1, "guess rate not in [0, 1)", "give one in it");
    require(s.largest_lapse >= 0 && s.largest_lapse < 1, "largest lapse rate not in [0, 1)", "give one in it");
    require(s.slopes.first > 0 && s.slopes.second > s.slopes.first && std::isfinite(s.slopes.second),
            "slopes are no interval above 0", "give the smaller one first");
    const double guess = s.guess_is_free ? s.largest_guess : s.guess;
    require(!s.guess_is_free || (s.guess <= s.largest_guess && s.largest_guess < 1 && s.largest_guess > 0),
            "guess rate beyond its largest", "start it lower");
    const double lowest_top = s.guess_is_free ? 1 - s.largest_lapse : 1 - s.largest_lapse * (1 - guess);
    require(s.p_threshold > guess && s.p_threshold < lowest_top,
            "threshold probability not between guessing and what lapses leave", "move it, or allow fewer lapses");
}

}  // namespace

std::vector<Level> levels_of(const std::vector<Answer01>& answers) {
    std::vector<Level> levels;
    levels.reserve(answers.size());
    for (const Answer01& answer : answers) levels.push_back({answer.strength, answer.correct ? 1.0 : 0.0, 1});
    std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.strength < b.strength; });
    size_t kept = 0;
    for (size_t k = 1; k < levels.size(); ++k) {
        if (levels[k].strength == levels[kept].strength) {
            levels[kept].right += levels[k].right;
            levels[kept].trials += levels[k].trials;
        } else {
            levels[++kept] = levels[k];
        }
    }
    if (!levels.empty()) levels.resize(kept + 1);
    return levels;
}

double deviance_residual(const Level& level, double wrong) {
    const double right_share = level.right / level.trials;
    double half = 0;
    if (level.right > 0) half += level.right * std::log(right_share / (1 - wrong));
    if (level.right < level.trials) half += (level.trials - level.right) * std::log((1 - right_share) / wrong);
    return std::copysign(std::sqrt(std::max(0.0, 2 * half)), right_share - (1 - wrong));
}

double PsychometricFit::probability(double strength) const {
    const double z_p = sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, parameters);
    return 1 - probability_wrong(settings.sigmoid, parameters, z_p, strength);
}

std::optional<double> PsychometricFit::threshold_at(double p) const {
    if (!estimated || !(p > parameters.guess && p < 1 - parameters.lapse * (1 - parameters.guess))) return std::nullopt;
    return parameters.threshold + (sigmoid_at_threshold(settings.sigmoid, p, parameters) -
                                   sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, parameters)) /
                                      parameters.slope;
}

std::optional<double> PsychometricFit::threshold_sd() const {
    if (!covariance || at_bound[0]) return std::nullopt;
    return std::sqrt((*covariance)[0]);
}

PsychometricFit fit_psychometric(const std::vector<Answer01>& answers, const PsychometricFitSettings& settings) {
    return fit_psychometric(levels_of(answers), settings);
}

PsychometricFit fit_psychometric(const std::vector<Level>& levels, const PsychometricFitSettings& settings) {
    require_valid(settings);
    require(!levels.empty(), "no trials", "record some");
    double right = 0;
    double trials = 0;
    for (const Level& level : levels) {
        require(std::isfinite(level.strength) && std::abs(level.strength) < 1000, "a strength that is no number",
                "give positive sizes and radii");
        require(level.trials > 0 && level.right >= 0 && level.right <= level.trials, "impossible counts",
                "give right answers of trials");
        right += level.right;
        trials += level.trials;
    }
    PsychometricFit fit;
    fit.settings = settings;
    fit.levels = levels;
    fit.threshold_ci95 = {-INFINITY, INFINITY};
    if (right == trials || right == 0) {
        fit.reason = right == 0 ? "all answers wrong: the threshold is bounded below alone"
                                : "all answers right: the threshold is bounded above alone";
        return fit;
    }
    if (levels.size() == 1) {
        fit.reason = "one strength only: it takes two to tell threshold and slope";
        return fit;
    }

    const Model model(fit.levels, fit.settings);
    Optimum best = best_of_starts(model);
    if (!std::isfinite(best.value)) {
        fit.reason = "no function explains these answers: wrong ones where none can be";
        return fit;
    }
    fit.converged = finish(model, best);
    fit.estimated = true;
    const std::vector<int> free = inside(model, best.theta);
    fit.at_bound.fill(true);
    for (const int i : free) fit.at_bound[i] = false;
    fit.parameters = model.parameters(best.theta);
    fit.parameters.threshold += model.middle;
    fit.log_likelihood = best.value;

    const double z_p = sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, fit.parameters);
    for (const Level& level : fit.levels) {
        const double wrong = probability_wrong(settings.sigmoid, fit.parameters, z_p, level.strength);
        fit.deviance_residuals.push_back(deviance_residual(level, wrong));
        fit.deviance += fit.deviance_residuals.back() * fit.deviance_residuals.back();
    }

    if (const auto matrix = information(model, best.theta, free); matrix && !free.empty()) {
        if (const auto inverse = invert(model, *matrix, free)) {
            fit.covariance.emplace();
            fit.covariance->fill(0);
            const auto unit = [&](int i) { return i == 1 ? fit.parameters.slope : 1.0; };  // from ln b to b
            for (size_t j = 0; j < free.size(); ++j) {
                for (size_t k = 0; k < free.size(); ++k) {
                    (*fit.covariance)[free[j] * kCount + free[k]] = (*inverse)(j, k) * unit(free[j]) * unit(free[k]);
                }
            }
        }
    }
    const double step = fit.threshold_sd().value_or(0.1);
    fit.threshold_ci95 = {profile_end(model, best, -1, std::clamp(step, 1e-4, 1.0)),
                          profile_end(model, best, +1, std::clamp(step, 1e-4, 1.0))};

    if (fit.at_bound[0]) {
        fit.reason = "the threshold is at the end of its range: answers don't get better with strength";
    } else if (model.share(best.theta, 1) >= 1 - kAtBound) {
        fit.reason =
            "the slope is at its upper bound: a step explains the answers best, and may lie anywhere between two "
            "strengths";
    } else if (fit.at_bound[1]) {
        fit.reason = "the slope is at its lower bound: answers hardly get better with strength";
    } else if (!fit.converged || !fit.covariance) {
        fit.reason = "no clear maximum: a range of thresholds and slopes explains the answers equally well";
    } else if (!std::isfinite(fit.threshold_ci95.first) || !std::isfinite(fit.threshold_ci95.second)) {
        fit.reason = std::isfinite(fit.threshold_ci95.second)  ? "the threshold is bounded above alone"
                     : std::isfinite(fit.threshold_ci95.first) ? "the threshold is bounded below alone"
                                                               : "the threshold is bounded on neither side";
    }
    return fit;
}

std::optional<Refit> refit_from(const PsychometricFit& fit, const std::vector<Level>& levels) {
    if (!fit.estimated || levels.empty()) return std::nullopt;
    const Model model(levels, fit.settings);
    Vector start{fit.parameters.threshold - model.middle, std::log(fit.parameters.slope), fit.parameters.lapse,
                 fit.parameters.guess};
    const Optimum optimum = climb(model, start, not_fixed(model));
    if (!std::isfinite(optimum.value)) return std::nullopt;
    Refit refit;
    refit.parameters = model.parameters(optimum.theta);
    refit.parameters.threshold += model.middle;
    refit.log_likelihood = optimum.value;
    const double z_p = sigmoid_at_threshold(fit.settings.sigmoid, fit.settings.p_threshold, refit.parameters);
    for (const Level& level : levels) {
        const double residual =
            deviance_residual(level, probability_wrong(fit.settings.sigmoid, refit.parameters, z_p, level.strength));
        refit.deviance += residual * residual;
    }
    return refit;
}

std::array<double, kPsychometricParameters> score(const PsychometricFit& fit, const Answer01& answer) {
    const std::vector<Level> level{{answer.strength, answer.correct ? 1.0 : 0.0, 1}};
    const Model model(level, fit.settings);
    const Vector theta{fit.parameters.threshold - model.middle, std::log(fit.parameters.slope), fit.parameters.lapse,
                       fit.parameters.guess};
    Vector gradient{};
    double value;
    if (!model.evaluate(theta, value, &gradient)) return {};
    gradient[1] /= fit.parameters.slope;
    return gradient;
}

}  // namespace stairstep
