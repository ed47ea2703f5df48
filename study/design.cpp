#include "study/design.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Of a display and the way to it: wider than any, and no quotient of two is without bounds.
constexpr double kShortestLength_mm = 1e-6;
constexpr double kLongestLength_mm = 1e9;

/// Row of a balanced Latin square of `size` treatments (Williams 1949): 0, 1, n−1, 2, n−2, … shifted by the row.
std::vector<int> latin_square_row(int size, int row) {
    std::vector<int> order;
    for (int place = 0; place < size; ++place) {
        const int zigzag = place % 2 == 1 ? (place + 1) / 2 : (size - place / 2) % size;
        order.push_back((zigzag + row) % size);
    }
    return order;
}

/// Each texel size is a track with an engine of its own in memory.
constexpr size_t kMostValues = 100;

/// A list that is not empty, has at most kMostValues, none of them twice, and holds only what `is_good`
/// allows.
template <typename T, typename Require, typename IsGood>
void require_list(const Require& require, const std::vector<T>& values, const char* field, const char* allowed,
                  const IsGood& is_good) {
    require(!values.empty(), field, "is empty", "name at least one");
    require(values.size() <= kMostValues, field, "holds over 100 values", "no observer has time for so many");
    for (auto value = values.begin(); value != values.end(); ++value) {
        require(is_good(*value), field, std::string("holds a value that isn't ") + allowed, "correct or remove it");
        require(std::find(values.begin(), value, *value) == value, field, "holds a value twice",
                "conditions must differ; remove one");
    }
}

bool is_positive(double value) {
    return value > 0 && value <= std::numeric_limits<float>::max();
}

}  // namespace

double Viewing::pixels_per_degree() const {
    return 2 * distance_mm * std::tan(std::numbers::pi / 360) / pixel_pitch_mm;
}

void require_valid(const Design& d, const std::string& source) {
    const auto require = [&source](bool holds, const char* field, const std::string& problem, const char* remedy) {
        if (!holds) throw InputError(source + ", \"" + field + "\"", problem, remedy);
    };
    require(!d.name.empty(), "name", "is empty", "name the study");
    require_list(require, d.patterns, "patterns", "step or stair",
                 [](Pattern p) { return p == Pattern::step || p == Pattern::stair; });
    require_list(require, d.contrasts, "contrasts", "above 0 and at most 1", [](double c) { return c > 0 && c <= 1; });
    require_list(require, d.texels_px, "texels_px", "a length above 0 px", is_positive);
    const double twentieths = d.line_share * 20;
    require(twentieths > 0.5 && twentieths < 19.5 && std::abs(twentieths - std::round(twentieths)) < 1e-9, "line_share",
            format_number(d.line_share) + " is no multiple of 0.05 from 0.05 to 0.95", "use 0.5");
    require(is_positive(d.guess_radius_texels), "guess_radius_texels", "must be above 0", "use for example 3");
    require(d.stop.least_trials >= 1 && d.stop.least_trials <= d.stop.most_trials && d.stop.most_trials <= 1'000'000,
            "stop", "needs 1 ≤ least_trials ≤ most_trials ≤ 10^6", "use for example \"most_trials\": 40");
    require(!d.stop.converged_sd || is_positive(*d.stop.converged_sd), "converged_sd", "must be above 0",
            "use for example 0.05");
    require(d.easy.practice_trials >= 0 && d.easy.practice_trials <= 10000, "practice_trials", "must be 0 to 10000",
            "use for example 8");
    require(d.easy.catch_share >= 0 && d.easy.catch_share < 0.5, "catch_share", "must be 0 or above and below 0.5",
            "use for example 0.05");
    require(is_positive(d.easy.radius_texels), "easy_radius_texels", "must be above 0", "use for example 0.5");
    require(d.break_every_trials >= 0, "break_every_trials", "must be 0 or above", "use for example 100");
    require(is_positive(d.smallest_radius_px) && is_positive(d.largest_radius_px) &&
                d.smallest_radius_px < d.largest_radius_px,
            "radius_px", "needs two radii above 0 px, the smaller first", "use for example [0.25, 320]");
    const auto is_side = [](int side) { return side >= 1 && side <= 16384; };
    require(is_side(d.width_px) && is_side(d.height_px), "size_px", "needs two sides of 1 to 16384 px",
            "use for example [640, 480]");
    const auto is_length = [](double mm) { return mm >= kShortestLength_mm && mm <= kLongestLength_mm; };
    require(!d.viewing || (is_length(d.viewing->distance_mm) && is_length(d.viewing->pixel_pitch_mm)), "viewing",
            "needs lengths from 1e-6 mm to 1e9 mm", "use for example {\"distance_mm\": 600, \"pixel_pitch_mm\": 0.25}");
    RoundEngine(engine_settings(d), d.texels_px.size(), 1);  // throws for settings that are out of range
}

std::vector<Round> rounds_for(const Design& design, int observer_index) {
    std::vector<Round> rounds;
    for (const Pattern pattern : design.patterns) {
        for (const double contrast : design.contrasts) {
            Round round;
            for (const double texel_px : design.texels_px) {
                round.tracks.push_back({pattern, design.kernel, contrast, texel_px});
            }
            rounds.push_back(round);
        }
    }
    const int count = static_cast<int>(rounds.size());
    std::vector<Round> ordered;
    for (const int i : latin_square_row(count, observer_index % count)) ordered.push_back(rounds[i]);
    return ordered;
}

EngineSettings engine_settings(const Design& design) {
    EngineSettings settings = design.engine;
    guess_of(settings) = -std::log10(design.guess_radius_texels);
    return settings;
}

}  // namespace stairstep
