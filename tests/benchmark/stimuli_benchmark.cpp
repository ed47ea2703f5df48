// Computing a stimulus against encoding it: 640 × 480 px, one thread each. The counter `encode/compute` is the ratio of
// the two times' medians in this run; `levels` is luminance and rounding to 8 bits, which is what a PNG needs.
// Then what a wider filter costs (radius_cost.h).
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>

#include <string>

#include "stimuli/draw.h"
#include "tests/benchmark/radius_cost.h"
#include "tests/benchmark/stopwatch.h"

namespace stairstep {
namespace {

/// Of computing and encoding in turns.
constexpr int kRounds = 31;

size_t encode(const Stimulus& stimulus, const std::vector<uint8_t>& levels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto writer = OIIO::ImageOutput::create("png");
    writer->set_ioproxy(&memory);
    OIIO::ImageSpec spec(stimulus.width_px, stimulus.height_px, 1, OIIO::TypeDesc::UINT8);
    writer->open("stimulus.png", spec);
    writer->write_image(OIIO::TypeDesc::UINT8, levels.data());
    writer->close();
    return bytes.size();
}

void compute_against_encode(benchmark::State& state, const Stimulus& stimulus) {
    std::vector<double> computing;
    std::vector<double> encoding;
    std::vector<uint8_t> levels;
    for ([[maybe_unused]] auto iteration : state) {
        computing.push_back(seconds([&] { levels = draw<uint8_t>(stimulus, level_8bit, std::move(levels)); }));
        encoding.push_back(seconds([&] { benchmark::DoNotOptimize(encode(stimulus, levels)); }));
        state.SetIterationTime(computing.back());
    }
    state.counters["encode/compute"] = median(encoding) / median(computing);
}

void register_all() {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) {
        for (const Pattern pattern : {Pattern::step, Pattern::stair, Pattern::line}) {
            for (const Pattern silhouette : {Pattern::step, Pattern::stair}) {
                if (pattern != Pattern::line && pattern != silhouette) continue;
                for (const double texel : {5.0, 30.0}) {
                    for (const double radius : {texel, 3.47 * texel, 105.0}) {
                        const Stimulus stimulus{
                            .pattern = pattern, .silhouette = silhouette, .texel_px = texel, .kernel = {shape, radius}};
                        benchmark::RegisterBenchmark(("levels/" + file_stem(stimulus)).c_str(), compute_against_encode,
                                                     stimulus)
                            ->UseManualTime()
                            ->Iterations(kRounds)
                            ->Unit(benchmark::kMillisecond);
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    stairstep::register_all();
    stairstep::register_radius_cost();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    stairstep::print_radius_exponents();
    return 0;
}
