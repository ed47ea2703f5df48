#include "tests/benchmark/radius_cost.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "stimuli/draw.h"
#include "tests/benchmark/stopwatch.h"

namespace stairstep {
namespace {

constexpr double kTexel_px = 10;
constexpr double kLargest_px = 640;
/// Above this the penumbra is larger than half the picture of 640 × 480 px.
constexpr double kFittedFrom_px = 160;

/// The least processor times, s, for each radius.
struct Times {
    std::map<double, double> picture;
    std::map<double, double> value;
};

std::map<std::pair<KernelShape, Pattern>, Times>& fastest() {
    static std::map<std::pair<KernelShape, Pattern>, Times> times;
    return times;
}

double& keep_less(std::map<double, double>& times, double radius, double time) {
    double& kept = times.try_emplace(radius, time).first->second;
    return kept = std::min(kept, time);
}

/// The time of one value in the penumbra, the least of several passes over a lattice of pixels.
double seconds_a_value(const Stimulus& stimulus) {
    const StimulusSampler sampler(stimulus);
    std::vector<std::pair<int, int>> pixels;
    for (int row = 0; row < stimulus.height_px; row += 8) {
        for (int column = 0; column < stimulus.width_px; column += 16) {
            const double value = sampler.luminance(column, row);
            if (value > 0 && value < 1) pixels.emplace_back(column, row);
        }
    }
    double least = HUGE_VAL;
    for (int pass = 0; pass < 9; ++pass) {
        least = std::min(least, processor_seconds([&] {
                             for (const auto& [column, row] : pixels)
                                 benchmark::DoNotOptimize(sampler.luminance(column, row));
                         }));
    }
    return least / static_cast<double>(pixels.size());
}

void levels(benchmark::State& state, const Stimulus& stimulus) {
    double least = HUGE_VAL;
    for ([[maybe_unused]] auto iteration : state) {
        const double took = processor_seconds([&] { benchmark::DoNotOptimize(draw<uint8_t>(stimulus, level_8bit)); });
        least = std::min(least, took);
        state.SetIterationTime(took);
    }
    // The library runs a row several times, until it has lasted long enough.
    Times& times = fastest()[{stimulus.kernel.shape, stimulus.pattern}];
    state.counters["fastest_ms"] = 1e3 * keep_less(times.picture, stimulus.kernel.radius_px, least);
    state.counters["value_ns"] = 1e9 * keep_less(times.value, stimulus.kernel.radius_px, seconds_a_value(stimulus));
}

/// Slope of the straight line through (ln r, ln t) by least squares, over the larger radii; two of them or more.
double exponent(const std::map<double, double>& all) {
    const std::map<double, double> times(all.lower_bound(kFittedFrom_px), all.end());
    double x_mean = 0;
    double y_mean = 0;
    for (const auto& [radius, time] : times) {
        x_mean += std::log(radius) / static_cast<double>(times.size());
        y_mean += std::log(time) / static_cast<double>(times.size());
    }
    double xy = 0;
    double xx = 0;
    for (const auto& [radius, time] : times) {
        xy += (std::log(radius) - x_mean) * (std::log(time) - y_mean);
        xx += (std::log(radius) - x_mean) * (std::log(radius) - x_mean);
    }
    return xy / xx;
}

}  // namespace

void register_radius_cost() {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk}) {
        for (const Pattern pattern : {Pattern::step, Pattern::stair, Pattern::line}) {
            for (double radius = 5; radius <= kLargest_px; radius *= 2) {
                const Stimulus stimulus{.pattern = pattern,
                                        .silhouette = pattern == Pattern::stair ? Pattern::stair : Pattern::step,
                                        .texel_px = kTexel_px,
                                        .kernel = {shape, radius}};
                const std::string row = "radius/" + std::string(name(shape)) + "/" + std::string(name(pattern)) + "/r" +
                                        std::to_string(static_cast<int>(radius));
                benchmark::RegisterBenchmark(row.c_str(), levels, stimulus)
                    ->UseManualTime()
                    ->MinTime(0.1)
                    ->Unit(benchmark::kMillisecond);
            }
        }
    }
}

void print_radius_exponents() {
    bool is_headed = false;
    for (const auto& [series, times] : fastest()) {
        if (std::distance(times.value.lower_bound(kFittedFrom_px), times.value.end()) < 2) continue;
        if (!is_headed) {
            std::printf("\nexponent p of time ~ r^p, r from %g px on\n", kFittedFrom_px);
            std::printf("kernel  pattern   a picture   a value   bar of a value\n");
        }
        is_headed = true;
        const auto [shape, pattern] = series;
        const double bar = shape == KernelShape::disk ? 1 : 0;
        const double p = exponent(times.value);
        // Times of one run scatter by a tenth or so.
        std::printf("%-7s %-8s %10.2f %9.2f   %g  %s\n", std::string(name(shape)).c_str(),
                    std::string(name(pattern)).c_str(), exponent(times.picture), p, bar,
                    p <= bar + 0.15 ? "pass" : "miss");
    }
}

}  // namespace stairstep
