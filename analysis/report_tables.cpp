#include "analysis/report_tables.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/law/sizing.h"
#include "analysis/law_table.h"
#include "analysis/report_page.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Lists in a cell or sentence name so many, and count the rest.
constexpr size_t kMostNamed = 8;

/// A number with a typographer's minus, and zero without one.
std::string fixed(double value, int decimals) {
    std::string text = format_fixed(value, decimals);
    if (text.find_first_not_of("-0.") == std::string::npos) text = format_fixed(0, decimals);
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string to(const Interval& interval, int decimals) {
    return fixed(interval.first, decimals) + " to " + fixed(interval.second, decimals);
}

std::string with_brackets(double value, const Interval& interval, int decimals) {
    return fixed(value, decimals) + " [" + fixed(interval.first, decimals) + ", " + fixed(interval.second, decimals) +
           "]";
}

std::string described(const ConditionLaw& c) {
    return describe({c.pattern, c.contrast, c.kernel});
}

std::string percent(double share, int decimals = 0) {
    return fixed(100 * share, decimals) + " %";
}

std::string p_or_dash(const std::optional<double>& p) {
    return p ? p_text(*p) : "–";
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) text += (i > 0 ? ", " : "") + names[i];
    if (names.size() > kMostNamed) text += " and " + std::to_string(names.size() - kMostNamed) + " more";
    return text;
}

const SlopeEstimate* estimate_named(const ConditionLaw& law, std::string_view name) {
    const auto found = std::find_if(law.estimates.begin(), law.estimates.end(),
                                    [&](const SlopeEstimate& e) { return e.name == name; });
    return found == law.estimates.end() ? nullptr : &*found;
}

std::string estimate_cell(const ConditionLaw& law, std::string_view name) {
    const SlopeEstimate* estimate = estimate_named(law, name);
    return estimate != nullptr ? with_brackets(estimate->value, estimate->ci95, 2) : "–";
}

/// "sim03 (62 %)": what a robust fit left of weights.
std::string down_weighted_cell(const ConditionLaw& law) {
    std::vector<DownWeighted> sorted = law.down_weighted;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const DownWeighted& a, const DownWeighted& b) { return a.weight < b.weight; });
    std::vector<std::string> names;
    for (const DownWeighted& d : sorted) {
        names.push_back(d.observer + (d.texel_px ? " at " + format_number(*d.texel_px) + " px" : " as a whole") + " (" +
                        percent(d.weight) + ")");
    }
    return names.empty() ? "nobody" : joined(names);
}

/// δ with its interval; a bound has none.
std::string lapse_cell(const std::optional<PsychometricFit>& fit) {
    constexpr size_t kLapse = 2;
    if (!fit || !fit->estimated) return "–";
    const std::string value = fixed(fit->parameters.lapse, 3);
    if (const auto interval = lapse_interval(*fit)) return with_brackets(fit->parameters.lapse, *interval, 3);
    return value + (fit->at_bound[kLapse] ? " (at its bound)" : "");
}

}  // namespace

std::string law_html(const Law& law) {
    Rows rows;
    for (const ConditionLaw& c : law.conditions) {
        rows.push_back({described(c), fixed(c.slope, 2), to(c.slope_ci95, 2), fixed(c.tau_ln, 2),
                        c.has_form ? with_brackets(c.intercept_px, c.intercept_ci95, 1) : "–",
                        c.has_form ? with_brackets(c.exponent, c.exponent_ci95, 2) : "–", std::to_string(c.observers),
                        std::to_string(c.trials)});
    }
    return html_table(
        {"condition", "c", "95 % interval", "τ of ln c", "intercept, px", "exponent", "observers", "trials"}, rows);
}

std::string comparisons_html(const Law& law) {
    Rows rows;
    for (const Comparison& c : law.comparisons) {
        rows.push_back({describe(c.first) + " / " + describe(c.second), fixed(c.ratio, 2), to(c.ratio_ci95, 2),
                        p_text(c.p), p_text(c.p_holm), std::to_string(c.observers)});
    }
    return html_table(
        {"slopes compared, observer by observer", "ratio", "95 % interval", "p (paired t)", "p (Holm)", "observers"},
        rows);
}

std::string budget_html(const Law& law) {
    constexpr double kExtents[] = {10, 30, 100};
    constexpr double kRadii[] = {0.1, 0.5};
    std::vector<std::string> head{"hidden means", "c", "95 % interval"};
    for (const double extent : kExtents) {
        for (const double radius : kRadii)
            head.push_back("L " + format_number(extent) + ", r " + format_number(radius));
    }
    Rows rows;
    for (const CriterionLaw& c : law.criteria) {
        std::vector<std::string> row{format_number(std::round(1000 * c.threshold_probability) / 10) + " % right",
                                     fixed(c.slope, 2), to(c.slope_ci95, 2)};
        for (const double extent : kExtents) {
            for (const double radius : kRadii) {
                const MapSize size = shadow_map_size({.slope = c.slope, .radius = radius, .extent = extent});
                row.push_back((size.limit == SizeLimit::largest_size ? "over " : "") + std::to_string(size.texels));
            }
        }
        rows.push_back(row);
    }
    return html_table(head, rows);
}

