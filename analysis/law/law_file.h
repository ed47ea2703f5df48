// law.json: what analysis hands to renderers.
//
// The top level is the worst case, the largest slope among the conditions; `conditions` hold each on its own. Statistics behind
// them (law_statistics.h) are written, and ignored by readers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/law/law_statistics.h"
#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// The law of one pattern, contrast and kernel.
struct ConditionLaw {
    Pattern pattern = Pattern::step;
    /// C in (0, 1].
    double contrast = 1;
    KernelShape kernel = KernelShape::box;
    /// c: radius in texels, > 0.
    double slope = 0;
    Interval slope_ci95;
    /// How both were made, in words.
    std::string slope_method{};
    /// Whether intercept and exponent could be estimated, which takes two observers with two texel sizes each; if not, they are
    /// 0 and 1 by assumption and the file leaves them out.
    bool has_form = true;
    /// How intercept and exponent were made, or why not.
    std::string form_method{};
    /// b of r = b + c·a, px; 0 within its interval speaks for a law through the origin.
    double intercept_px = 0;
    Interval intercept_ci95;
    /// p of r = c·aᵖ; 1 within its interval speaks for a linear law.
    double exponent = 1;
    Interval exponent_ci95;
    /// Standard deviation of ln c between observers, measurement error included.
    double between_observer_sd_ln = 0;
    /// τ: the same without measurement error, by restricted maximum likelihood.
    double tau_ln = 0;
    int observers = 0;
    int trials = 0;

    /// The slope by every method that was asked for, the one above among them.
    std::vector<SlopeEstimate> estimates{};
    std::vector<ObserverSlope> observer_slopes{};
    std::vector<LeftOut> without_observer{};
    /// Empty where there is one size alone.
    std::vector<LeftOut> without_size{};
    /// By a robust fit alone.
    std::vector<DownWeighted> down_weighted{};
};

struct Law {
    /// A law holds for this kernel alone; see `slope_for_kernel`.
    KernelShape kernel = KernelShape::box;
    /// c of the worst case, > 0.
    double slope = 0;
    /// Respects that the worst case was picked as the largest: wider than that condition's own.
    Interval slope_ci95;
    std::string slope_method{};
    /// Share of correct answers at threshold: what "hidden" means.
    double threshold_probability = 0.82;
    Pattern pattern = Pattern::step;
    double contrast = 1;
    /// Texel sizes that were tested, px; beyond them the law extrapolates.
    Interval texel_range_px;
    int observers = 0;
    int trials = 0;
    /// Where it comes from and how the intervals were made, in words.
    std::string source;
    /// May be empty for a law stated without its data.
    std::vector<ConditionLaw> conditions;
    std::vector<Comparison> comparisons{};
    /// The law at several criteria, this one among them; empty where only one was asked for.
    std::vector<CriterionLaw> criteria{};
};

/// Reads a law; unknown keys are ignored. Throws InputError naming file and key for anything missing, mistyped or
/// out of range, or another format than "stairstep-law/1".
Law read_law(const std::filesystem::path& path);

/// As `read_law`, from text; `source` stands for the file's name in errors.
Law law_from_json(std::string_view text, const std::string& source);

/// The law that ships: Kreuzer's c = 3.47. The thesis doesn't name its kernel's shape; `box` is assumed.
Law kreuzer2017_law();

/// `read_law`, or the one that ships for the name "kreuzer2017".
Law law_named(const std::string& path_or_name);

/// What `write_law` writes, whose numbers it checks.
nlohmann::ordered_json to_json(const Law& law);

/// Writes a law, whole or not at all. Throws FailureError, also for a law with a number that isn't finite: no such number
/// reaches a file.
void write_law(const std::filesystem::path& path, const Law& law);
/// The same with an object's entries after the law's own: what else is known of the study, which readers of laws ignore.
void write_law(const std::filesystem::path& path, const Law& law, const nlohmann::ordered_json& more);

/// The law's slope for another kernel, by equal variance: c·σ(law.kernel)/σ(kernel).
double slope_for_kernel(const Law& law, KernelShape kernel);

}  // namespace stairstep
