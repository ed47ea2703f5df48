#include "analysis/law/grating_error.h"

#include <cmath>
#include <numbers>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// F_m² falls as 1/m², so what is left out of the mean square is below 1/(π²·kHarmonics).
constexpr int kHarmonics = 4000;
/// Frequencies farther from 0 than this, in cycles a texel, keep less than 1/(π²·ν²·2r/a)² of their square.
constexpr int kAliases = 6;

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return std::abs(angle) < 1e-9 ? 1 : std::sin(angle) / angle;
}

double squared(double x) {
    return x * x;
}

}  // namespace

double grating_rmse(const Grating& grating, double texel, double radius) {
    const auto refuse = [](const char* subject, double value, const char* range) {
        throw InputError(std::string(subject) + " " + format_number(value), range, "use for example 0.05 of 0.1");
    };
    // Written so that NaN fails.
    if (!(texel > 0 && std::isfinite(texel))) refuse("texel", texel, "must be a finite number above 0");
    if (!(radius >= texel && std::isfinite(radius))) refuse("radius", radius, "must be at least a texel");
    if (!(grating.period >= texel / 10 && grating.period <= 30 * radius)) {
        refuse("period", grating.period, "must be from a tenth of a texel to 30 times the filter's radius");
    }
    if (!(grating.gap > 0 && grating.gap < grating.period)) {
        refuse("gap", grating.gap, "must be above 0 and below the period");
    }

    double sum = 0;
    for (int m = 1; m <= kHarmonics; ++m) {
        const double amplitude = std::sin(std::numbers::pi * m * grating.gap / grating.period) / (std::numbers::pi * m);
        const double frequency = m * texel / grating.period;
        double error = squared((1 - sinc(frequency)) * sinc(2 * radius / texel * frequency));
        const double nearest = -std::round(frequency);
        for (int i = -kAliases; i <= kAliases; ++i) {
            const double n = nearest + i;
            if (n == 0) continue;
            const double alias = frequency + n;
            error += squared(sinc(alias) * sinc(2 * radius / texel * alias));
        }
        // m and −m alike.
        sum += 2 * amplitude * amplitude * error;
    }
    return std::sqrt(sum);
}

}  // namespace stairstep
