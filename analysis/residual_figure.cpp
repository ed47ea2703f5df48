#include "analysis/residual_figure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/plot.h"
#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Positions of this many classes get a mean over observers each.
constexpr size_t kMeanClasses = 8;
/// … of this many groups at least.
constexpr size_t kLeastInMean = 5;

void add_groups(std::vector<ResidualGroup>& groups, const ObserverCurve& curve, ResidualOrder order) {
    const size_t n = curve.answers.size();
    std::vector<double> predictions;
    for (const Answer01& answer : curve.answers) predictions.push_back(curve.fit.probability(answer.strength));
    std::vector<size_t> sequence(n);
    std::iota(sequence.begin(), sequence.end(), size_t{0});
    if (order == ResidualOrder::prediction) {
        std::stable_sort(sequence.begin(), sequence.end(),
                         [&](size_t a, size_t b) { return predictions[a] < predictions[b]; });
    }
    const size_t count = std::max<size_t>(1, (n + kResidualGroupSize / 2) / kResidualGroupSize);
    for (size_t g = 0; g < count; ++g) {
        ResidualGroup group{curve.observer, curve.condition, order, 0, 0, 0, 0, 0};
        for (size_t k = g * n / count; k < (g + 1) * n / count; ++k) {
            const size_t i = sequence[k];
            ++group.trials;
            group.right += curve.answers[i].correct;
            group.expected += predictions[i];
            group.position += order == ResidualOrder::prediction ? predictions[i] : static_cast<double>(i + 1);
        }
        const double trials = group.trials;
        group.position /= trials;
        const Level level{0, static_cast<double>(group.right), trials};
        group.residual = deviance_residual(level, 1 - group.expected / trials);
        groups.push_back(group);
    }
}

Plot plot_of(const std::vector<const ResidualGroup*>& groups, const ConditionName& condition) {
    Plot plot;
    auto& points = plot.block("points");
    std::vector<const ResidualGroup*> sorted = groups;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const ResidualGroup* a, const ResidualGroup* b) { return a->position < b->position; });
    for (const ResidualGroup* g : sorted) {
        points << format_fixed(g->position, 4) << ' ' << format_fixed(g->residual, 4) << '\n';
    }
    auto& means = plot.block("means");
    const size_t n = sorted.size();
    const size_t classes = std::clamp<size_t>(n / kLeastInMean, 1, kMeanClasses);
    for (size_t k = 0, first = 0; k < classes && first < n; ++k) {
        size_t last = std::max(first + 1, (k + 1) * n / classes);
        // Equal positions stay together.
        while (last < n && sorted[last]->position == sorted[last - 1]->position) ++last;
        double position = 0, residual = 0;
        for (size_t i = first; i < last; ++i) {
            position += sorted[i]->position / static_cast<double>(last - first);
            residual += sorted[i]->residual / static_cast<double>(last - first);
        }
        means << format_fixed(position, 4) << ' ' << format_fixed(residual, 4) << '\n';
        first = last;
    }
    const std::string rgb = std::string(" lc rgb '") + colour(condition.pattern) + "' notitle";
    plot.draw("points", "u 1:2 w p pt 7 ps 0.35" + rgb);
    plot.draw("means", "u 1:2 w l lw 2 lc rgb '#333333' notitle");
    return plot;
}

}  // namespace

std::vector<ResidualGroup> residual_groups(const StudyCheck& check) {
    std::vector<ResidualGroup> groups;
    for (const ObserverCurve& curve : check.curves) {
        if (!curve.fit.estimated) continue;
        add_groups(groups, curve, ResidualOrder::prediction);
        add_groups(groups, curve, ResidualOrder::trial);
    }
    return groups;
}

std::string residual_figure(const StudyCheck& check, const std::vector<ResidualGroup>& groups) {
    const int columns = panel_columns(check.conditions.size());
    double largest = 3.2, last_trial = 1, least_prediction = 1;
    for (const ResidualGroup& g : groups) {
        largest = std::max(largest, 1.05 * std::abs(g.residual));
        if (g.order == ResidualOrder::trial) {
            last_trial = std::max(last_trial, g.position + 0.5 * g.trials);
        } else {
            least_prediction = std::min(least_prediction, g.position);
        }
    }
    Panels panels({.columns = columns, .panel_height = 240, .left = 54, .right = 12, .bottom = 50, .font = 12});
    for (const ResidualOrder order : {ResidualOrder::prediction, ResidualOrder::trial}) {
        panels.end_row();
        for (size_t i = 0; i < check.conditions.size(); ++i) {
            const ConditionName& condition = check.conditions[i].condition;
            std::vector<const ResidualGroup*> own;
            for (const ResidualGroup& g : groups) {
                if (g.order == order && g.condition.pattern == condition.pattern &&
                    g.condition.contrast == condition.contrast && g.condition.kernel == condition.kernel) {
                    own.push_back(&g);
                }
            }
            std::string settings = "set yrange [" + format_fixed(-largest, 2) + ":" + format_fixed(largest, 2) +
                                   "]\nset ytics " + format_number(tic_step(2 * largest, 8)) + "\n";
            if (order == ResidualOrder::prediction) {
                const double low = std::min(0.48, least_prediction - 0.02);
                settings += "set title " + quoted(describe(condition)) + "\nset xlabel 'predicted share right'\n" +
                            "set xrange [" + format_fixed(low, 3) + ":1.01]\nset xtics 0.1\n";
            } else {
                if (check.conditions.size() > static_cast<size_t>(columns)) {
                    settings += "set title " + quoted(describe(condition)) + "\n";
                }
                settings += "set xlabel 'trial in the condition'\nset xrange [0:" + format_fixed(last_trial + 1, 0) +
                            "]\nset xtics " + format_number(tic_step(last_trial, 5)) + "\n";
            }
            if (i % static_cast<size_t>(columns) == 0) settings += "set ylabel 'deviance residual'\n";
            panels.add(settings, plot_of(own, condition));
        }
    }
    return panels.svg();
}

std::string residuals_csv(const std::vector<ResidualGroup>& groups) {
    CsvWriter csv;
    csv.row(
        {"observer", "pattern", "contrast", "kernel", "order", "position", "trials", "right", "expected", "residual"});
    for (const ResidualGroup& g : groups) {
        csv.row({g.observer, std::string(name(g.condition.pattern)), format_number(g.condition.contrast),
                 std::string(name(g.condition.kernel)), g.order == ResidualOrder::prediction ? "prediction" : "trial",
                 format_number(g.position), std::to_string(g.trials), std::to_string(g.right),
                 format_number(g.expected), format_number(g.residual)});
    }
    return csv.text();
}

}  // namespace stairstep
