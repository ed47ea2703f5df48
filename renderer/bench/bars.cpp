#include "renderer/bench/bars.h"

#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

std::string against(double value, double other, int decimals) {
    return format_fixed(value, decimals) + " against " + format_fixed(other, decimals);
}

void add_wobble(std::vector<Bar>& bars, const std::string& what, const Measurement& sized, const Measurement& fixed) {
    if (!sized.wobble || !fixed.wobble) return;
    const std::string figures = "wobble " + against(sized.wobble->mean(), fixed.wobble->mean(), 5) + " (light " +
                                against(sized.wobble->light, fixed.wobble->light, 5) + ", caster " +
                                against(sized.wobble->caster, fixed.wobble->caster, 5) + ", camera " +
                                against(sized.wobble->camera, fixed.wobble->camera, 5) + ")";
    bars.push_back({what, sized.wobble->mean() <= fixed.wobble->mean(), figures});
}

/// Against the fixed map as common practice draws it.
void add_speed(std::vector<Bar>& bars, const std::vector<Measurement>& measurements, const Measurement& sized,
               Configuration fixed, double times) {
    fixed.no_skip = "all";
    const Measurement* whole = find(measurements, fixed);
    if (!whole) return;
    const double faster = steady_ms(measurements, *whole) / steady_ms(measurements, sized);
    bars.push_back(
        {label(sized.configuration) + " at least " + format_fixed(times, 0) + " times as fast as " + label(fixed),
         faster >= times, format_fixed(faster, 1) + " times"});
}

void add_floor(std::vector<Bar>& bars, const std::vector<Measurement>& measurements, const Measurement& sized) {
    const Measurement* hard = find(measurements, auto_hard());
    if (!hard) return;
    const double ratio = steady_ms(measurements, sized) / steady_ms(measurements, *hard);
    bars.push_back({label(sized.configuration) + " in at most 1.3 of the time of hard shadows of the same size",
                    ratio <= kFloorBar, "time x " + format_fixed(ratio, 2)});
}

void add_still(std::vector<Bar>& bars, const std::vector<Measurement>& measurements, Configuration still) {
    still.no_skip = "";
    const Measurement* one = find(measurements, still);
    const Measurement* hard = find(measurements, auto_hard());
    const Measurement* none = find(measurements, without_shadows());
    if (!one || !hard || !none) return;
    // The lookup: what hard shadows' lighting takes beyond none.
    const double floor =
        steady_ms(measurements, *none) * (1 + (hard->lighting.cpu_ms - none->lighting.cpu_ms) / none->frame.cpu_ms);
    const double ratio = steady_ms(measurements, *one) / floor;
    bars.push_back({label(still) + ", in no more than without shadows and a hard lookup", ratio <= 1,
                    "time x " + format_fixed(ratio, 2)});
}

}  // namespace

std::vector<Bar> bars_of(const std::vector<Measurement>& measurements) {
    std::vector<Bar> bars;
    const Measurement* pcf = find(measurements, auto_pcf());
    const Measurement* pcf_fixed = find(measurements, fixed_pcf());
    const Measurement* pcss = find(measurements, auto_pcss());
    const Measurement* pcss_fixed = find(measurements, fixed_pcss());
    if (pcf && pcf_fixed) {
        const bool met = pcf->time_ratio <= kPcfTimeBar && pcf->error.penumbra_rmse < pcf_fixed->error.penumbra_rmse;
        bars.push_back(
            {"auto pcf-exact in at most 0.4 of the time of 25 rotated taps over 4096 x 4096, at a lower "
             "penumbra error",
             met,
             "time x " + format_fixed(pcf->time_ratio, 2) + ", penumbra error " +
                 against(pcf->error.penumbra_rmse, pcf_fixed->error.penumbra_rmse, 4)});
    }
    if (pcss && pcss_fixed) {
        const bool met =
            pcss->time_ratio <= kPcssTimeBar && pcss->error.penumbra_rmse <= pcss_fixed->error.penumbra_rmse;
        bars.push_back(
            {"auto pcss-levels in at most 0.5 of the time of pcss with 25+25 taps over 4096 x 4096, at no "
             "higher penumbra error",
             met,
             "time x " + format_fixed(pcss->time_ratio, 2) + ", penumbra error " +
                 against(pcss->error.penumbra_rmse, pcss_fixed->error.penumbra_rmse, 4) + " (over all pixels " +
                 against(pcss->error.rmse, pcss_fixed->error.rmse, 4) + ")"});
    }
    if (pcf && pcf_fixed) {
        add_wobble(bars, "auto pcf-exact wobbles no more than 25 rotated taps over 4096 x 4096", *pcf, *pcf_fixed);
    }
    if (pcss && pcss_fixed) {
        add_wobble(bars, "auto pcss-levels wobbles no more than pcss over 4096 x 4096", *pcss, *pcss_fixed);
    }
    if (pcf) {
        add_speed(bars, measurements, *pcf, fixed_pcf(), kPcfSpeedBar);
        add_floor(bars, measurements, *pcf);
        add_still(bars, measurements, auto_pcf());
    }
    if (pcss) {
        add_speed(bars, measurements, *pcss, fixed_pcss(), kPcssSpeedBar);
        add_still(bars, measurements, auto_pcss());
    }
    return bars;
}

}  // namespace stairstep::bench
