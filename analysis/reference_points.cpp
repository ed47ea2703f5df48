#include "analysis/reference_points.h"

#include <set>

#include "stimuli/parallel.h"
#include "stimuli/reference.h"

namespace stairstep {

std::vector<ReferencePoint> reference_points(const LawFit& fit, const PictureSize& picture, int jobs) {
    std::vector<ReferencePoint> points;
    for (const ConditionLaw& law : fit.law.conditions) {
        std::set<double> texels;
        for (const Threshold& t : fit.thresholds) {
            const Condition& c = t.condition;
            if (c.pattern == law.pattern && c.contrast == law.contrast && c.kernel == law.kernel) {
                texels.insert(c.texel_px);
            }
        }
        for (const double a : texels) points.push_back({{law.pattern, law.contrast, law.kernel}, a, std::nullopt});
    }
    run_in_parallel(points.size(), jobs, [&](size_t i) {
        Stimulus artifact;
        artifact.pattern = artifact.silhouette = points[i].condition.pattern;
        artifact.texel_px = points[i].texel_px;
        artifact.kernel.shape = points[i].condition.kernel;
        artifact.contrast = points[i].condition.contrast;
        artifact.width_px = picture.width_px;
        artifact.height_px = picture.height_px;
        points[i].radius_px = reference_radius(artifact, Likeness::one_level, kLargestReferenceRadius);
    });
    return points;
}

}  // namespace stairstep
