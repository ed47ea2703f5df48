#include "analysis/law_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "analysis/plot.h"
#include "analysis/statistics.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

std::vector<Threshold> thresholds_of(const LawFit& fit, const ConditionLaw& law) {
    std::vector<Threshold> chosen;
    std::copy_if(fit.thresholds.begin(), fit.thresholds.end(), std::back_inserter(chosen), [&](const Threshold& t) {
        return t.bounded && t.condition.pattern == law.pattern && t.condition.contrast == law.contrast &&
               t.condition.kernel == law.kernel;
    });
    return chosen;
}

/// Line and band of the law between two texel sizes, many points apart in logarithms so that a band stays one on log axes.
void add_law(Plot& plot, const ConditionLaw& law, double first_texel, double last_texel, const std::string& title) {
    const std::string id = std::string(name(law.pattern)) + "_law";
    const std::string rgb = std::string(" lc rgb '") + colour(law.pattern) + "' ";
    auto& line = plot.block(id);
    for (const double a : {first_texel, last_texel}) {
        line << a << ' ' << law.slope * a << ' ' << law.slope_ci95.first * a << ' ' << law.slope_ci95.second * a
             << '\n';
    }
    plot.draw(id, "u 1:3:4 w filledcurves fs transparent solid 0.15 noborder" + rgb + "notitle");
    plot.draw(id, "u 1:2 w l lw 2" + rgb + (title.empty() ? "notitle" : "title " + quoted(title)));
}

std::map<double, std::vector<double>> ln_radii_of(const std::vector<Threshold>& thresholds) {
    std::map<double, std::vector<double>> ln_radii;
    for (const Threshold& t : thresholds) ln_radii[t.condition.texel_px].push_back(std::log(t.radius_px()));
    return ln_radii;
}

/// Geometric means over observers with 95 % intervals, `shift` px beside their size on even axes, `factor` on logarithmic ones.
void add_means(Plot& plot, const ConditionLaw& law, const std::vector<Threshold>& thresholds, double shift,
               double factor) {
    const std::string id = std::string(name(law.pattern)) + "_means";
    auto& means = plot.block(id);
    for (const auto& [texel_px, values] : ln_radii_of(thresholds)) {
        if (values.size() < 2) continue;
        const MeanEstimate mean = mean_with_interval(values);
        means << texel_px * factor + shift << ' ' << std::exp(mean.mean) << ' ' << std::exp(mean.ci95.first) << ' '
              << std::exp(mean.ci95.second) << '\n';
    }
    plot.draw(id,
              std::string("u 1:2:3:4 w yerrorbars pt 7 ps 0.8 lw 1.5 lc rgb '") + colour(law.pattern) + "' notitle");
}

/// Tics at the sizes tested: on logarithmic axes gnuplot's own are few.
std::string tics_at(const std::set<double>& texels) {
    std::string tics;
    for (const double a : texels) tics += (tics.empty() ? "" : ",") + format_number(a);
    return "set xtics (" + tics + ")\n";
}

std::string range(const std::string& axis, double low, double high) {
    return "set " + axis + "range [" + format_number(low) + ":" + format_number(high) + "]\n";
}

}  // namespace

