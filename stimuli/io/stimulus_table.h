// Stimuli as rows of a table: the columns that describe one, written and read by the same list.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stimuli/io/csv.h"
#include "stimuli/stimulus.h"

namespace stairstep {

/// A column's name and a row's text in it.
using Field = std::pair<std::string, std::string>;

/// Everything that tells a stimulus: pattern, kernel, contrast, texel_px, radius_px, width_px, height_px, silhouette,
/// step_reference, in this order.
std::vector<Field> fields_of(const Stimulus& stimulus);

/// The stimulus of a row. The first five columns are required; what another column would say comes from `defaults`
/// where it is missing, the silhouette of an artifact from its pattern. Throws InputError naming the row's line.
Stimulus stimulus_at(const CsvTable& table, size_t row, const Stimulus& defaults = {});

/// A grid file: one row a stimulus, columns as above in any order. Throws InputError for a column that is none of them,
/// a row that is no stimulus, or no row at all.
std::vector<Stimulus> read_grid(const std::filesystem::path& path, const Stimulus& defaults);

}  // namespace stairstep
