#include "renderer/scaling/scaling_figure.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "renderer/bench/technique_look.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/number.h"

namespace stairstep::scaling {
namespace {

constexpr int kWidth = 1020;
constexpr int kHeight = 470;

const bench::TechniqueLook& look_of(const bench::Configuration& configuration) {
    const auto found = std::ranges::find(bench::kTechniqueLooks, configuration.technique,
                                         [](const bench::TechniqueLook& look) { return std::string(look.technique); });
    assert(found != bench::kTechniqueLooks.end());
    return *found;
}

/// gnuplot's text between single quotes, where two stand for one.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// The axis' own values as tics.
std::string tics_of(const Curve& curve) {
    std::string tics;
    for (const Point& point : curve.points) tics += (tics.empty() ? "" : ",") + format_number(point.value);
    return tics;
}

}  // namespace

std::string scaling_figure(const AxisCurves& axis) {
    std::string script =
        "set termoption noenhanced\nset logscale xy\nset grid xtics ytics\nset format xy '%g'\n"
        "set ytics add (2,5,20,50,200,500,2000,5000,20000,50000)\n"
        "set xlabel " +
        quoted(axis.quantity) +
        "\nset ylabel 'frame, ms'\nset key outside right top Left reverse samplen 2 spacing 1.3 font ',12'\n";
    std::string plot;
    double left = INFINITY;
    double right = 0;
    double low = INFINITY;
    double high = 0;
    for (size_t i = 0; i < axis.curves.size(); ++i) {
        const Curve& curve = axis.curves[i];
        const std::string name = "$curve" + std::to_string(i);
        script += name + " << EOD\n";
        for (const Point& point : curve.points) {
            script += format_number(point.value) + " " + format_number(point.times.frame.cpu_ms) + "\n";
            left = std::min(left, point.value);
            right = std::max(right, point.value);
            low = std::min(low, point.times.frame.cpu_ms);
            high = std::max(high, point.times.frame.cpu_ms);
        }
        script += "EOD\n";
        const bench::TechniqueLook& look = look_of(curve.configuration);
        const PowerLaw law = frame_law(curve);
        const std::string colour = " lc rgb '" + std::string(look.colour) + "'";
        plot += (plot.empty() ? "" : ", \\\n  ") + name + " u 1:2 w lp pt " +
                std::to_string(look.marker + (curve.configuration.side ? 0 : 1)) + " ps 0.9 lw 1.6" + colour +
                " title " + quoted(label(curve.configuration) + ": " + exponent_text(law)) + ", \\\n  " +
                format_number(law.factor) + "*x**(" + format_number(law.exponent) + ") dt 2 lw 0.8" + colour +
                " notitle";
    }
    script += "set xrange [" + format_number(left / 1.15) + ":" + format_number(right * 1.15) + "]\nset yrange [" +
              format_number(low / 1.3) + ":" + format_number(high * 1.3) + "]\nset xtics (" +
              tics_of(axis.curves.front()) + ")\n";
    return draw_svg(script + "plot " + plot + "\n", kWidth, kHeight);
}

}  // namespace stairstep::scaling