std::string law_figure(const LawFit& fit, const std::vector<ReferencePoint>& references) {
    const auto [smallest_texel, largest_texel] = fit.law.texel_range_px;
    double smallest_radius = INFINITY, largest_radius = 0, largest_reference = 0;
    std::set<double> texels;
    for (const Threshold& t : fit.thresholds) {
        texels.insert(t.condition.texel_px);
        if (!t.bounded) continue;
        smallest_radius = std::min(smallest_radius, t.radius_px());
        largest_radius = std::max(largest_radius, t.radius_px());
    }
    for (const ReferencePoint& r : references) {
        largest_reference = std::max(largest_reference, r.radius_px.value_or(0));
    }
    std::set<double, std::greater<>> contrasts;
    std::vector<ConditionLaw> laws;
    for (const ConditionLaw& law : fit.law.conditions) {
        if (law.kernel != fit.law.kernel) continue;
        contrasts.insert(law.contrast);
        laws.push_back(law);
    }
    // Room for intervals, unless they dwarf what was measured.
    double highest = largest_radius;
    for (const ConditionLaw& law : laws) {
        for (const auto& [texel_px, values] : ln_radii_of(thresholds_of(fit, law))) {
            if (values.size() > 1) highest = std::max(highest, std::exp(mean_with_interval(values).ci95.second));
        }
    }
    highest = std::min(highest, 1.6 * largest_radius);
    const auto title_of = [](double contrast) { return "contrast " + format_number(100 * contrast) + " %"; };

    Panels panels({.columns = panel_columns(contrasts.size() == 1 ? 2 : contrasts.size()),
                   .panel_height = 408,
                   .left = 66,
                   .bottom = 58});
    for (const double contrast : contrasts) {
        Plot plot;
        double shift = -largest_texel * 0.008;
        for (const ConditionLaw& law : laws) {
            if (law.contrast != contrast) continue;
            const std::vector<Threshold> thresholds = thresholds_of(fit, law);
            add_law(plot, law, 0, largest_texel * 1.08,
                    std::string(name(law.pattern)) + ": r = " + format_fixed(law.slope, 2) + " a");
            const std::string id = std::string(name(law.pattern)) + "_observers";
            auto& points = plot.block(id);
            for (const Threshold& t : thresholds) {
                points << t.condition.texel_px + shift * 1.9 << ' ' << t.radius_px() << '\n';
            }
            plot.draw(id, std::string("u 1:2 w p pt 7 ps 0.3 lc rgb '") + colour(law.pattern) + "' notitle");
            add_means(plot, law, thresholds, shift, 1);
            shift = -shift;
        }
        panels.add("set title " + quoted(title_of(contrast)) +
                       "\nset key top left reverse Left samplen 1.6 spacing 1.1\n"
                       "set xlabel 'texel size a on screen, px'\nset ylabel 'filter radius r that hides it, px'\n" +
                       range("x", 0, largest_texel * 1.08) + range("y", 0, highest * 1.05),
                   plot);
    }
    if (contrasts.size() > 1) panels.end_row();
    for (const double contrast : contrasts) {
        Plot plot;
        double factor = 0.985;
        for (const ConditionLaw& law : laws) {
            if (law.contrast != contrast) continue;
            const std::string pattern(name(law.pattern));
            add_law(plot, law, smallest_texel / 1.15, largest_texel * 1.15, pattern + ": observers");
            add_means(plot, law, thresholds_of(fit, law), 0, factor);
            factor = 1 / factor;
            auto& block = plot.block(pattern + "_reference");
            for (const ReferencePoint& r : references) {
                if (r.condition.pattern != law.pattern || r.condition.contrast != contrast ||
                    r.condition.kernel != law.kernel || !r.radius_px) {
                    continue;
                }
                block << r.texel_px << ' ' << *r.radius_px << '\n';
            }
            plot.draw(pattern + "_reference", std::string("u 1:2 w lp dt 2 lw 1.5 pt 6 ps 0.9 lc rgb '") +
                                                  colour(law.pattern) + "' title '" + pattern + ": reference'");
        }
        panels.add("set title " + quoted(title_of(contrast) + ", with the reference size") +
                       "\nset key bottom right samplen 2.4 spacing 1.1\nset logscale xy\nset grid xtics ytics\n"
                       "set xlabel 'texel size a on screen, px'\nset ylabel 'filter radius r, px'\n" +
                       "set ytics (1,2,5,10,20,50,100,200,500,1000)\n" + tics_at(texels) +
                       range("x", smallest_texel / 1.15, largest_texel * 1.15) +
                       range("y", smallest_radius / 2.5, std::max(highest, largest_reference) * 1.2),
                   plot);
    }
    return panels.svg();
}

}  // namespace stairstep
