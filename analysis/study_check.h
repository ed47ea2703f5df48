// Do the trials look like what the law was fitted under? Psychometric functions, their goodness of fit, sensitivity, lapses, and
// how thresholds scatter.
//
// The law r = c·a says that an observer's threshold of x = log10(a/r) is the same at all texel sizes of a condition. So one
// psychometric function is fitted to all trials of an observer in a condition, sizes together (psychometric_fit.h), and its
// goodness of fit tests the sigmoid and the law at once. Functions over several observers or conditions are fitted to aligned
// strengths x + log10 c_j = log10(c_j·a/r), which are 0 at the threshold of observer j's law.
//
// p values of several fits are combined by Fisher's method: −2·Σ ln p is χ² with 2n degrees of freedom.
//
// Thresholds of one observer scatter about their law by more than their standard deviations s_i allow for if the observer drifts
// between tracks or the law isn't the observer's: χ² = Σ_j Σ_i ((ln r_ij − ln(c_j·a_i))/s_ij)² with Σ_j (k_j − 1) degrees of
// freedom; √(χ²/df) is the Birge ratio (Birge 1932), 1 where s_i tell all. That is overdispersion between tracks. Within a track η
// (overdispersion.h) is estimated where strengths repeat, as constant stimuli do.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/goodness_of_fit.h"
#include "analysis/law_fit.h"
#include "analysis/psychometric_fit.h"
#include "analysis/signal_detection.h"

namespace stairstep {

/// One observer in one pattern, contrast and kernel, all texel sizes together.
struct ObserverCurve {
    std::string observer;
    ConditionName condition;
    /// In the order they were given; `trials` beside them.
    std::vector<Answer01> answers;
    std::vector<Trial> trials;
    /// log10 c_j, what aligns the strengths; none where the law has no slope of this observer.
    std::optional<double> log_slope;
    PsychometricFit fit;
    /// None where nothing could be fitted or no simulations were asked for.
    std::optional<GoodnessOfFit> goodness;
};

/// One observer, all conditions together.
struct ObserverCheck {
    std::string observer;
    Task task = Task::yes_no;
    int trials = 0;
    int right = 0;
    Sensitivity sensitivity;
    /// Over aligned strengths: what is said of the lapse rate. None where the observer is in no law.
    std::optional<PsychometricFit> aligned;
    /// Smallest p values among the observer's conditions; none without simulations.
    std::optional<double> least_deviance_p;
    std::optional<double> least_order_p;
    int influential_trials = 0;
};

/// One condition, all its observers together.
struct ConditionCheck {
    ConditionName condition;
    /// Observers whose curves could be fitted and checked.
    int curves = 0;
    /// Over aligned strengths. None where no observer is in the law.
    std::optional<PsychometricFit> aligned;
    /// Combined over observers; none without simulations.
    std::optional<double> deviance_p;
    std::optional<double> prediction_p;
    std::optional<double> order_p;
    /// Of thresholds about observers' laws; no p where nobody has two sizes.
    double scatter_chi2 = 0;
    int scatter_df = 0;
    std::optional<double> scatter_p;
    /// Mean over tracks of η's posterior mean; none where strengths hardly repeat, which tells nothing of it.
    std::optional<double> overdispersion;
};

struct StudyCheck {
    /// In the order of first trials.
    std::vector<ObserverCurve> curves;
    std::vector<ObserverCheck> observers;
    /// In the order of Law::conditions, which they are of.
    std::vector<ConditionCheck> conditions;
    int simulations = 0;
    uint64_t seed = 1;
};

struct StudyCheckOptions {
    /// Of each curve, for goodness of fit; 0 for none. 200 bring p values down to .005.
    int simulations = 200;
    uint64_t seed = 1;
    /// Threads, 0 for one a core; results don't depend on it.
    int jobs = 0;
};

/// `trials` are those that `fit` is of. Same seed, same result.
StudyCheck check_study(const std::vector<Trial>& trials, const LawFit& fit, const StudyCheckOptions& options = {});

/// x + log10 c_j of all answers of the curves that have one, in order.
std::vector<Answer01> aligned_answers(const std::vector<const ObserverCurve*>& curves);

/// Fisher's combination; nullopt for no p value. Anchor: {.05, .05} → .0175.
std::optional<double> fisher_combined(const std::vector<double>& p_values);

/// P(χ² ≥ chi2), df > 0. Anchor: 3.841459 with one → .05.
double chi2_upper_p(double chi2, double df);

/// 95 % by the normal approximation; nullopt for a rate at its bound, or without a standard error. Cut off at 0.
std::optional<Interval> lapse_interval(const PsychometricFit& fit);

/// As "checks" of law.json: `simulations`, `seed`, `conditions`, `observers`; null where there is no number.
nlohmann::ordered_json to_json(const StudyCheck& check);

/// For a terminal: a table of conditions and one line about observers.
std::string check_table(const StudyCheck& check);

}  // namespace stairstep
