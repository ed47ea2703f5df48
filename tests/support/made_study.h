// A small study with everything that a study may contain: people under the names they typed, one observer with two
// sessions, practice, catch and void trials, sessions that are finished, aborted and open, and one that shows nothing yet.
#pragma once

#include <filesystem>
#include <vector>

#include "study/design.h"
#include "study/store.h"

namespace stairstep {

struct MadeStudy {
    Design design;
    /// 1 Anna Meier, finished · 2 sub-07, aborted · 3 Anna Meier, open · 4 sim01, simulated, finished · 5 Öz, no trial.
    std::vector<SessionRecord> sessions;
    std::vector<Trial> trials;
};

MadeStudy made_study();

/// Its database.
void write_study(const std::filesystem::path& path, const MadeStudy& study);

}  // namespace stairstep
