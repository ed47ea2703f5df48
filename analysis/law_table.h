// A fitted law as tables for people to read on a terminal.
#pragma once

#include <string>

#include "analysis/law/law_file.h"

namespace stairstep {

/// Conditions, comparisons, what moves the law most, the law itself, and criteria where there are several.
std::string law_table(const Law& law);

}  // namespace stairstep
