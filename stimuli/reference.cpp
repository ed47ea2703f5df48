#include "stimuli/reference.h"

#include <algorithm>
#include <cmath>

#include "stimuli/draw.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr double kStep = 1.02;
constexpr double kPrecision = 1e-6;

bool is_alike(const Stimulus& artifact, Likeness likeness, double radius_px) {
    switch (likeness) {
        case Likeness::one_level: return largest_difference(artifact, radius_px, false) <= 1;
        case Likeness::half_level: return largest_difference(artifact, radius_px, false) <= 0.5;
        case Likeness::identical: return largest_difference(artifact, radius_px, true) == 0;
    }
    return false;
}

}  // namespace

double largest_difference(const Stimulus& artifact, double radius_px, bool rounded) {
    if (artifact.pattern == Pattern::line) {
        throw InputError("pattern line", "has no reference radius: it is the reference", "use step, stair or slope");
    }
    Stimulus sampled = artifact;
    sampled.kernel.radius_px = radius_px;
    Stimulus line = sampled;
    line.pattern = Pattern::line;
    const StimulusSampler sampled_at(sampled);
    const StimulusSampler line_at(line);
    // Where both repeat, a line does so wherever its staircase does: what lies right of one period has been seen, but for
    // the rows at the bottom, which have nothing below them to be copies of.
    const Translation period = sampled_at.period();
    double largest = 0;
    for (int row = 0; row < artifact.height_px; ++row) {
        const bool repeats = period.up > 0 && row + period.up < artifact.height_px;
        const int fresh = repeats ? period.right : artifact.width_px;
        for (int column = 0; column < fresh; ++column) {
            const double a = sampled_at.luminance(column, row);
            const double b = line_at.luminance(column, row);
            largest = std::max(largest, rounded ? std::abs(level_8bit(a) - level_8bit(b)) : 255 * std::abs(a - b));
        }
    }
    return largest;
}

std::optional<double> reference_radius(const Stimulus& artifact, Likeness likeness, double largest_radius_px) {
    double alike = largest_radius_px;
    if (!is_alike(artifact, likeness, alike)) return std::nullopt;
    // Below a hundredth of a texel, or of a pixel, a filter no longer does anything.
    const double smallest = 0.01 * std::min(artifact.texel_px, 1.0);
    double different = alike / kStep;
    while (is_alike(artifact, likeness, different)) {
        alike = different;
        different /= kStep;
        if (different < smallest) return 0;
    }
    while (alike - different > kPrecision * alike) {
        const double middle = (alike + different) / 2;
        (is_alike(artifact, likeness, middle) ? alike : different) = middle;
    }
    return alike;
}

}  // namespace stairstep
