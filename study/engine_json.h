// An engine's settings as the object "engine" of a design file: its name, then its own keys.
//
//   quest             guess_sd p_threshold beta gamma delta grain range placement quantile_order prior
//   minimum-entropy   guess_sd p_threshold beta gamma delta grain range
//   psi-marginal      guess_sd p_threshold grain range; beta, delta and gamma as [low, high], each with …_count; …
//   staircase         start down_after up_over_down steps averaged_reversals, and quest's for its posterior
//   constant-stimuli  levels, and quest's for its posterior
//   law-directed      guess_sd p_threshold gamma betas deltas deviation_sd grain range longest_lead
//
// The prior's middle isn't among them: a design states it as guess_radius_texels.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "stimuli/io/json_object.h"
#include "study/engines/round_engine.h"

namespace stairstep {

/// Appends the engine's name and settings to an object.
void add_engine(nlohmann::ordered_json& object, const EngineSettings& settings);

/// Reads what `add_engine` writes; keys that are missing leave the default of the engine named, or of the one in `settings`.
/// Throws InputError for a name or value that isn't known.
void read_engine(JsonObject& object, EngineSettings& settings);

}  // namespace stairstep
