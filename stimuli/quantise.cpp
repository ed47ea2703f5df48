#include "stimuli/quantise.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stairstep {
namespace {

constexpr Dither kDithers[] = {Dither::none, Dither::ordered, Dither::error_diffusion};

/// What each level shows.
class Levels {
  public:
    Levels(const Transfer& transfer, int bits) : transfer_(transfer), shown_(size_t{1} << bits) {
        for (size_t level = 0; level < shown_.size(); ++level) {
            shown_[level] = transfer.decode(static_cast<double>(level) / static_cast<double>(last()));
        }
    }

    size_t last() const { return shown_.size() - 1; }
    double shown(size_t level) const { return shown_[level]; }

    /// The level at or below a luminance that has one above.
    size_t below(double luminance) const {
        size_t level = static_cast<size_t>(transfer_.encode(luminance) * static_cast<double>(last()));
        level = std::min(level, last() - 1);
        // The transfer's rounding may have crossed a level.
        while (level > 0 && shown_[level] > luminance) --level;
        while (level + 1 < last() && shown_[level + 1] <= luminance) ++level;
        return level;
    }

    double clamped(double luminance) const { return std::clamp(luminance, shown_.front(), shown_.back()); }

    /// How far a luminance lies on the way from a level to the next, [0, 1].
    double share(size_t level, double luminance) const {
        return (luminance - shown_[level]) / (shown_[level + 1] - shown_[level]);
    }

  private:
    const Transfer& transfer_;
    std::vector<double> shown_;
};

/// Rank of a place in the 8 × 8 Bayer matrix, 0 … 63: the bits of column ^ row and row, interleaved, lowest first.
int bayer_rank(size_t column, size_t row) {
    const size_t mixed = column ^ row;
    size_t rank = 0;
    for (int bit = 0; bit < 3; ++bit) rank = rank << 2 | (mixed >> bit & 1) << 1 | (row >> bit & 1);
    return static_cast<int>(rank);
}

std::vector<float> nearest(std::span<const double> luminance, const Transfer& transfer, int bits) {
    std::vector<float> levels(luminance.size());
    std::transform(luminance.begin(), luminance.end(), levels.begin(),
                   [&](double value) { return static_cast<float>(nearest_level(value, transfer, bits)); });
    return levels;
}

std::vector<float> ordered(std::span<const double> luminance, size_t width, const Levels& levels) {
    std::vector<float> chosen(luminance.size());
    for (size_t i = 0; i < luminance.size(); ++i) {
        const double value = levels.clamped(luminance[i]);
        const size_t below = levels.below(value);
        const bool up = levels.share(below, value) > (bayer_rank(i % width, i / width) + 0.5) / 64;
        chosen[i] = static_cast<float>(below + up);
    }
    return chosen;
}

std::vector<float> diffused(std::span<const double> luminance, size_t width, const Levels& levels) {
    std::vector<float> chosen(luminance.size());
    // Errors owed to this row and the next.
    std::vector<double> here(width), below_here(width);
    for (size_t row = 0; row < luminance.size() / width; ++row) {
        const bool rightwards = row % 2 == 0;
        for (size_t step = 0; step < width; ++step) {
            const size_t column = rightwards ? step : width - 1 - step;
            const size_t i = row * width + column;
            const double wanted = levels.clamped(luminance[i]) + here[column];
            const double value = levels.clamped(wanted);
            const size_t level = levels.below(value);
            const size_t nearer = level + (levels.share(level, value) >= 0.5);
            chosen[i] = static_cast<float>(nearer);

            const double error = wanted - levels.shown(nearer);
            const size_t ahead = rightwards ? column + 1 : column - 1;
            const size_t behind = rightwards ? column - 1 : column + 1;
            // Past a side the unsigned index is out of range on the left as on the right.
            const auto owe_below = [&](size_t to, double share) {
                below_here[to < width ? to : column] += error * share / 16;
            };
            if (ahead < width) {
                here[ahead] += error * 7 / 16;
            } else {
                owe_below(column, 7);
            }
            owe_below(behind, 3);
            owe_below(column, 5);
            owe_below(ahead, 1);
        }
        here.swap(below_here);
        std::fill(below_here.begin(), below_here.end(), 0.0);
    }
    return chosen;
}

}  // namespace

double nearest_level(double luminance, const Transfer& transfer, int bits) {
    return std::floor(transfer.encode(luminance) * ((1 << bits) - 1) + 0.5 + 1e-9);
}

std::string_view name(Dither dither) {
    switch (dither) {
        case Dither::none: return "none";
        case Dither::ordered: return "ordered";
        case Dither::error_diffusion: return "error-diffusion";
    }
    return "";
}

std::optional<Dither> dither_named(std::string_view text) {
    for (const Dither dither : kDithers) {
        if (name(dither) == text) return dither;
    }
    return std::nullopt;
}

std::vector<float> quantise(std::span<const double> luminance, int width, const Transfer& transfer, int bits,
                            Dither dither) {
    assert((bits == 8 || bits == 16) && width > 0);
    switch (dither) {
        case Dither::none: break;
        case Dither::ordered: return ordered(luminance, static_cast<size_t>(width), Levels(transfer, bits));
        case Dither::error_diffusion: return diffused(luminance, static_cast<size_t>(width), Levels(transfer, bits));
    }
    return nearest(luminance, transfer, bits);
}

}  // namespace stairstep
