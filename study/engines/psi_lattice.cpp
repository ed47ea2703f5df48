#include "study/engines/psi_lattice.h"

#include <string>

#include "stimuli/error.h"
#include "study/engines/block_information.h"

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e7;

void require_valid(const PsiMarginalSettings& s) {
    const auto require = [](bool holds, const std::string& subject, const char* problem) {
        if (!holds) {
            throw InputError("psi-marginal " + subject, problem,
                             "compare the settings with study/engines/psi_marginal.h");
        }
    };
    const auto is_axis = [](double low, double high, int count) {
        return std::isfinite(low) && std::isfinite(high) && (count == 1 ? low == high : count > 1 && low < high);
    };
    require(std::isfinite(s.guess), "guess", "must be a finite number");
    require(s.guess_sd > 0 && std::isfinite(s.guess_sd), "guess SD", "must be a finite number above 0");
    require(is_axis(s.beta_low, s.beta_high, s.beta_count) && s.beta_low > 0, "slopes",
            "need 0 < low < high, or low = high for a single one");
    require(s.beta_guess > 0 && std::isfinite(s.beta_guess) && s.beta_log_sd > 0, "slope prior",
            "needs a guess and an SD above 0");
    require(is_axis(s.delta_low, s.delta_high, s.delta_count) && s.delta_low >= 0 && s.delta_scale > 0, "lapse rates",
            "need 0 ≤ low < high, or low = high for a single one, and a scale above 0");
    require(is_axis(s.gamma_low, s.gamma_high, s.gamma_count) && s.gamma_low >= 0, "guess rates",
            "need 0 ≤ low < high, or low = high for a single one");
    for (const double gamma : {s.gamma_low, s.gamma_high}) {
        for (const double delta : {s.delta_low, s.delta_high}) {
            require(is_valid({.beta = s.beta_low, .gamma = gamma, .delta = delta, .p_threshold = s.p_threshold}),
                    "threshold probability", "must lie between the highest γ and the lowest 1 − δ(1 − γ)");
        }
    }
    require(s.grain > 0 && s.range > 2 * s.grain &&
                s.range / s.grain * s.beta_count * s.delta_count * s.gamma_count <= kLargestGrid,
            "grid", "needs a grain above 0, a range of more than two grains and at most 10^7 points");
}

double at(double low, double high, int count, int i) {
    return count == 1 ? low : low + (high - low) * i / (count - 1);
}

}  // namespace

PsiLattice::PsiLattice(const PsiMarginalSettings& s) : settings(s) {
    require_valid(s);
    half = static_cast<int>(std::ceil(s.range / s.grain / 2));
    columns = 2 * static_cast<size_t>(half) + 1;
    padded = (columns + kLane - 1) / kLane * kLane;
    pad = static_cast<int>(std::min(std::ceil(1 / s.beta_low / s.grain), static_cast<double>(half)));
    for (int b = 0; b < s.beta_count; ++b) {
        const double log_beta = at(std::log(s.beta_low), std::log(s.beta_high), s.beta_count, b);
        for (int g = 0; g < s.gamma_count; ++g) {
            for (int d = 0; d < s.delta_count; ++d) {
                // A single slope is the one asked for, to the last bit.
                shapes.push_back({.beta = s.beta_count == 1 ? s.beta_low : std::exp(log_beta),
                                  .gamma = at(s.gamma_low, s.gamma_high, s.gamma_count, g),
                                  .delta = at(s.delta_low, s.delta_high, s.delta_count, d),
                                  .p_threshold = s.p_threshold});
                offsets.push_back(threshold_offset(shapes.back()));
            }
        }
    }
    group_rows = s.learn_slope ? shapes.size() / static_cast<size_t>(s.beta_count) : shapes.size();
    stride = 2 * (columns - 1 + static_cast<size_t>(pad)) + 1 + kLane;
    psi.resize(shapes.size() * stride);
    decays.assign(shapes.size() * padded, 1);
    for (size_t row = 0; row < shapes.size(); ++row) {
        for (size_t k = 0; k < stride; ++k) {
            const double distance = s.grain * (static_cast<double>(columns) - 1 + pad - static_cast<double>(k));
            psi[row * stride + k] = static_cast<float>(probability_correct(shapes[row], offsets[row], distance, 0));
        }
        for (size_t i = 0; i < columns; ++i) {
            decays[row * padded + i] = std::pow(10.0, -shapes[row].beta * distance_at(i));
        }
    }
}

}  // namespace stairstep
