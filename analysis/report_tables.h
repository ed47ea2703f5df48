// The report's tables, as HTML.
#pragma once

#include <string>
#include <vector>

#include "analysis/influence_figure.h"
#include "analysis/law/law_file.h"
#include "analysis/residual_figure.h"
#include "analysis/study_check.h"

namespace stairstep {

/// A row a condition: c, its interval, τ, intercept, exponent, observers, trials.
std::string law_html(const Law& law);

/// Paired comparisons; "" where there are none.
std::string comparisons_html(const Law& law);

/// N = ⌈c·L/r⌉ for Law::criteria at common extents L and radii r, in one unit; "" without criteria.
std::string budget_html(const Law& law);

/// A row a condition: the slope by default, by the linear model in pixels and by other estimates beside it, and by the robust fit,
/// with what that one trusts less. `robust` has the same conditions, or lacks some.
std::string estimates_html(const Law& law, const Law& robust);

/// A row an observer: share right, d′ and criterion with intervals, lapses, goodness of fit.
std::string observers_html(const StudyCheck& check);

/// A row a condition: steepness, lapses, p values, scatter of thresholds, overdispersion.
std::string conditions_html(const StudyCheck& check);

/// Sentences that name the influences that are flagged and the residuals that are large, or say that there are none.
std::string influence_sentence(const std::vector<Influence>& influences);
std::string residual_sentence(const std::vector<ResidualGroup>& groups);

}  // namespace stairstep
