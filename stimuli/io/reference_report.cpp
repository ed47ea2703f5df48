#include "stimuli/io/reference_report.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "stimuli/io/csv.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

std::string number_or_nothing(const std::optional<double>& value) {
    return value ? format_number(*value) : "";
}

std::string title_of(const Stimulus& artifact) {
    std::string title(name(artifact.pattern));
    if (artifact.pattern == Pattern::slope) title += " " + format_number(artifact.slope);
    return title;
}

/// Colours that differ for every kind of colour vision (Okabe & Ito 2008).
const char* colour(size_t i) {
    constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
    return kColours[i % std::size(kColours)];
}

}  // namespace

std::vector<ReferenceSizes> reference_sizes(const std::vector<Stimulus>& artifacts, double largest_radius_px,
                                            int jobs) {
    std::vector<ReferenceSizes> sizes(artifacts.size());
    Progress progress("searching radii", static_cast<long>(artifacts.size()));
    run_in_parallel(artifacts.size(), jobs, [&](size_t i) {
        const auto radius = [&](Likeness likeness) {
            return reference_radius(artifacts[i], likeness, largest_radius_px);
        };
        sizes[i] = {artifacts[i], radius(Likeness::one_level), radius(Likeness::half_level),
                    radius(Likeness::identical)};
        progress.advance();
    });
    return sizes;
}

std::string reference_csv(const std::vector<ReferenceSizes>& sizes, double largest_radius_px) {
    CsvWriter csv;
    csv.row({"pattern", "slope", "kernel", "contrast", "texel_px", "width_px", "height_px", "step_reference",
             "largest_radius_px", "one_level_px", "half_level_px", "identical_px"});
    for (const ReferenceSizes& s : sizes) {
        const Stimulus& a = s.artifact;
        csv.row({std::string(name(a.pattern)), format_number(a.slope), std::string(name(a.kernel.shape)),
                 format_number(a.contrast), format_number(a.texel_px), std::to_string(a.width_px),
                 std::to_string(a.height_px), std::string(name(a.step_reference)), format_number(largest_radius_px),
                 number_or_nothing(s.one_level), number_or_nothing(s.half_level), number_or_nothing(s.identical)});
    }
    return csv.text();
}

std::string reference_figure(const std::vector<ReferenceSizes>& sizes, const std::vector<StudyLaw>& laws) {
    double largest_texel = 0;
    double largest_radius = 0;
    std::set<std::pair<KernelShape, double>> panels;
    for (const ReferenceSizes& s : sizes) {
        largest_texel = std::max(largest_texel, s.artifact.texel_px);
        largest_radius = std::max(largest_radius, s.one_level.value_or(0));
        panels.emplace(s.artifact.kernel.shape, -s.artifact.contrast);
    }
    for (const StudyLaw& law : laws) largest_radius = std::max(largest_radius, law.slope * largest_texel);

    std::ostringstream script;
    script << "set key top left reverse Left samplen 2 spacing 1.1\n"
           << "set multiplot layout " << (panels.size() + 1) / 2 << "," << std::min<size_t>(panels.size(), 2)
           << "\nset xlabel 'texel size a on screen, px'\nset ylabel 'filter radius r, px'\nset xrange [0:"
           << largest_texel * 1.08 << "]\nset yrange [0:" << std::max(largest_radius, 1.0) * 1.15 << "]\n";
    for (const auto& [kernel, negative_contrast] : panels) {
        const double contrast = -negative_contrast;
        script << "set title '" << name(kernel) << ", contrast " << format_number(100 * contrast) << " %'\n";
        // In the order of the grid: a curve a pattern and slope.
        std::map<std::string, std::string> rows;
        std::vector<std::string> titles;
        for (const ReferenceSizes& s : sizes) {
            if (s.artifact.kernel.shape != kernel || s.artifact.contrast != contrast) continue;
            const std::string title = title_of(s.artifact);
            if (!rows.contains(title)) titles.push_back(title);
            rows[title] +=
                format_number(s.artifact.texel_px) + " " + (s.one_level ? format_number(*s.one_level) : "NaN") + "\n";
        }
        std::string plot;
        for (size_t i = 0; i < titles.size(); ++i) {
            script << "$curve" << i << " << EOD\n" << rows[titles[i]] << "EOD\n";
            const std::string rgb = std::string(" lc rgb '") + colour(i) + "' ";
            plot += (plot.empty() ? "plot " : ", ") + ("$curve" + std::to_string(i)) +
                    " u 1:2 w lp pt 7 ps 0.7 lw 1.5" + rgb + "title '" + titles[i] + ": within 1 level'";
            for (const StudyLaw& law : laws) {
                if (law.kernel != kernel || law.contrast != contrast || name(law.pattern) != titles[i]) continue;
                plot += ", " + format_number(law.slope) + "*x w l dt 2 lw 1.5" + rgb + "title '" + titles[i] +
                        ": people, r = " + format_fixed(law.slope, 2) + " a'";
            }
        }
        script << plot << "\n";
    }
    script << "unset multiplot\n";
    return draw_svg(script.str(), panels.size() > 1 ? 960 : 520, 400 * static_cast<int>((panels.size() + 1) / 2));
}

}  // namespace stairstep
