// What is measured along an axis: a curve a technique, and how steep it is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/bench/timed_renderer.h"
#include "renderer/scaling/power_law.h"

namespace stairstep::scaling {

struct Point {
    /// Of the axis.
    double value = 0;
    int picture_width = 0;
    int picture_height = 0;
    /// Of the map as last drawn; 0 where the technique reads none.
    int map_width = 0;
    int map_height = 0;
    bench::MedianTimes times;

    double texels() const { return static_cast<double>(map_width) * map_height; }
};

struct Curve {
    bench::Configuration configuration;
    /// By ascending value, two or more.
    std::vector<Point> points;
};

struct AxisCurves {
    /// As in Axis.
    std::string axis;
    std::string quantity;
    std::vector<Curve> curves;
};

/// A part of a frame, or the whole of it: frame, depth, prepare, surfaces, lighting, need, fit; processor, the whole again but by
/// the processor's clock (bench::MedianTimes).
struct Part {
    const char* name;
    double (*ms)(const bench::MedianTimes& times);
};
std::span<const Part> parts();

/// How a part's time grows with the axis; nullopt for a part that takes no time somewhere.
std::optional<PowerLaw> law_of(const Curve& curve, const Part& part);

/// The frame's: every frame takes time.
PowerLaw frame_law(const Curve& curve);

/// A frame's time at the last value over that at the first.
double growth_of(const Curve& curve);

/// "0.98 ± 0.03", the standard error where there is one.
std::string exponent_text(const PowerLaw& law);

}  // namespace stairstep::scaling
