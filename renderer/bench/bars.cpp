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
    return bars;
}

}  // namespace stairstep::bench
