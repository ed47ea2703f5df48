#include "analysis/influence_figure.h"

#include <algorithm>
#include <cmath>

#include "analysis/plot.h"
#include "analysis/statistics.h"
#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Of tics; more is cut off.
constexpr size_t kLongestName = 14;

/// Standard error of ln c, from its interval: Student's t over observers.
double ln_slope_se(const ConditionLaw& law) {
    if (law.observers < 2 || !(law.slope_ci95.first > 0)) return 0;
    return std::log(law.slope_ci95.second / law.slope_ci95.first) / (2 * t_quantile(0.975, law.observers - 1));
}

void add(std::vector<Influence>& all, const ConditionLaw& law, const std::vector<LeftOut>& table, bool is_size) {
    const double se = ln_slope_se(law);
    const double bound = 2 / std::sqrt(static_cast<double>(table.size()));
    for (const LeftOut& l : table) {
        Influence influence;
        influence.condition = {law.pattern, law.contrast, law.kernel};
        influence.left_out = l.left_out + (is_size ? " px" : "");
        influence.is_size = is_size;
        influence.slope = l.slope;
        influence.change = l.change;
        influence.standard_errors = se > 0 ? std::log1p(l.change) / se : 0;
        influence.is_flagged = std::abs(influence.standard_errors) > bound;
        all.push_back(influence);
    }
}

}  // namespace

std::vector<Influence> influences(const Law& law) {
    std::vector<Influence> all;
    for (const ConditionLaw& c : law.conditions) {
        add(all, c, c.without_observer, false);
        add(all, c, c.without_size, true);
    }
    return all;
}

std::string influence_figure(const Law& law, const std::vector<Influence>& influences) {
    size_t most_rows = 1, longest_name = 1;
    double largest = 0.01;
    for (const Influence& i : influences) {
        largest = std::max(largest, std::abs(i.change));
        longest_name = std::max(longest_name, i.left_out.size());
    }
    for (const ConditionLaw& c : law.conditions) {
        most_rows = std::max(most_rows, c.without_observer.size() + c.without_size.size());
    }
    const int columns = panel_columns(law.conditions.size());
    const int left = 20 + 7 * static_cast<int>(std::min(longest_name, kLongestName));
    Panels panels({.columns = columns,
                   .panel_height = 84 + 17 * static_cast<int>(most_rows),
                   .left = left,
                   .right = 14,
                   .bottom = 50,
                   .font = 12});
    for (const ConditionLaw& c : law.conditions) {
        Plot plot;
        auto& lines = plot.block("lines");
        auto& plain = plot.block("plain");
        auto& flagged = plot.block("flagged");
        std::string tics;
        size_t row = 0;
        for (const Influence& i : influences) {
            if (i.condition.pattern != c.pattern || i.condition.contrast != c.contrast ||
                i.condition.kernel != c.kernel) {
                continue;
            }
            const std::string y = std::to_string(-static_cast<long>(row++));
            const std::string x = format_fixed(100 * i.change, 4);
            lines << 0 << ' ' << y << ' ' << x << '\n';
            (i.is_flagged ? flagged : plain) << x << ' ' << y << '\n';
            tics += (tics.empty() ? "" : ", ") + quoted(shortened(i.left_out, kLongestName)) + " " + y;
        }
        const std::string rgb = std::string(" lc rgb '") + colour(c.pattern) + "' ";
        plot.draw("lines", "u 1:2:($3):(0) w vectors nohead lw 1" + rgb + "notitle");
        plot.draw("plain", "u 1:2 w p pt 6 ps 0.6 lw 1.3" + rgb + "notitle");
        plot.draw("flagged", "u 1:2 w p pt 7 ps 0.9" + rgb + "notitle");
        panels.add("set title " + quoted(describe({c.pattern, c.contrast, c.kernel})) +
                       "\nset grid xtics noytics\nset xlabel 'change of c, %'\nset xtics " +
                       format_number(tic_step(230 * largest, 6)) + "\nset ytics (" + tics + ")\nset xrange [" +
                       format_fixed(-115 * largest, 3) + ":" + format_fixed(115 * largest, 3) + "]\nset yrange [" +
                       std::to_string(-static_cast<long>(most_rows)) +
                       ":1]\n"
                       "set arrow from 0,graph 0 to 0,graph 1 nohead lw 0.8 lc rgb '#777777'\n",
                   plot);
    }
    return panels.svg();
}

std::string influence_csv(const std::vector<Influence>& influences) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "left_out", "kind", "slope", "change", "standard_errors", "flagged"});
    for (const Influence& i : influences) {
        csv.row({std::string(name(i.condition.pattern)), format_number(i.condition.contrast),
                 std::string(name(i.condition.kernel)), i.left_out, i.is_size ? "texel_px" : "observer",
                 format_number(i.slope), format_number(i.change), format_number(i.standard_errors),
                 i.is_flagged ? "1" : "0"});
    }
    return csv.text();
}

}  // namespace stairstep
