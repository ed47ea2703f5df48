#include "analysis/psychometric_figure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <map>

#include "analysis/binomial_interval.h"
#include "analysis/plot.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

bool same(const ConditionName& a, const ConditionName& b) {
    return a.pattern == b.pattern && a.contrast == b.contrast && a.kernel == b.kernel;
}

struct Span {
    double low = INFINITY, high = -INFINITY;
    void take(const std::vector<ResponseBin>& bins) {
        for (const ResponseBin& bin : bins) {
            low = std::min(low, bin.strength);
            high = std::max(high, bin.strength);
        }
    }
    std::string xrange() const {
        const double margin = 0.06 * (high - low) + 0.05;
        return "set xrange [" + format_fixed(low - margin, 4) + ":" + format_fixed(high + margin, 4) + "]\n";
    }
};

/// Disks with area in proportion to trials, the largest of `largest_ps`, and their intervals behind them.
template <typename Successes, typename Trials>
void add_bins(Plot& plot, const std::string& id, const std::vector<ResponseBin>& bins, Successes successes,
              Trials trials, double largest_ps, const std::string& rgb, int point_type, const std::string& title) {
    auto& rows = plot.block(id);
    double most = 0;
    for (const ResponseBin& bin : bins) most = std::max(most, static_cast<double>(trials(bin)));
    for (const ResponseBin& bin : bins) {
        const double n = trials(bin), k = successes(bin);
        if (n == 0) continue;
        const auto [low, high] = binomial_interval(k, n);
        rows << format_fixed(bin.strength, 4) << ' ' << format_fixed(k / n, 4) << ' ' << format_fixed(low, 4) << ' '
             << format_fixed(high - low, 4) << ' ' << format_fixed(std::max(0.18, largest_ps * std::sqrt(n / most)), 3)
             << '\n';
    }
    plot.draw(id, "u 1:3:(0):4 w vectors nohead lw 1 lc rgb '" + rgb + "' notitle");
    plot.draw(id, "u 1:2:5 w p pt " + std::to_string(point_type) + " ps variable lc rgb '" + rgb + "' " +
                      (title.empty() ? "notitle" : "title " + quoted(title)));
}

void add_curve(Plot& plot, const PsychometricFit& fit, const Span& span) {
    if (!fit.estimated) return;
    constexpr int kPoints = 80;
    auto& rows = plot.block("curve");
    for (int i = 0; i <= kPoints; ++i) {
        const double x = span.low - 0.05 + (span.high - span.low + 0.1) * i / kPoints;
        rows << format_fixed(x, 4) << ' ' << format_fixed(fit.probability(x), 4) << '\n';
    }
    plot.draw("curve", "u 1:2 w l lw 1.8 lc rgb '#333333' notitle");
}

/// A cross of thin lines at the threshold: at p, where the curve goes through it.
std::string threshold_mark(double strength, double p) {
    const std::string x = format_fixed(strength, 4);
    return "set arrow from " + x + ",graph 0 to " + x + "," + format_fixed(p, 4) +
           " nohead lw 0.8 dt 3 lc rgb '#777777'\nset arrow from graph 0,first " + format_fixed(p, 4) + " to " + x +
           "," + format_fixed(p, 4) + " nohead lw 0.8 dt 3 lc rgb '#777777'\n";
}

int trials_in(const ResponseBin& bin) {
    return bin.trials;
}
int right_in(const ResponseBin& bin) {
    return bin.right;
}

bool is_yes_no(const StudyCheck& check) {
    return std::all_of(check.observers.begin(), check.observers.end(),
                       [](const ObserverCheck& o) { return o.task == Task::yes_no; });
}

/// From chance, or below it where answers were.
std::string right_range(const std::vector<ResponseBin>& bins) {
    double lowest = 0.5;
    for (const ResponseBin& bin : bins) lowest = std::min(lowest, static_cast<double>(bin.right) / bin.trials);
    return std::string("set yrange [") + (lowest < 0.35 ? "0" : "0.3") + ":1.03]\n";
}

}  // namespace

std::vector<ResponseBin> binned(const std::vector<double>& strengths, const std::vector<Trial>& trials, double width,
                                int least) {
    assert(strengths.size() == trials.size() && width > 0);
    std::map<double, std::vector<size_t>> cells;
    for (size_t i = 0; i < trials.size(); ++i) {
        assert(std::isfinite(strengths[i]));
        cells[std::floor(strengths[i] / width)].push_back(i);
    }
    std::deque<std::vector<size_t>> groups;
    for (auto& [at, members] : cells) groups.push_back(std::move(members));
    const auto is_small = [&](const std::vector<size_t>& group) { return static_cast<int>(group.size()) < least; };
    while (groups.size() > 1 && is_small(groups.front())) {
        groups[1].insert(groups[1].end(), groups[0].begin(), groups[0].end());
        groups.pop_front();
    }
    while (groups.size() > 1 && is_small(groups.back())) {
        auto& next = groups[groups.size() - 2];
        next.insert(next.end(), groups.back().begin(), groups.back().end());
        groups.pop_back();
    }
    std::vector<ResponseBin> bins;
    for (const std::vector<size_t>& group : groups) {
        ResponseBin bin;
        std::vector<Trial> members;
        for (const size_t i : group) {
            bin.strength += strengths[i] / static_cast<double>(group.size());
            bin.right += trials[i].correct();
            members.push_back(trials[i]);
        }
        bin.trials = static_cast<int>(group.size());
        bin.counts = response_counts(members);
        bins.push_back(bin);
    }
    return bins;
}

