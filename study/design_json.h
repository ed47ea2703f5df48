// A design as the small JSON file that people edit. Every key may be left out: the thesis's design stands in for it.
//
//   {"name": "pilot", "patterns": ["step"], "contrasts": [1, 0.5], "texels_px": [5, 10, 20], "kernel": "box",
//    "task": {"name": "yes-no", "line_share": 0.5},
//    "engine": {"name": "quest", "guess_radius_texels": 3, "beta": 3.5},
//    "stop": {"most_trials": 40}, "practice_trials": 8, "catch_share": 0.05, "break_every_trials": 100,
//    "viewing": {"distance_mm": 600, "pixel_pitch_mm": 0.25}}
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/design.h"

namespace stairstep {

/// All of it, defaults included: what a study stores.
nlohmann::ordered_json to_json(const Design& design);

/// Throws InputError, naming source and key, for a key that isn't known, a value of another kind, and what `require_valid`
/// refuses.
Design design_from_json(const std::string& text, const std::string& source);

/// Throws as `design_from_json`, and for a file that can't be read.
Design read_design(const std::filesystem::path& path);

}  // namespace stairstep
