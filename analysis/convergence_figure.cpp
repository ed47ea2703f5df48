#include "analysis/convergence_figure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "analysis/plot.h"
#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// More points than pixels only make the page heavy.
constexpr size_t kMostPoints = 200;

const Threshold& threshold_of(const Track& track, const std::vector<Threshold>& thresholds) {
    const auto found = std::find_if(thresholds.begin(), thresholds.end(), [&](const Threshold& t) {
        return t.observer == track.observer && t.condition == track.condition;
    });
    assert(found != thresholds.end());
    return *found;
}

double radius_at(const Track& track, double log_threshold) {
    return track.condition.texel_px * std::pow(10.0, -log_threshold);
}

void add_track(Panels& panels, const Track& track, const Threshold& threshold) {
    const double radius = threshold.radius_px();
    const double low = radius_at(track, threshold.log_threshold_ci95.second);
    const double high = radius_at(track, threshold.log_threshold_ci95.first);
    double largest = threshold.bounded ? high : 0;
    for (const Trial& trial : track.trials) largest = std::max(largest, trial.radius_px);
    const size_t n = track.trials.size();
    const double top = largest * 1.08;

    Plot plot;
    auto& band = plot.block("band");
    for (const size_t x : {size_t{0}, n + 1}) {
        band << x << ' ' << std::min(radius, top) << ' ' << low << ' ' << std::min(high, top) << '\n';
    }
    auto& path = plot.block("path");
    auto& right = plot.block("right");
    auto& wrong = plot.block("wrong");
    const size_t step = n / kMostPoints + 1;
    for (size_t i = 0; i < n; i += step) {
        const Trial& trial = track.trials[i];
        const std::string point = std::to_string(i + 1) + " " + format_fixed(trial.radius_px, 3) + "\n";
        path << point;
        (trial.correct() ? right : wrong) << point;
    }
    plot.draw("band", "u 1:3:4 w filledcurves fs transparent solid 0.15 noborder lc rgb '#0072b2'");
    plot.draw("band", "u 1:2 w l lw 1.5 lc rgb '#0072b2'");
    plot.draw("path", "u 1:2 w l lw 1 lc rgb '#a0a0a0'");
    plot.draw("right", "u 1:2 w p pt 7 ps 0.35 lc rgb '#333333'");
    plot.draw("wrong", "u 1:2 w p pt 2 ps 0.75 lw 1.8 lc rgb '#d55e00'");
    const Condition& c = track.condition;
    panels.add("set title " +
                   quoted(std::string(name(c.pattern)) + " " + format_number(100 * c.contrast) +
                          " %, a = " + format_number(c.texel_px) + " px" + (threshold.bounded ? "" : ", not bounded")) +
                   "\nset xrange [0:" + std::to_string(n + 1) + "]\nset xtics " +
                   format_number(tic_step(static_cast<double>(n + 1), 5)) + "\nset ytics " +
                   format_number(tic_step(top, 5)) + "\nset yrange [0:" + format_number(top) + "]\n",
               plot);
}

}  // namespace

std::string convergence_figure(const std::vector<Track>& tracks, const std::vector<Threshold>& thresholds) {
    std::vector<Track> ordered = tracks;
    std::stable_sort(ordered.begin(), ordered.end(), [](const Track& a, const Track& b) {
        const auto key = [](const Condition& c) { return std::tuple(c.kernel, c.pattern, -c.contrast, c.texel_px); };
        return key(a.condition) < key(b.condition);
    });
    Panels panels({.columns = 4, .panel_height = 165, .left = 44, .right = 10, .top = 24, .bottom = 28, .font = 12});
    for (const Track& track : ordered) add_track(panels, track, threshold_of(track, thresholds));
    return panels.svg();
}

std::string convergence_csv(const std::vector<Track>& tracks, const std::vector<Threshold>& thresholds) {
    CsvWriter csv;
    csv.row({"observer", "pattern", "contrast", "kernel", "texel_px", "trial", "radius_px", "correct", "threshold_px",
             "threshold_low_px", "threshold_high_px"});
    for (const Track& track : tracks) {
        const Threshold& t = threshold_of(track, thresholds);
        int number = 0;
        for (const Trial& trial : track.trials) {
            csv.row({track.observer, std::string(name(track.condition.pattern)),
                     format_number(track.condition.contrast), std::string(name(track.condition.kernel)),
                     format_number(track.condition.texel_px), std::to_string(++number), format_number(trial.radius_px),
                     trial.correct() ? "1" : "0", format_number(t.radius_px()),
                     format_number(radius_at(track, t.log_threshold_ci95.second)),
                     format_number(radius_at(track, t.log_threshold_ci95.first))});
        }
    }
    return csv.text();
}

}  // namespace stairstep
