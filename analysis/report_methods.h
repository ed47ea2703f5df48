// A description of the study and its analysis in the words and with the numbers that a paper needs, to paste and to edit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/law_fit.h"
#include "analysis/study_check.h"
#include "study/design.h"

namespace stairstep {

/// What is known of the study beside its trials; a table of trials tells none of it.
struct StudyBackground {
    std::optional<Design> design{};
    /// "simulated", "person", "person and simulated", or empty.
    std::string observer_kind{};
    /// One a session.
    std::vector<uint64_t> seeds{};
    /// Trials that were shown but are no evidence.
    int practice_trials = 0;
    int catch_trials = 0;
    int void_trials = 0;
};

/// Paragraphs: design, observers, exclusions, analysis, checks, software. Plain text, one line a paragraph.
/// Throws FailureError where gnuplot, whose version it names, is missing.
std::vector<std::string> methods_paragraphs(const StudyBackground& background, const std::vector<Trial>& trials,
                                            const LawFit& fit, const StudyCheck& check);

}  // namespace stairstep
