#include "analysis/report_methods.h"

#include <ceres/version.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "stimuli/io/gnuplot.h"
#include "stimuli/number.h"
#include "study/design_json.h"

namespace stairstep {
namespace {

/// "5, 10 and 20"
std::string listed(const std::vector<std::string>& parts) {
    std::string text;
    for (size_t i = 0; i < parts.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    }
    return text;
}

/// Of things that have commas in them.
std::string with_semicolons(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
    return text;
}

template <typename Set, typename Text>
std::string listed_set(const Set& set, const Text& text) {
    std::vector<std::string> parts;
    for (const auto& value : set) parts.push_back(text(value));
    return listed(parts);
}

std::string count_of(size_t n, const std::string& thing) {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

/// "quest (beta 3.5, delta 0.01, …)" from an engine's JSON; nested settings in brackets.
std::string settings_text(const nlohmann::ordered_json& object) {
    std::string text;
    for (const auto& [key, value] : object.items()) {
        if (key == "name" || value.is_null()) continue;
        std::string name = key;
        std::replace(name.begin(), name.end(), '_', ' ');
        text += (text.empty() ? "" : ", ") + name + " " +
                (value.is_object()   ? "(" + settings_text(value) + ")"
                 : value.is_string() ? value.get<std::string>()
                                     : value.dump());
    }
    return text;
}

std::string design_paragraph(const StudyBackground& background, const std::vector<Trial>& trials,
                             const std::vector<Track>& tracks) {
    std::set<std::string> patterns, kernels;
    std::set<double, std::greater<>> contrasts;
    std::set<double> texels;
    size_t lines = 0, fewest = trials.size(), most = 0;
    bool yes_no = false, forced = false;
    for (const Track& track : tracks) {
        patterns.emplace(name(track.condition.pattern));
        kernels.emplace(name(track.condition.kernel));
        contrasts.insert(track.condition.contrast);
        texels.insert(track.condition.texel_px);
        fewest = std::min(fewest, track.trials.size());
        most = std::max(most, track.trials.size());
    }
    for (const Trial& trial : trials) {
        lines += trial.stimulus == Judgement::line;
        (trial.task == Task::yes_no ? yes_no : forced) = true;
    }
    const auto itself = [](const std::string& text) { return text; };
    std::string text = "Design. Edges of filtered shadows with artifacts of the " +
                       std::string(patterns.size() == 1 ? "pattern " : "patterns ") + listed_set(patterns, itself) +
                       " were shown at " + (contrasts.size() == 1 ? "a contrast of " : "contrasts of ") +
                       listed_set(contrasts, [](double c) { return format_number(100 * c) + " %"; }) +
                       " with shadow-map texels of " + listed_set(texels, [](double a) { return format_number(a); }) +
                       " px on screen under a filter of shape " + listed_set(kernels, itself) +
                       ", the radius of which was varied.";
    if (yes_no) {
        text += " The task was yes-no, “is it an artifact or a line?”; " +
                format_fixed(100.0 * static_cast<double>(lines) / static_cast<double>(trials.size()), 1) +
                " % of the trials showed the line that the artifact stands for.";
    }
    if (forced) text += " The task was a choice between two alternatives side by side, “which is the artifact?”.";
    text +=
        " Stimulus strength is x = log10(texel size/filter radius). A track is the trials of one observer at one "
        "pattern, contrast, filter shape and texel size; the tracks had " +
        (fewest == most ? std::to_string(most) : std::to_string(fewest) + " to " + std::to_string(most)) +
        " trials each.";
    if (!background.design) return text;
    const Design& design = *background.design;
    const nlohmann::ordered_json json = to_json(design);
    text += " Pictures had " + std::to_string(design.width_px) + " × " + std::to_string(design.height_px) + " px";
    if (design.viewing) {
        text += ", seen from " + format_number(design.viewing->distance_mm) + " mm at " +
                format_fixed(design.viewing->pixels_per_degree(), 1) + " px a degree";
    }
    text +=
        ". Texel sizes of one pattern and contrast ran interleaved in a round; the order of rounds followed a "
        "balanced Latin square over observers. Trials were placed by the engine “" +
        json.at("engine").value("name", std::string("quest")) + "” (" + settings_text(json.at("engine")) +
        "); a track ended " +
        (design.stop.converged_sd
             ? "once its posterior standard deviation was below " + format_number(*design.stop.converged_sd) +
                   ", after " + std::to_string(design.stop.least_trials) + " to " +
                   std::to_string(design.stop.most_trials) + " trials."
             : "after " + std::to_string(design.stop.most_trials) + " trials.");
    return text;
}

std::string exclusions_paragraph(const StudyBackground& background, const std::vector<Trial>& trials,
                                 const std::vector<Track>& tracks, const LawFit& fit) {
    std::vector<std::string> unbounded;
    for (const Threshold& t : fit.thresholds) {
        if (t.bounded) continue;
        unbounded.push_back(t.observer + ", " + std::string(name(t.condition.pattern)) + " " +
                            format_number(100 * t.condition.contrast) + " %, " + format_number(t.condition.texel_px) +
                            " px");
    }
    std::string text = "Exclusions. The analysis has " + count_of(trials.size(), "trial") + " of " +
                       count_of(tracks.size(), "track") + ".";
    if (background.practice_trials + background.catch_trials + background.void_trials > 0) {
        text += " No evidence were " + count_of(static_cast<size_t>(background.practice_trials), "practice trial") +
                ", " + count_of(static_cast<size_t>(background.catch_trials), "catch trial") + " and " +
                count_of(static_cast<size_t>(background.void_trials), "trial") + " that observers took back.";
    }
    if (unbounded.empty()) return text + " No track was left out.";
    return text + " Left out of the law because their trials don't bound the threshold: " +
           count_of(unbounded.size(), "track") + " (" + with_semicolons(unbounded) + ").";
}

std::string analysis_paragraph(const LawFit& fit) {
    const Law& law = fit.law;
    std::string text =
        "Analysis. Each track's threshold, the strength at which " +
        format_number(std::round(1000 * law.threshold_probability) / 10) +
        " % of the answers are right, is the mean of its posterior under a Weibull function with a guess rate of one "
        "half (Watson and Pelli 1983), summed over steepness and lapse rate. The law r = c·a was fitted to each "
        "observer's thresholds of a condition in logarithms, weighted by their standard deviations. The slope of a "
        "condition over observers: " +
        (law.conditions.empty() ? "" : law.conditions.front().slope_method) + ".";
    if (!law.slope_method.empty()) text += " The law is the worst case: " + law.slope_method + ".";
    if (!law.comparisons.empty()) {
        text += " Conditions were compared observer by observer (" + count_of(law.comparisons.size(), "comparison") +
                "): " + law.comparisons.front().method + ".";
    }
    text += " All intervals are of 95 %.";
    return text;
}

std::string checks_paragraph(const StudyCheck& check) {
    std::string text =
        "Checks. A Weibull function with free threshold, steepness and lapse rate (0 to 0.12) was fitted to all trials "
        "of each observer in each condition by maximum likelihood. ";
    if (check.simulations > 0) {
        text +=
            "Its deviance, and the correlations of its deviance residuals with prediction and with the trials' "
            "order, were compared with " +
            std::to_string(check.simulations) + " simulations each (Wichmann and Hill 2001; seed " +
            std::to_string(check.seed) +
            "), at the strengths that were shown, and p values combined over observers by Fisher's method. ";
    }
    return text + "d′ and criterion pool an observer's conditions: intervals " + std::string(kSensitivityIntervals) +
           ". Intervals of shares are Wilson's. Influence is c with each observer and each size left out.";
}

std::string software_paragraph(const StudyBackground& background) {
    std::string text =
        "Software. Stairstep " STAIRSTEP_VERSION ", Ceres Solver " CERES_VERSION_STRING ", " + gnuplot_version() + ".";
    if (background.seeds.empty()) return text;
    std::vector<std::string> seeds;
    for (const uint64_t seed : background.seeds) seeds.push_back(std::to_string(seed));
    return text + " Seeds of the sessions: " + listed(seeds) + ".";
}

}  // namespace

std::vector<std::string> methods_paragraphs(const StudyBackground& background, const std::vector<Trial>& trials,
                                            const LawFit& fit, const StudyCheck& check) {
    const std::vector<Track> tracks = tracks_of(trials);
    std::set<std::string> observers;
    for (const Track& track : tracks) observers.insert(track.observer);
    const std::string kind = background.observer_kind == "person" ? "" : background.observer_kind;
    std::string who = "Observers. " + std::to_string(observers.size()) + " " + kind + (kind.empty() ? "" : " ") +
                      "observers took part";
    who += fit.law.observers == static_cast<int>(observers.size())
               ? "; all are in the law."
               : "; " + std::to_string(fit.law.observers) + " of them have thresholds in the law.";
    return {design_paragraph(background, trials, tracks),
            who,
            exclusions_paragraph(background, trials, tracks, fit),
            analysis_paragraph(fit),
            checks_paragraph(check),
            software_paragraph(background)};
}

}  // namespace stairstep
