// What a fit costs: 20 observers × 16 tracks × 60 trials, 2,000 bootstrap studies, a million trials, and the memory that
// bootstraps take. Medians of a few rounds; on a machine that others use processor times are the steadier ones, so both are
// there, and the bars are on wall time on two threads.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "analysis/law_fit.h"
#include "stimuli/random.h"
#include "study/psychometric.h"
#include "tests/benchmark/stopwatch.h"

namespace stairstep {
namespace {

constexpr int kJobs = 2;
constexpr int kRounds = 5;

/// Trials that all differ, spread around their thresholds as adaptive tracks spread them.
std::vector<Trial> trials_of(int observers, int trials_a_track) {
    const PsychometricShape shape{.beta = 3.5, .gamma = 0.5, .delta = 0.02, .p_threshold = 0.82};
    std::vector<Trial> trials;
    for (int i = 0; i < observers; ++i) {
        Random random = Random(1).stream(static_cast<uint64_t>(i));
        const double slope = 3 * std::exp(0.16 * random.normal());
        for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
            for (const double contrast : {1.0, 0.5}) {
                for (const double a : {5.0, 10.0, 20.0, 30.0}) {
                    for (int k = 0; k < trials_a_track; ++k) {
                        Trial trial;
                        trial.observer = "o" + std::to_string(i);
                        trial.condition = {pattern, KernelShape::box, contrast, a};
                        trial.radius_px = a * slope * std::pow(10, 0.2 * random.normal());
                        const double right = probability_correct(shape, threshold_offset(shape),
                                                                 std::log10(a / trial.radius_px), -std::log10(slope));
                        if (random.uniform() >= right) trial.response = Judgement::line;
                        trials.push_back(trial);
                    }
                }
            }
        }
    }
    return trials;
}

LawFitOptions options(int replicates, SlopeMethod method = LawFitOptions{}.method) {
    return {.method = method, .bootstrap = {.replicates = replicates, .seed = 1, .jobs = kJobs}};
}

void print(const std::string& what, double value, double bar, const char* unit, double processor_s) {
    std::printf("%-58s %9.2f %-4s  <= %-6g %-4s", what.c_str(), value, unit, bar, value <= bar ? "pass" : "miss");
    if (processor_s > 0) std::printf("   %.2f s of processor", processor_s);
    std::printf("\n");
    std::fflush(stdout);
}

template <typename Work>
void measure(const std::string& what, double bar_s, int rounds, const Work& work) {
    std::vector<double> wall_s, processor_s;
    for (int round = 0; round < rounds; ++round) {
        double wall = 0;
        processor_s.push_back(processor_seconds([&] { wall = seconds(work); }));
        wall_s.push_back(wall);
    }
    print(what, median(wall_s), bar_s, "s", median(processor_s));
}

/// Peak resident memory of a process that does the work and nothing else, MiB.
template <typename Work>
double peak_mib(const Work& work) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    return usage.ru_maxrss / 1024.0;
}

}  // namespace
}  // namespace stairstep

int main() {
    using namespace stairstep;
    std::printf("fits on %d threads, medians of %d rounds\n", kJobs, kRounds);
    // Memory first, in processes that start small.
    const auto memory = [](int observers, int trials_a_track, int replicates) {
        return peak_mib([&] { fit_law(trials_of(observers, trials_a_track), 0.82, "made", options(replicates)); });
    };
    const double few = memory(20, 60, 200);
    const double many = memory(20, 60, 2000);
    const double long_study = memory(20, 600, 200);
    {
        const std::vector<Trial> study = trials_of(20, 60);
        measure("20 observers x 16 tracks x 60 trials, no bootstrap", 1, kRounds,
                [&] { fit_law(study, 0.82, "made", options(0)); });
        measure("the same, with 2,000 studies by each usual bootstrap", 30, 3,
                [&] { fit_law(study, 0.82, "made", options(2000)); });
        measure("the same, every threshold simulated as well", 30, 3,
                [&] { fit_law(study, 0.82, "made", options(2000, SlopeMethod::thresholds)); });
    }
    const std::vector<Trial> million = trials_of(20, 3125);
    measure("1,000,000 trials that all differ, in 320 tracks", 20, 1,
            [&] { fit_law(million, 0.82, "made", options(0)); });
    std::printf("peak memory: %.1f MiB at 200 replicates, %.1f MiB at 2,000; %.1f MiB at ten times the trials\n", few,
                many, long_study);
    print("growth with ten times the replicates", many / few, 1.1, "x", 0);
    return 0;
}
