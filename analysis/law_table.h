// A fitted law as tables for people to read on a terminal.
#pragma once

#include <string>
#include <vector>

#include "analysis/law/law_file.h"

namespace stairstep {

/// Conditions, comparisons, what moves the law most, the law itself, and criteria where there are several.
std::string law_table(const Law& law);

/// Cells in columns as wide as their widest, two spaces apart, each row a line.
std::string aligned_rows(const std::vector<std::vector<std::string>>& rows);

/// A p value for people: .0123 as "0.0123", below a ten-thousandth as "< 0.0001".
std::string p_text(double p);

}  // namespace stairstep
