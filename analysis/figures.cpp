#include "analysis/figures.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <sstream>

#include "analysis/statistics.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Two colours that differ for every kind of colour vision (Okabe & Ito 2008).
const char* colour(Pattern pattern) {
    return pattern == Pattern::step ? "#0072b2" : "#d55e00";
}

constexpr const char* kKey = "set key top left reverse Left samplen 1.6 spacing 1.1\n";

/// Collects data blocks ($name << EOD) and the plot's parts that draw them.
class Plot {
  public:
    /// Opens a data block and returns it for rows; it stays valid while others are opened.
    std::ostringstream& block(const std::string& name) {
        blocks_.emplace_back(name, std::ostringstream());
        return blocks_.back().second;
    }
    void draw(const std::string& part) { parts_.push_back(part); }

    std::string script() const {
        std::string text;
        for (const auto& [name, rows] : blocks_) text += "$" + name + " << EOD\n" + rows.str() + "EOD\n";
        text += "plot ";
        for (size_t i = 0; i < parts_.size(); ++i) text += (i > 0 ? ", \\\n  " : "") + parts_[i];
        return text + "\n";
    }

  private:
    std::deque<std::pair<std::string, std::ostringstream>> blocks_;  // references into it stay valid
    std::vector<std::string> parts_;
};

/// Adds one condition to a panel: band and line of the law, means with intervals, observers' points.
void plot_condition(Plot& plot, const ConditionLaw& law, const std::vector<Threshold>& thresholds, double largest_texel,
                    double nudge) {
    const std::string id = std::string(name(law.pattern));
    const std::string rgb = std::string(" lc rgb '") + colour(law.pattern) + "' ";
    auto& line = plot.block(id + "_law");
    for (const double a : {0.0, largest_texel * 1.08}) {
        line << a << ' ' << law.slope * a << ' ' << law.slope_ci95.first * a << ' ' << law.slope_ci95.second * a
             << '\n';
    }
    std::map<double, std::vector<double>> ln_radii;
    auto& points = plot.block(id + "_observers");
    for (const Threshold& t : thresholds) {
        points << t.condition.texel_px + nudge * 1.9 << ' ' << t.radius_px() << '\n';
        ln_radii[t.condition.texel_px].push_back(std::log(t.radius_px()));
    }
    auto& means = plot.block(id + "_means");
    for (const auto& [texel_px, values] : ln_radii) {
        if (values.size() < 2) continue;
        const MeanEstimate mean = mean_with_interval(values);
        means << texel_px + nudge << ' ' << std::exp(mean.mean) << ' ' << std::exp(mean.ci95.first) << ' '
              << std::exp(mean.ci95.second) << '\n';
    }
    plot.draw("$" + id + "_law u 1:3:4 w filledcurves fs transparent solid 0.15 noborder" + rgb + "notitle");
    plot.draw("$" + id + "_observers u 1:2 w p pt 7 ps 0.3" + rgb + "notitle");
    plot.draw("$" + id + "_law u 1:2 w l lw 2" + rgb + "title '" + id + ": r = " + format_fixed(law.slope, 2) + " a'");
    plot.draw("$" + id + "_means u 1:2:3:4 w yerrorbars pt 7 ps 0.8 lw 1.5" + rgb + "notitle");
}

std::vector<Threshold> thresholds_of(const LawFit& fit, const ConditionLaw& law) {
    std::vector<Threshold> chosen;
    std::copy_if(fit.thresholds.begin(), fit.thresholds.end(), std::back_inserter(chosen), [&](const Threshold& t) {
        return t.bounded && t.condition.pattern == law.pattern && t.condition.contrast == law.contrast &&
               t.condition.kernel == law.kernel;
    });
    return chosen;
}

}  // namespace

