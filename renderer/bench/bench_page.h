// The bench as a page: a figure, the bars, pictures and the table of each scene. It needs the files beside it and no network.
#pragma once

#include <string>
#include <vector>

#include "renderer/bench/bench_csv.h"

namespace stairstep::bench {

/// A picture beside the page.
struct Picture {
    std::string file;
    std::string caption;
};

/// What the page has of a scene besides its measurements.
struct SceneFiles {
    std::string figure;
    std::vector<Picture> pictures;
};

/// `files` are those of `scenes`, in their order.
std::string bench_page(const std::vector<SceneMeasurements>& scenes, const std::vector<SceneFiles>& files,
                       const Setting& setting);

/// What dominates the law's own configurations that aren't on their frontier, a sentence each.
std::vector<std::string> dominated_by_law(const std::vector<Measurement>& measurements);

}  // namespace stairstep::bench
