// A whole batch against encoding its images alone: the grid of Kreuzer (2017) with its contrasts, 640 × 480 px, as PNG of
// 8 bits, both on two threads. The bar: computing, naming and listing the images may cost a quarter of encoding them.
//
// What is compared runs in turns within one program, and the median of the rounds' ratios of wall time is what counts. On a
// machine that others use the ratio of processor times, all threads together, is the steadier one.
#include <cstdio>
#include <filesystem>
#include <string>

#include "stimuli/grid.h"
#include "stimuli/io/batch.h"
#include "stimuli/io/image_encoding.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "stimuli/parallel.h"
#include "tests/benchmark/stopwatch.h"

namespace stairstep {
namespace {

constexpr int kJobs = 2;
constexpr int kRounds = 7;
constexpr double kBar = 1.25;

struct Cost {
    double wall_s = 0;
    double processor_s = 0;
};

template <typename Work>
Cost cost_of(const Work& work) {
    Cost cost;
    cost.processor_s = processor_seconds([&] { cost.wall_s = seconds(work); });
    return cost;
}

Cost batch_cost(const std::vector<Stimulus>& stimuli) {
    const TemporaryFolder folder;
    Batch batch;
    batch.folder = folder.path();
    batch.jobs = kJobs;
    return cost_of([&] { write_batch(stimuli, batch, luminance); });
}

Cost encoding_cost(const std::vector<StoredImage>& images) {
    const TemporaryFolder folder;
    return cost_of([&] {
        run_in_parallel(images.size(), kJobs, [&](size_t i) {
            write_stored_image(folder.path() / (std::to_string(i) + ".png"), images[i], "of a benchmark");
        });
    });
}

void measure(KernelShape shape) {
    StimulusGrid grid;  // its defaults are the study's
    grid.kernels = {shape};
    const std::vector<Stimulus> stimuli = stimuli_of(grid);
    std::vector<StoredImage> images(stimuli.size());
    run_in_parallel(stimuli.size(), kJobs, [&](size_t i) { images[i] = encode_exact(stimuli[i], {}); });

    std::vector<double> batch_s;
    std::vector<double> encoding_s;
    std::vector<double> ratios;
    std::vector<double> processor_ratios;
    for (int round = 0; round < kRounds; ++round) {
        // Each goes first in every other round: what slows the machine for a while slows both.
        Cost batch;
        if (round % 2 == 0) batch = batch_cost(stimuli);
        const Cost encoding = encoding_cost(images);
        if (round % 2 == 1) batch = batch_cost(stimuli);
        batch_s.push_back(batch.wall_s);
        encoding_s.push_back(encoding.wall_s);
        ratios.push_back(batch.wall_s / encoding.wall_s);
        processor_ratios.push_back(batch.processor_s / encoding.processor_s);
    }
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    std::printf("%-9s %6zu %9.3f %11.3f %7.3f  %.3f to %.3f %10.3f   %.2f  %s\n", std::string(name(shape)).c_str(),
                stimuli.size(), median(batch_s), median(encoding_s), median(ratios), *least, *most,
                median(processor_ratios), kBar, median(ratios) <= kBar ? "pass" : "miss");
}

}  // namespace
}  // namespace stairstep

int main() {
    using namespace stairstep;
    std::printf("a batch at %d jobs against encoding its images alone at %d threads, medians of %d rounds\n", kJobs,
                kJobs, kRounds);
    std::printf("kernel    images   batch s  encoding s   ratio           range  processor    bar\n");
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) measure(shape);
    return 0;
}