std::string law_figure(const LawFit& fit) {
    const double largest_texel = fit.law.texel_range_px.second;
    double largest_radius = 0;
    std::set<double, std::greater<>> contrasts;
    for (const Threshold& t : fit.thresholds) {
        if (t.bounded) largest_radius = std::max(largest_radius, t.radius_px());
    }
    for (const ConditionLaw& law : fit.law.conditions) contrasts.insert(law.contrast);

    std::ostringstream script;
    script << kKey << "set multiplot layout 1," << contrasts.size() << "\nset xlabel 'texel size a on screen, px'\n"
           << "set xrange [0:" << largest_texel * 1.08 << "]\nset yrange [0:" << largest_radius * 1.05 << "]\n";
    for (const double contrast : contrasts) {
        script << "set title 'contrast " << format_number(100 * contrast) << " %'\n"
               << "set ylabel '" << (contrast == *contrasts.begin() ? "filter radius r that hides it, px" : " ")
               << "'\n";
        Plot plot;
        double nudge = -largest_texel * 0.008;
        for (const ConditionLaw& law : fit.law.conditions) {
            if (law.contrast != contrast || law.kernel != fit.law.kernel) continue;
            plot_condition(plot, law, thresholds_of(fit, law), largest_texel, nudge);
            nudge = -nudge;
        }
        script << plot.script();
    }
    script << "unset multiplot\n";
    return draw_svg(script.str(), 960, 430);
}

std::string convergence_figure(const std::vector<Trial>& trials, const LawFit& fit) {
    std::vector<Track> tracks = tracks_of(trials);
    const Track first = tracks.front();
    std::erase_if(tracks, [&](const Track& t) {
        return t.observer != first.observer || t.condition.pattern != first.condition.pattern ||
               t.condition.contrast != first.condition.contrast || t.condition.kernel != first.condition.kernel;
    });
    std::sort(tracks.begin(), tracks.end(),
              [](const Track& a, const Track& b) { return a.condition.texel_px < b.condition.texel_px; });

    std::ostringstream script;
    script << kKey << "set multiplot layout 1," << tracks.size() << "\nunset key\nset xlabel 'trial'\nset xtics 20\n";
    for (const Track& track : tracks) {
        const auto threshold = std::find_if(fit.thresholds.begin(), fit.thresholds.end(), [&](const Threshold& t) {
            return t.observer == track.observer && t.condition == track.condition;
        });
        const double radius = threshold->radius_px();
        const double spread = std::exp(1.96 * threshold->ln_radius_sd());
        double largest = radius * spread;
        for (const Trial& trial : track.trials) largest = std::max(largest, trial.radius_px);

        script << "set title 'a = " << format_number(track.condition.texel_px)
               << " px'\nset xrange [0:" << track.trials.size() + 1 << "]\nset yrange [0:" << largest * 1.08
               << "]\nset ylabel '" << (&track == &tracks.front() ? "filter radius shown, px" : " ") << "'\n";
        Plot plot;
        auto& band = plot.block("band");
        for (const size_t x : {size_t{0}, track.trials.size() + 1}) {
            band << x << ' ' << radius << ' ' << radius / spread << ' ' << radius * spread << '\n';
        }
        auto& path = plot.block("path");
        auto& right = plot.block("right");
        auto& wrong = plot.block("wrong");
        wrong << "NaN NaN\n";  // a block may not be empty
        right << "NaN NaN\n";
        for (size_t i = 0; i < track.trials.size(); ++i) {
            const Trial& trial = track.trials[i];
            path << i + 1 << ' ' << trial.radius_px << '\n';
            (trial.correct() ? right : wrong) << i + 1 << ' ' << trial.radius_px << '\n';
        }
        plot.draw("$band u 1:3:4 w filledcurves fs transparent solid 0.15 noborder lc rgb '#0072b2'");
        plot.draw("$band u 1:2 w l lw 1.5 lc rgb '#0072b2'");
        plot.draw("$path u 1:2 w l lw 1 lc rgb '#a0a0a0'");
        plot.draw("$right u 1:2 w p pt 7 ps 0.45 lc rgb '#333333'");
        plot.draw("$wrong u 1:2 w p pt 2 ps 0.8 lw 1.6 lc rgb '#d55e00'");
        script << plot.script();
    }
    script << "unset multiplot\n";
    return draw_svg(script.str(), 960, 300);
}

}  // namespace stairstep