std::vector<ResponseBin> pooled_bins(const StudyCheck& check, const ConditionName& condition) {
    std::vector<double> strengths;
    std::vector<Trial> trials;
    for (const ObserverCurve& curve : check.curves) {
        if (!curve.log_slope || !same(curve.condition, condition)) continue;
        for (size_t i = 0; i < curve.trials.size(); ++i) {
            strengths.push_back(curve.answers[i].strength + *curve.log_slope);
            trials.push_back(curve.trials[i]);
        }
    }
    return binned(strengths, trials, kPooledBinWidth, kLeastInPooledBin);
}

std::vector<ResponseBin> observer_bins(const ObserverCurve& curve) {
    std::vector<double> strengths;
    for (const Answer01& answer : curve.answers) strengths.push_back(answer.strength);
    return binned(strengths, curve.trials, kObserverBinWidth, kLeastInObserverBin);
}

std::string pooled_psychometric_figure(const StudyCheck& check) {
    const bool yes_no = is_yes_no(check);
    const int columns = panel_columns(check.conditions.size());
    Panels panels({.columns = columns, .panel_height = 270, .left = 58, .right = 12, .bottom = 48, .font = 12});
    std::vector<std::vector<ResponseBin>> bins;
    Span span;
    for (const ConditionCheck& c : check.conditions) {
        bins.push_back(pooled_bins(check, c.condition));
        span.take(bins.back());
    }
    const std::string x_axis = "set xlabel 'log10(c_j a/r)'\n" + span.xrange() + "set xtics " +
                               format_number(tic_step(span.high - span.low + 0.1, 4)) + "\n";
    for (size_t i = 0; i < check.conditions.size(); ++i) {
        const ConditionCheck& c = check.conditions[i];
        Plot plot;
        std::string mark;
        add_bins(plot, "right", bins[i], right_in, trials_in, 1.6, colour(c.condition.pattern), 7, "");
        if (c.aligned && c.aligned->estimated) {
            add_curve(plot, *c.aligned, span);
            mark = threshold_mark(c.aligned->parameters.threshold, c.aligned->settings.p_threshold);
        }
        panels.add("set title " + quoted(describe(c.condition)) + "\n" + x_axis + right_range(bins[i]) + mark +
                       (i % static_cast<size_t>(columns) == 0 ? "set ylabel 'share of right answers'\n" : ""),
                   plot);
    }
    if (yes_no) {
        panels.end_row();
        for (size_t i = 0; i < check.conditions.size(); ++i) {
            Plot plot;
            add_bins(
                plot, "lines", bins[i], [](const ResponseBin& b) { return b.counts.false_alarms; },
                [](const ResponseBin& b) { return b.counts.lines; }, 1.3, "#888888", 6, "lines");
            add_bins(
                plot, "artifacts", bins[i], [](const ResponseBin& b) { return b.counts.hits; },
                [](const ResponseBin& b) { return b.counts.artifacts; }, 1.3,
                colour(check.conditions[i].condition.pattern), 7, "artifacts");
            panels.add(x_axis + "set yrange [-0.02:1.03]\n" +
                           (i == 0 ? "set ylabel 'share said to be artifacts'\n"
                                     "set key right center reverse Left samplen 0.8 font ',11'\n"
                                   : ""),
                       plot);
        }
    }
    return panels.svg();
}

std::string observer_psychometric_figure(const StudyCheck& check) {
    std::vector<const ObserverCurve*> curves;
    for (const ObserverCheck& o : check.observers) {
        for (const ConditionCheck& c : check.conditions) {
            for (const ObserverCurve& curve : check.curves) {
                if (curve.observer == o.observer && same(curve.condition, c.condition)) curves.push_back(&curve);
            }
        }
    }
    std::vector<std::vector<ResponseBin>> bins;
    Span span;
    for (const ObserverCurve* curve : curves) {
        bins.push_back(observer_bins(*curve));
        span.take(bins.back());
    }
    Panels panels({.columns = 4, .panel_height = 150, .left = 44, .right = 10, .top = 24, .bottom = 26, .font = 12});
    for (size_t i = 0; i < curves.size(); ++i) {
        const ObserverCurve& curve = *curves[i];
        Plot plot;
        std::string mark;
        add_bins(plot, "right", bins[i], right_in, trials_in, 0.9, colour(curve.condition.pattern), 7, "");
        if (curve.fit.estimated) {
            add_curve(plot, curve.fit, span);
            mark = threshold_mark(curve.fit.parameters.threshold, curve.fit.settings.p_threshold);
        }
        panels.add("set title " +
                       quoted(curve.observer + ": " + std::string(name(curve.condition.pattern)) + " " +
                              format_number(100 * curve.condition.contrast) + " %") +
                       "\n" + span.xrange() + "set xtics " + format_number(tic_step(span.high - span.low + 0.1, 4)) +
                       "\nset ytics 0.25\nset yrange [0:1.05]\n" + mark,
                   plot);
    }
    return panels.svg();
}

}  // namespace stairstep
