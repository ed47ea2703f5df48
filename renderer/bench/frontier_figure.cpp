#include "renderer/bench/frontier_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renderer/bench/technique_look.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

constexpr int kWidth = 1020;
constexpr int kHeight = 480;
/// A logarithm needs something to show for an error of none.
constexpr double kLeastError = 1e-5;

struct Point {
    double x = 0;
    double y = 0;
};

Point point_of(const std::vector<Measurement>& measurements, const Measurement& one) {
    return {steady_ms(measurements, one), std::max(one.error.rmse, kLeastError)};
}

bool is_soft(const Measurement& one) {
    return truth_of(one.configuration) == TruthKind::area_light;
}

std::string row_of(double x, double y) {
    return format_number(x) + " " + format_number(y) + "\n";
}

/// What the law's points are marked with: their taps where they take any.
std::string mark_of(const Configuration& configuration) {
    return configuration.taps > 0 ? "auto " + std::to_string(configuration.taps) : "auto";
}

/// The frontier from the top of the panel to its right side.
std::string steps(std::vector<Point> best, double top, double right) {
    std::ranges::sort(best, {}, &Point::x);
    std::string rows = row_of(best.front().x, top);
    for (const Point& point : best) rows += row_of(point.x, point.y);
    return rows + row_of(right, best.back().y);
}

/// gnuplot's commands for one panel; empty where there is nothing for it.
std::string panel(const std::vector<Measurement>& measurements, bool soft, const std::string& title) {
    std::vector<Point> all;
    std::vector<Point> best;
    std::map<std::string, std::string> fixed, sized;
    for (const Measurement& one : measurements) {
        if (is_ablation(one.configuration)) continue;
        if (is_soft(one) != soft) continue;
        const Point point = point_of(measurements, one);
        all.push_back(point);
        if (one.on_frontier) best.push_back(point);
        std::string& rows = (one.configuration.side ? fixed : sized)[one.configuration.technique];
        rows += format_number(point.x) + " " + format_number(point.y) + " \"" + mark_of(one.configuration) + "\"\n";
    }
    if (all.empty()) return "";
    const auto [left, right] = std::ranges::minmax(all, {}, &Point::x);
    const auto [low, high] = std::ranges::minmax(all, {}, &Point::y);
    const double x_end = right.x * 1.6;
    const double y_end = high.y * 1.5;
    std::string script = "set title '" + title + "'\nset xrange [" + format_number(left.x / 1.3) + ":" +
                         format_number(x_end) + "]\nset yrange [" + format_number(low.y / 1.5) + ":" +
                         format_number(y_end) + "]\n";
    const std::string id = soft ? "soft" : "filter";
    script += "$" + id + "_frontier << EOD\n" + steps(best, y_end, x_end) + "EOD\n";
    std::string plot = "$" + id + "_frontier u 1:2 w steps lw 1.5 lc rgb '#bbbbbb' title 'frontier'";
    int block = 0;
    for (const TechniqueLook& look : kTechniqueLooks) {
        bool titled = false;
        for (const bool by_law : {false, true}) {
            const auto& rows_of = by_law ? sized : fixed;
            const auto rows = rows_of.find(look.technique);
            if (rows == rows_of.end()) continue;
            const std::string name = "$" + id + std::to_string(block++);
            script += name + " << EOD\n" + rows->second + "EOD\n";
            plot += ", \\\n  " + name + " u 1:2 w p pt " + std::to_string(look.marker + (by_law ? 1 : 0)) + " ps " +
                    (by_law ? "1.1" : "0.8") + " lw 1.3 lc rgb '" + look.colour + "' " +
                    (titled ? std::string("notitle") : "title '" + std::string(look.technique) + "'");
            titled = true;
            if (by_law) {
                plot += ", \\\n  " + name + " u 1:2:3 w labels left offset 0.7,0.3 font ',10' tc rgb '" + look.colour +
                        "' notitle";
            }
        }
    }
    return script + "plot " + plot + "\n";
}

}  // namespace

std::string frontier_figure(const std::vector<Measurement>& measurements) {
    const auto place = [](int column) {
        const auto x = [&](double px) { return format_fixed((column * kWidth / 2.0 + px) / kWidth, 5); };
        return "set lmargin at screen " + x(76) + "\nset rmargin at screen " + x(kWidth / 2.0 - 14) + "\n";
    };
    const auto panels = std::array{panel(measurements, true, "against the area light"),
                                   panel(measurements, false, "against the filter, converged")};
    std::string script =
        "set termoption noenhanced\nset multiplot\nset logscale xy\nset grid xtics ytics mytics\n"
        "set format y '%g'\nset format x '%g'\nset xlabel 'frame, ms' offset 0,0.2\n"
        "set ylabel 'root-mean-square error of visibility' offset 1.2,0\nset ytics add "
        "(0.001,0.002,0.005,0.01,0.02,0.05,0.1,0.2)\nset xtics add "
        "(2,3,5,20,30,50,200,300,500,2000,3000)\n"
        "set tmargin at screen 0.92\nset bmargin at screen 0.29\n"
        "set key at graph 0.5,-0.24 center top horizontal maxcols 4 samplen 1 font ',12'\n";
    for (int i = 0; i < 2; ++i) {
        if (!panels[static_cast<size_t>(i)].empty()) script += place(i) + panels[static_cast<size_t>(i)];
    }
    return draw_svg(script + "unset multiplot\n", kWidth, kHeight);
}

}  // namespace stairstep::bench
