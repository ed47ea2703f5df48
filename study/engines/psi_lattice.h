// What stays the same during a psi-marginal track and is shared by copies of it: the lattice of thresholds and stimuli, the
// shapes (β, γ, δ), and Ψ as a table for each shape.
//
// Thresholds and stimuli lie on one lattice, so Ψ depends on the difference of their indices alone. Along rising
// thresholds a stimulus sees a window of its shape's table, and another stimulus the same window shifted.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/engines/psi_marginal.h"
#include "study/psychometric.h"

namespace stairstep {

struct PsiLattice {
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

    /// Throws InputError as PsiMarginal does.
    explicit PsiLattice(const PsiMarginalSettings& settings);

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

}  // namespace stairstep
