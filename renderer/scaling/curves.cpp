#include "renderer/scaling/curves.h"

#include <array>
#include <cassert>

#include "stimuli/number.h"

namespace stairstep::scaling {

std::span<const Part> parts() {
    using bench::MedianTimes;
    static constexpr std::array kParts{
        Part{"frame", [](const MedianTimes& t) { return t.frame.cpu_ms; }},
        Part{"depth", [](const MedianTimes& t) { return t.depth.cpu_ms; }},
        Part{"prepare", [](const MedianTimes& t) { return t.prepare.cpu_ms; }},
        Part{"surfaces", [](const MedianTimes& t) { return t.surfaces.cpu_ms; }},
        Part{"lighting", [](const MedianTimes& t) { return t.lighting.cpu_ms; }},
        Part{"need", [](const MedianTimes& t) { return t.need.cpu_ms; }},
        Part{"fit", [](const MedianTimes& t) { return t.fit_ms; }},
        Part{"processor", [](const MedianTimes& t) { return t.processor_ms; }},
    };
    return kParts;
}

std::optional<PowerLaw> law_of(const Curve& curve, const Part& part) {
    std::vector<double> values;
    std::vector<double> times;
    for (const Point& point : curve.points) {
        values.push_back(point.value);
        times.push_back(part.ms(point.times));
    }
    return fit_power_law(values, times);
}

PowerLaw frame_law(const Curve& curve) {
    const std::optional<PowerLaw> law = law_of(curve, parts().front());
    assert(law);
    return *law;
}

double growth_of(const Curve& curve) {
    return curve.points.back().times.frame.cpu_ms / curve.points.front().times.frame.cpu_ms;
}

std::string exponent_text(const PowerLaw& law) {
    // No minus before a zero.
    const std::string exponent = format_fixed(law.exponent, 2);
    return (exponent == "-0.00" ? "0.00" : exponent) +
           (law.exponent_se ? " ± " + format_fixed(*law.exponent_se, 2) : std::string());
}

}  // namespace stairstep::scaling
