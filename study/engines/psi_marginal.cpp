#include "study/engines/psi_marginal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "study/engines/block_information.h"
#include "study/engines/psi_lattice.h"

namespace stairstep {
namespace {

/// Products are folded into logarithms before they fall below this, and scales below kNoScale count as 0 until the
/// reference moves, which it does once the mass is below kSmallestMass: no product of the two is subnormal, and what
/// counts as 0 is less than 10⁻¹⁰⁰ of the mass.
constexpr double kSmallestProduct = 1e-100;
constexpr double kNoScale = 1e-200;
constexpr double kSmallestMass = 1e-100;
constexpr int kCandidates = 48;
/// e^−u is nothing beside 1 or a lapse rate above kNoLapse when u is greater than this.
constexpr double kCertain = 60;
constexpr double kNoLapse = 1e-9;

/// Blocks with less of the posterior are left out of the choice of stimulus: together they tell less than 10⁻⁵ nats.
constexpr double kSmallestBlock = 1e-8;
/// Weights below this count as 0 in the choice, so that no float is subnormal.
constexpr double kNoWeight = 1e-20;

double scale_of(double logarithm) {
    const double scale = std::exp(logarithm);
    return scale < kNoScale ? 0 : scale;
}

double binary_entropy_bits(double p) {
    return p > 0 && p < 1 ? -p * std::log2(p) - (1 - p) * std::log2(1 - p) : 0;
}

}  // namespace

PsiMarginalSettings minimum_entropy_settings(const QuestSettings& quest) {
    PsiMarginalSettings s;
    s.guess = quest.guess;
    s.guess_sd = quest.guess_sd;
    s.grain = quest.grain;
    s.range = quest.range;
    s.beta_low = s.beta_high = s.beta_guess = quest.shape.beta;
    s.delta_low = s.delta_high = quest.shape.delta;
    s.gamma_low = s.gamma_high = quest.shape.gamma;
    s.beta_count = s.delta_count = s.gamma_count = 1;
    s.p_threshold = quest.shape.p_threshold;
    return s;
}

PsiMarginal::PsiMarginal(const PsiMarginalSettings& settings) : lattice_(std::make_shared<const PsiLattice>(settings)) {
    const PsiLattice& t = *lattice_;
    const size_t rows = t.shapes.size();
    log_base_.assign(rows * t.padded, -std::numeric_limits<double>::infinity());
    scale_.resize(log_base_.size());
    product_.assign(log_base_.size(), 1);
    row_floor_.assign(rows, 1);
    for (size_t row = 0; row < rows; ++row) {
        const double slope = std::log(t.shapes[row].beta / settings.beta_guess) / settings.beta_log_sd;
        const double log_prior = -slope * slope / 2 - t.shapes[row].delta / settings.delta_scale;
        for (size_t i = 0; i < t.columns; ++i) {
            const double z = t.distance_at(i) / settings.guess_sd;
            log_base_[row * t.padded + i] = log_prior - z * z / 2;
        }
    }
    set_reference();
    summarise();
}

void PsiMarginal::update(double intensity, bool correct) {
    // An answer that every shape holds nearly impossible tells thresholds apart by how much so. What all have in common
    // is left out: it may be so large that what was known before would vanish beside it.
    const PsiLattice& t = *lattice_;
    const size_t likeliest = correct ? 0 : t.columns - 1;
    double common = -std::numeric_limits<double>::infinity();
    for (size_t row = 0; row < row_floor_.size(); ++row) {
        if (least_likelihood(row, intensity, correct) >= kSmallestProduct) {
            common = 0;
            break;
        }
        common = std::max(common,
                          log_likelihood(t.shapes[row], t.offsets[row], intensity, t.threshold_at(likeliest), correct));
    }
    for (size_t row = 0; row < row_floor_.size(); ++row) update_row(row, intensity, correct, common);
    ++trials_;
    summarise();
}

double PsiMarginal::least_likelihood(size_t row, double intensity, bool correct) const {
    // Ψ falls with T: the least likely threshold is the lowest after a wrong answer, the highest after a right one.
    const PsiLattice& t = *lattice_;
    const double threshold = t.threshold_at(correct ? t.columns - 1 : 0);
    const double u = weibull_exponent(t.shapes[row], t.offsets[row], intensity, threshold);
    return answer_probability(t.shapes[row], u, correct);
}

void PsiMarginal::update_row(size_t row, double intensity, bool correct, double common) {
    const PsiLattice& t = *lattice_;
    const PsychometricShape& shape = t.shapes[row];
    const double offset = t.offsets[row];
    // u = 10^exponent·decay, where neither factor over- or underflows.
    const double exponent = shape.beta * (intensity - t.settings.guess + offset);
    const bool in_range = std::abs(exponent) + shape.beta * -t.distance_at(0) < 300;
    const double least = in_range ? least_likelihood(row, intensity, correct) : 0;
    if (row_floor_[row] * least < kSmallestProduct) fold_row(row);
    if (least < kSmallestProduct) {
        for (size_t i = 0; i < t.columns; ++i) {
            double& log_base = log_base_[row * t.padded + i];
            log_base += log_likelihood(shape, offset, intensity, t.threshold_at(i), correct) - common;
            scale_[row * t.padded + i] = scale_of(log_base - reference_);
        }
        return;
    }
    const double u = std::pow(10.0, exponent);
    const double* decay = t.decays.data() + row * t.padded;
    double* product = product_.data() + row * t.padded;
    size_t i = 0;
    if (correct || shape.delta > kNoLapse) {
        // Much lower thresholds, nearly half the grid, all give the same and need no exponential.
        const double certain = answer_probability(shape, kCertain, correct);
        for (; i < t.columns && u * decay[i] > kCertain; ++i) product[i] *= certain;
    }
    for (; i < t.columns; ++i) product[i] *= answer_probability(shape, u * decay[i], correct);
    row_floor_[row] *= least;
}

void PsiMarginal::fold_row(size_t row) {
    if (row_floor_[row] == 1) return;
    const size_t padded = lattice_->padded;
    for (size_t i = row * padded; i < (row + 1) * padded; ++i) {
        log_base_[i] += std::log(product_[i]);
        product_[i] = 1;
        scale_[i] = scale_of(log_base_[i] - reference_);
    }
    row_floor_[row] = 1;
}

void PsiMarginal::set_reference() {
    for (size_t row = 0; row < row_floor_.size(); ++row) fold_row(row);
    reference_ = *std::max_element(log_base_.begin(), log_base_.end());
    for (size_t i = 0; i < log_base_.size(); ++i) {
        scale_[i] = scale_of(log_base_[i] - reference_);
    }
}

void PsiMarginal::summarise() {
    const PsiLattice& t = *lattice_;
    shape_marginal_.resize(t.shapes.size());
    const auto sum_up = [&] {
        marginal_.assign(t.padded, 0);
        for (size_t row = 0; row < t.shapes.size(); ++row) {
            const double* scale = scale_.data() + row * t.padded;
            const double* product = product_.data() + row * t.padded;
            std::array<double, kLane> sums{};
            for (size_t first = 0; first < t.padded; first += kLane) {
                std::array<double, kLane> weights;
                for (size_t k = 0; k < kLane; ++k) weights[k] = scale[first + k] * product[first + k];
                for (size_t k = 0; k < kLane; ++k) marginal_[first + k] += weights[k];
                for (size_t k = 0; k < kLane; ++k) sums[k] += weights[k];
            }
            shape_marginal_[row] = std::accumulate(sums.begin(), sums.end(), 0.0);
        }
        mass_ = std::accumulate(marginal_.begin(), marginal_.end(), 0.0);
    };
    sum_up();
    if (mass_ < kSmallestMass) {
        set_reference();
        sum_up();
    }
    for (double& m : marginal_) m /= mass_;
    for (double& m : shape_marginal_) m /= mass_;

    double centre = 0;
    for (size_t i = 0; i < t.columns; ++i) centre += marginal_[i] * t.distance_at(i);
    double variance = 0;
    for (size_t i = 0; i < t.columns; ++i) {
        variance += marginal_[i] * (t.distance_at(i) - centre) * (t.distance_at(i) - centre);
    }
    mean_ = t.settings.guess + centre;
    sd_ = std::sqrt(variance);
}

double PsiMarginal::quantile(double order) const {
    // Each grid point stands for the cell around it; the mass within a cell is spread evenly.
    const PsiLattice& t = *lattice_;
    double below = 0;
    for (size_t i = 0; i < t.columns; ++i) {
        if (marginal_[i] > 0 && below + marginal_[i] >= order) {
            return t.threshold_at(i) + t.settings.grain * ((order - below) / marginal_[i] - 0.5);
        }
        below += marginal_[i];
    }
    return t.threshold_at(t.columns - 1) + t.settings.grain / 2;
}

ThresholdEstimate PsiMarginal::estimate() const {
    return {mean_, sd_, quantile(0.025), quantile(0.975)};
}

double PsiMarginal::beta() const {
    double sum = 0;
    for (size_t row = 0; row < shape_marginal_.size(); ++row) {
        sum += shape_marginal_[row] * std::log(lattice_->shapes[row].beta);
    }
    return std::exp(sum);
}

double PsiMarginal::delta() const {
    double sum = 0;
    for (size_t row = 0; row < shape_marginal_.size(); ++row) sum += shape_marginal_[row] * lattice_->shapes[row].delta;
    return sum;
}

/// The posterior as the choice of a stimulus needs it: blocks of thresholds that have some of it, in floats.
struct PsiMarginal::Blocks {
    struct Block {
        size_t row;
        size_t column;
        Lane mass{};
        Lane inverse_mass{};
    };
    std::vector<Block> blocks;
    /// kLane for each row of a block's group, block after block.
    std::vector<float> weights;
};

PsiMarginal::Blocks PsiMarginal::blocks() const {
    const PsiLattice& t = *lattice_;
    const double normalise = 1 / mass_;
    Blocks result;
    result.weights.resize(scale_.size());
    float* weights = result.weights.data();
    for (size_t column = 0; column < t.padded; column += kLane) {
        const double in_block = std::accumulate(&marginal_[column], &marginal_[column] + kLane, 0.0);
        if (in_block < kSmallestBlock) continue;
        for (size_t group = 0; group < t.shapes.size(); group += t.group_rows) {
            Lane mass{};
            for (size_t row = group; row < group + t.group_rows; ++row, weights += kLane) {
                const double* scale = &scale_[row * t.padded + column];
                const double* product = &product_[row * t.padded + column];
                std::array<double, kLane> p;
                for (size_t k = 0; k < kLane; ++k) p[k] = scale[k] * product[k] * normalise;
                for (size_t k = 0; k < kLane; ++k) weights[k] = static_cast<float>(p[k] < kNoWeight ? 0 : p[k]);
                for (size_t k = 0; k < kLane; ++k) mass[k] += weights[k];
            }
            Blocks::Block block{.row = group, .column = column, .mass = mass};
            for (size_t k = 0; k < kLane; ++k) block.inverse_mass[k] = mass[k] > 0 ? 1 / mass[k] : 0;
            result.blocks.push_back(block);
        }
    }
    return result;
}

std::vector<double> PsiMarginal::information(const Blocks& posterior, std::span<const int> stimuli) const {
    const PsiLattice& t = *lattice_;
    std::vector<double> right(stimuli.size());
    std::vector<double> given(stimuli.size());
    const float* weights = posterior.weights.data();
    for (const Blocks::Block& block : posterior.blocks) {
        for (size_t s = 0; s < stimuli.size(); ++s) {
            const BlockInformation sums =
                block_information(block.mass, block.inverse_mass, weights,
                                  t.window(stimuli[s], block.row, block.column), t.stride, t.group_rows);
            right[s] += sums.right;
            given[s] += sums.given_bits;
        }
        weights += t.group_rows * kLane;
    }
    std::vector<double> bits(stimuli.size());
    for (size_t s = 0; s < stimuli.size(); ++s) bits[s] = binary_entropy_bits(right[s]) - given[s];
    return bits;
}

double PsiMarginal::expected_information(double intensity) const {
    return information(blocks(), std::array{lattice_->stimulus_near(intensity)})[0] * std::numbers::ln2;
}

double PsiMarginal::suggest() const {
    const PsiLattice& t = *lattice_;
    double reach = 0;
    for (size_t row = 0; row < shape_marginal_.size(); ++row) reach += shape_marginal_[row] / t.shapes[row].beta;
    const int first = t.stimulus_near(quantile(0.005) - reach);
    const int last = t.stimulus_near(quantile(0.995) + reach);
    int step = std::max(1, (last - first + kCandidates - 1) / kCandidates);
    std::vector<int> candidates;
    for (int s = first; s <= last; s += step) candidates.push_back(s);
    candidates.push_back(t.highest_stimulus());

    const Blocks posterior = blocks();
    int best = first;
    double most = -1;
    const auto try_candidates = [&] {
        const std::vector<double> tells = information(posterior, candidates);
        for (size_t i = 0; i < candidates.size(); ++i) {
            if (tells[i] > most) {
                most = tells[i];
                best = candidates[i];
            }
        }
    };
    try_candidates();
    while (step > 1) {
        step = (step + 1) / 2;
        candidates.clear();
        for (const int s : {best - step, best + step}) {
            if (s >= t.lowest_stimulus() && s <= t.highest_stimulus()) candidates.push_back(s);
        }
        try_candidates();
    }
    return t.stimulus_at(best);
}

}  // namespace stairstep
