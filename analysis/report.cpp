#include "analysis/report.h"

#include <algorithm>
#include <cmath>

#include "analysis/convergence_figure.h"
#include "analysis/influence_figure.h"
#include "analysis/law_figure.h"
#include "analysis/psychometric_figure.h"
#include "analysis/report_page.h"
#include "analysis/report_renderings.h"
#include "analysis/report_tables.h"
#include "analysis/residual_figure.h"
#include "analysis/result_csv.h"
#include "embedded/report.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

std::string warnings_list(const std::vector<std::string>& warnings) {
    if (warnings.empty()) return "";
    std::string items;
    for (const std::string& warning : warnings) items += "<li>" + escaped(warning) + "</li>\n";
    return "<p>To know about this fit:</p>\n<ul>\n" + items + "</ul>\n";
}

/// "convergence-03.svg".
std::string convergence_name(size_t index, size_t count) {
    const std::string digits = std::to_string(index + 1);
    const size_t width = std::max<size_t>(2, std::to_string(count).size());
    return "convergence-" + std::string(width - std::min(width, digits.size()), '0') + digits + ".svg";
}

/// Each observer's tracks behind a line to open; the first is open. Adds the figures to `files`.
std::string convergence_section(const std::vector<Trial>& trials, const LawFit& fit, Report& report) {
    std::vector<std::pair<std::string, std::vector<Track>>> observers;
    for (Track& track : tracks_of(trials)) {
        const auto known =
            std::find_if(observers.begin(), observers.end(), [&](const auto& o) { return o.first == track.observer; });
        auto& tracks = known == observers.end() ? observers.emplace_back(track.observer, std::vector<Track>()).second
                                                : known->second;
        tracks.push_back(std::move(track));
    }
    std::string html;
    for (size_t i = 0; i < observers.size(); ++i) {
        const auto& [observer, tracks] = observers[i];
        const std::string svg = convergence_figure(tracks, fit.thresholds);
        report.files.emplace_back(convergence_name(i, observers.size()), svg);
        html += std::string("<details") + (i == 0 ? " open" : "") + "><summary>Observer " + escaped(observer) + ", " +
                std::to_string(tracks.size()) + (tracks.size() == 1 ? " track" : " tracks") + "</summary>\n<figure>" +
                inline_svg(svg) + "</figure></details>\n";
    }
    report.files.emplace_back("convergence.csv", convergence_csv(tracks_of(trials), fit.thresholds));
    return html;
}

/// A sentence about reference sizes that the figure can't show.
std::string missing_references(const std::vector<ReferencePoint>& references) {
    const auto missing =
        std::count_if(references.begin(), references.end(), [](const ReferencePoint& r) { return !r.radius_px; });
    if (missing == 0) return "";
    return " Not reached up to " + format_number(kLargestReferenceRadius) +
           " px, and not shown: " + std::to_string(missing) + " of " + std::to_string(references.size()) + ".";
}

std::string methods_html(const std::vector<std::string>& paragraphs) {
    std::string html;
    for (const std::string& p : paragraphs) html += "<p>" + escaped(p) + "</p>\n";
    return html;
}

}  // namespace

Report make_report(const std::vector<Trial>& trials, const LawFit& fit, const ReportInputs& inputs) {
    const Law& law = fit.law;
    // First what may be refused.
    const std::string contact_sheet = inputs.contact_sheet.empty() ? "" : contact_sheet_section(inputs.contact_sheet);
    const std::string renderings = inputs.render_stats.empty() ? "" : renderings_section(inputs.render_stats);
    PictureSize picture = inputs.picture;
    if (const auto& design = inputs.background.design) picture = {design->width_px, design->height_px};
    const std::vector<ReferencePoint> references = reference_points(fit, picture, inputs.check.jobs);
    const StudyCheck check = check_study(trials, fit, inputs.check);
    const std::vector<ResidualGroup> groups = residual_groups(check);
    const std::vector<Influence> influence = influences(law);
    LawFitOptions robust_options;
    robust_options.robust = true;
    const Law robust = fit_law_to_thresholds(fit.thresholds, law.threshold_probability, "report", robust_options).law;
    const std::vector<std::string> methods = methods_paragraphs(inputs.background, trials, fit, check);

    Report report;
    const auto figure = [&](const std::string& name, const std::string& svg) {
        report.files.emplace_back(name, svg);
        return inline_svg(svg);
    };
    const std::string kind = inputs.background.observer_kind;
    Page page(embedded::report_template_html);
    page.text("study", trials.front().study.empty() ? "A study" : trials.front().study)
        .text("observers", std::to_string(law.observers) + " " + kind + (kind.empty() ? "" : " ") + "observers")
        .text("trials", std::to_string(law.trials))
        .text("slope", format_fixed(law.slope, 2))
        .text("slope_low", format_fixed(law.slope_ci95.first, 2))
        .text("slope_high", format_fixed(law.slope_ci95.second, 2))
        .text("worst_case", describe({law.pattern, law.contrast, law.kernel}))
        .text("kernel", std::string(name(law.kernel)))
        .text("percent", format_number(std::round(1000 * law.threshold_probability) / 10))
        .text("source", law.source)
        .set("law_table", law_html(law))
        .text("slope_method", law.conditions.empty() ? "" : law.conditions.front().slope_method)
        .set("comparisons", comparisons_html(law))
        .set("budget", budget_html(law))
        .set("warnings", warnings_list(fit.warnings))
        .set("law_figure", figure("law.svg", law_figure(fit, references)))
        .text("picture", std::to_string(picture.width_px) + " × " + std::to_string(picture.height_px))
        .text("missing_references", missing_references(references))
        .set("psychometric_figure", figure("psychometric.svg", pooled_psychometric_figure(check)))
        .set("observer_curves", figure("psychometric-observers.svg", observer_psychometric_figure(check)))
        .set("convergence", convergence_section(trials, fit, report))
        .set("residual_figure", figure("residuals.svg", residual_figure(check, groups)))
        .text("residual_sentence", residual_sentence(groups))
        .set("influence_figure", figure("influence.svg", influence_figure(law, influence)))
        .text("influence_sentence", influence_sentence(influence))
        .set("observers_table", observers_html(check))
        .set("conditions_table", conditions_html(check))
        .text("simulations", std::to_string(check.simulations))
        .set("estimates", estimates_html(law, robust))
        .set("methods", methods_html(methods))
        .set("contact_sheet", contact_sheet)
        .set("renderings", renderings);
    report.html = page.html();

    std::string methods_text;
    for (const std::string& p : methods) methods_text += p + "\n\n";
    const std::vector<std::pair<std::string, std::string>> tables{
        {"law.csv", law_csv(law)},
        {"thresholds.csv", thresholds_csv(fit)},
        {"reference.csv", reference_points_csv(references)},
        {"psychometric.csv", psychometric_csv(check)},
        {"psychometric-fits.csv", psychometric_fits_csv(check)},
        {"residuals.csv", residuals_csv(groups)},
        {"influence.csv", influence_csv(influence)},
        {"sensitivity.csv", sensitivity_csv(trials)},
        {"checks.csv", checks_csv(check)},
        {"comparisons.csv", comparisons_csv(law)},
        {"criteria.csv", criteria_csv(law)},
        {"estimates.csv", estimates_csv(law, robust)},
        {"methods.txt", methods_text}};
    report.files.insert(report.files.end(), tables.begin(), tables.end());
    return report;
}

}  // namespace stairstep
