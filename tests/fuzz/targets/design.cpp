#include <cmath>
#include <nlohmann/json.hpp>

#include "study/design_json.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {

void run_design(std::string_view input) {
    Design design;
    if (!accepted([&] { design = design_from_json(std::string(input), "design.json"); })) return;
    const size_t conditions = design.patterns.size() * design.contrasts.size() * design.texels_px.size();
    require(conditions >= 1 && conditions <= 20'000, "a design has 1 to 20,000 conditions");
    size_t tracks = 0;
    for (const Round& round : rounds_for(design, 1)) tracks += round.tracks.size();
    require(tracks == conditions, "each condition has one track");
    require(!design.viewing || std::isfinite(design.viewing->pixels_per_degree()), "the geometry is finite");
    const std::string written = to_json(design).dump();
    require(to_json(design_from_json(written, "again")).dump() == written, "a design reads back as it was written");
}

}  // namespace stairstep::fuzz
