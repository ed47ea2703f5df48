// trials.csv: one row a trial, long form. Written for others to read, and read back by column name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/trial.h"

namespace stairstep {

/// The table with all columns:
/// study, observer, session, round, track, trial, pattern, kernel, contrast, texel_px, suggested_radius_px, radius_px,
/// stimulus, response, correct, response_time_s, shown_at (ISO 8601, UTC), dropped_frames, presentation, kind, task, void.
std::string trials_csv(const std::vector<Trial>& trials);

/// Reads trials from a CSV that has at least observer, pattern, kernel, contrast, texel_px, radius_px, stimulus and
/// response; study, session, presentation, round, track, trial, kind, task, void, suggested_radius_px and response_time_s are
/// taken where they are there, and other columns ignored. Without them a track is one observer × condition, in the file's order.
/// Throws InputError naming file, line and column for what can't be a trial, a length outside the range of a normal float, a name
/// that is not UTF-8, and for a file without any.
std::vector<Trial> read_trials_csv(const std::filesystem::path& path);

}  // namespace stairstep
