#include "study/engines/psi_marginal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "stimuli/error.h"
#include "study/engines/block_information.h"

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e7;
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

double scale_of(double logarithm) {
    const double scale = std::exp(logarithm);
    return scale < kNoScale ? 0 : scale;
}

double at(double low, double high, int count, int i) {
    return count == 1 ? low : low + (high - low) * i / (count - 1);
}

double binary_entropy_bits(double p) {
    return p > 0 && p < 1 ? -p * std::log2(p) - (1 - p) * std::log2(1 - p) : 0;
}

}  // namespace

/// What doesn't change: the lattice, the shapes, and Ψ.
struct PsiMarginal::Tables {
    PsiMarginalSettings settings;
    /// Thresholds are guess + (i − half)·grain, i < columns = 2·half + 1; stimuli the same with −pad ≤ i < columns + pad.
    int half;
    size_t columns;
    /// Columns rounded up to whole blocks, as arrays have them; beyond `columns` the posterior is 0.
    size_t padded;
    int pad;
    /// Sorted by β; a group is as many consecutive rows as are summed out together.
    std::vector<PsychometricShape> shapes;
    std::vector<double> offsets;
    size_t group_rows;
    /// 10^{−β(T − guess)}: u = 10^{β(x − guess + ε)} times this.
    std::vector<double> decays;
    /// Ψ(x − T) of each shape against i_T − i_x + columns − 1 + pad, `stride` a row.
    std::vector<float> psi;
    size_t stride;

    explicit Tables(const PsiMarginalSettings& s) : settings(s) {
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

    double distance_at(size_t column) const { return (static_cast<double>(column) - half) * settings.grain; }
    double threshold_at(size_t column) const { return settings.guess + distance_at(column); }
    double stimulus_at(int index) const { return settings.guess + (index - half) * settings.grain; }
    int lowest_stimulus() const { return -pad; }
    int highest_stimulus() const { return static_cast<int>(columns) - 1 + pad; }
    int stimulus_near(double intensity) const {
        const double index = std::round((intensity - settings.guess) / settings.grain) + half;
        return static_cast<int>(std::clamp<double>(index, lowest_stimulus(), highest_stimulus()));
    }
    /// Ψ for the stimulus, from this column's threshold on.
    const float* window(int stimulus, size_t row, size_t column) const {
        const int start = static_cast<int>(columns) - 1 + pad - stimulus;
        return psi.data() + row * stride + static_cast<size_t>(start) + column;
    }
};

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

PsiMarginal::PsiMarginal(const PsiMarginalSettings& settings) : tables_(std::make_shared<const Tables>(settings)) {
    const Tables& t = *tables_;
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
    for (size_t row = 0; row < row_floor_.size(); ++row) update_row(row, intensity, correct);
    ++trials_;
    summarise();
}

void PsiMarginal::update_row(size_t row, double intensity, bool correct) {
    const Tables& t = *tables_;
    const PsychometricShape& shape = t.shapes[row];
    const double offset = t.offsets[row];
    double* product = product_.data() + row * t.padded;

    // Ψ falls with T: the least likely threshold is the lowest after a wrong answer, the highest after a right one.
    const double exponent = shape.beta * (intensity - t.settings.guess + offset);
    const double farthest = shape.beta * -t.distance_at(0);
    const bool in_range = std::abs(exponent) + farthest < 300;
    const double u = in_range ? std::pow(10.0, exponent) : 0;
    const double* decay = t.decays.data() + row * t.padded;
    const double smallest = in_range ? answer_probability(shape, u * decay[correct ? t.columns - 1 : 0], correct) : 0;
    if (row_floor_[row] * smallest < kSmallestProduct) fold_row(row);
    if (smallest < kSmallestProduct) {
        double* log_base = log_base_.data() + row * t.padded;
        for (size_t i = 0; i < t.columns; ++i) {
            log_base[i] += log_likelihood(shape, offset, intensity, t.threshold_at(i), correct);
            scale_[row * t.padded + i] = scale_of(log_base[i] - reference_);
        }
        return;
    }
    size_t i = 0;
    if (correct || shape.delta > kNoLapse) {
        // Much lower thresholds, nearly half the grid, all give the same and need no exponential.
        const double certain = answer_probability(shape, kCertain, correct);
        for (; i < t.columns && u * decay[i] > kCertain; ++i) product[i] *= certain;
    }
    for (; i < t.columns; ++i) product[i] *= answer_probability(shape, u * decay[i], correct);
    row_floor_[row] *= smallest;
}

void PsiMarginal::fold_row(size_t row) {
    if (row_floor_[row] == 1) return;
    const size_t padded = tables_->padded;
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
    const Tables& t = *tables_;
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
    const Tables& t = *tables_;
    double below = 0;
    for (size_t i = 0; i < t.columns; ++i) {
        if (marginal_[i] > 0 && below + marginal_[i] >= order) {
            return t.threshold_at(i) + t.settings.grain * ((order - below) / marginal_[i] - 0.5);
        }
        below += marginal_[i];
    }
    return t.threshold_at(t.columns - 1) + t.settings.grain / 2;
}

Estimate PsiMarginal::estimate() const {
    return {mean_, sd_, quantile(0.025), quantile(0.975)};
}

double PsiMarginal::beta() const {
    double sum = 0;
    for (size_t row = 0; row < shape_marginal_.size(); ++row) {
        sum += shape_marginal_[row] * std::log(tables_->shapes[row].beta);
    }
    return std::exp(sum);
}

double PsiMarginal::delta() const {
    double sum = 0;
    for (size_t row = 0; row < shape_marginal_.size(); ++row) sum += shape_marginal_[row] * tables_->shapes[row].delta;
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
    const Tables& t = *tables_;
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
    const Tables& t = *tables_;
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
    return information(blocks(), std::array{tables_->stimulus_near(intensity)})[0] * std::numbers::ln2;
}

double PsiMarginal::suggest() const {
    const Tables& t = *tables_;
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