std::string estimates_html(const Law& law, const Law& robust) {
    Rows rows;
    std::string less;
    for (const ConditionLaw& c : law.conditions) {
        const auto other = std::find_if(robust.conditions.begin(), robust.conditions.end(), [&](const ConditionLaw& r) {
            return r.pattern == c.pattern && r.contrast == c.contrast && r.kernel == c.kernel;
        });
        const bool has_robust = other != robust.conditions.end();
        rows.push_back({described(c), with_brackets(c.slope, c.slope_ci95, 2), estimate_cell(c, "mean-t"),
                        estimate_cell(c, "linear-t"), estimate_cell(c, "profile"), estimate_cell(c, "posterior"),
                        has_robust ? with_brackets(other->slope, other->slope_ci95, 2) : "–"});
        if (has_robust) less += "<li>" + escaped(described(c) + ": " + down_weighted_cell(*other)) + "</li>\n";
    }
    return html_table({"condition", "c as above", "plain mean", "linear, in px", "profile", "posterior", "robust"},
                      rows) +
           (less.empty()
                ? ""
                : "<p>What the robust fit trusts less, and the share of its weight that it keeps:</p>\n<ul>\n" + less +
                      "</ul>\n");
}

std::string observers_html(const StudyCheck& check) {
    Rows rows;
    for (const ObserverCheck& o : check.observers) {
        const Sensitivity& s = o.sensitivity;
        const bool has_d = s.reason.empty();
        rows.push_back({o.observer, std::to_string(o.trials), percent(static_cast<double>(o.right) / o.trials, 1),
                        has_d ? with_brackets(s.d_prime, s.d_prime_ci95, 2) : s.reason,
                        has_d ? with_brackets(s.criterion, s.criterion_ci95, 2) : "–", lapse_cell(o.aligned),
                        p_or_dash(o.least_deviance_p), p_or_dash(o.least_order_p),
                        std::to_string(o.influential_trials)});
    }
    return html_table({"observer", "trials", "right", "d′", "criterion", "lapses δ", "least p, deviance",
                       "least p, order", "influential trials"},
                      rows);
}

std::string conditions_html(const StudyCheck& check) {
    Rows rows;
    for (const ConditionCheck& c : check.conditions) {
        rows.push_back({describe(c.condition),
                        c.aligned && c.aligned->estimated ? fixed(c.aligned->parameters.slope, 2) : "–",
                        lapse_cell(c.aligned), p_or_dash(c.deviance_p), p_or_dash(c.prediction_p), p_or_dash(c.order_p),
                        c.scatter_df > 0 ? fixed(std::sqrt(c.scatter_chi2 / c.scatter_df), 2) : "–",
                        p_or_dash(c.scatter_p), c.overdispersion ? fixed(*c.overdispersion, 2) : "–"});
    }
    return html_table({"condition", "steepness b", "lapses δ", "p, deviance", "p, prediction", "p, order",
                       "Birge ratio", "p, scatter", "η"},
                      rows);
}

std::string influence_sentence(const std::vector<Influence>& influences) {
    std::vector<std::string> names;
    for (const Influence& i : influences) {
        if (!i.is_flagged) continue;
        names.push_back(i.left_out + " (" + describe(i.condition) + ": " + (i.change >= 0 ? "+" : "−") +
                        percent(std::abs(i.change), 1) + ")");
    }
    if (names.empty()) return "No observer and no size moves c by more than that.";
    return "Drawn full: " + joined(names) + ".";
}

std::string residual_sentence(const std::vector<ResidualGroup>& groups) {
    std::vector<std::string> names;
    for (const ResidualGroup& g : groups) {
        if (std::abs(g.residual) <= kLargeResidual) continue;
        names.push_back(g.observer + " (" + describe(g.condition) + ", by " +
                        (g.order == ResidualOrder::prediction ? "prediction at " + fixed(g.position, 2)
                                                              : "trial at " + fixed(g.position, 0)) +
                        ": " + fixed(g.residual, 1) + ")");
    }
    const std::string count =
        "Of " + std::to_string(groups.size()) + " groups, beyond ± " + format_number(kLargeResidual) + ": ";
    return count + (names.empty() ? "none" : joined(names)) + ".";
}

}  // namespace stairstep
