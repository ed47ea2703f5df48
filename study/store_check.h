// Verifies a study's database: that it is whole, and that its trials are those that its design and seeds bring forth.
//
// Each trial is derived again from the answers before it (resumed_session), so that a change to any number that decides what
// comes next shows, down to a single answer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stairstep {

struct StoreReport {
    /// The version of the schema in the file.
    int schema = 0;
    std::string study;
    size_t sessions = 0;
    size_t trials = 0;
    /// Sessions that an older version recorded: checked in all but what their design would have shown.
    std::vector<int> not_replayed;
    /// One sentence each, with the place; none where all is well.
    std::vector<std::string> problems;
};

/// SQLite's integrity and foreign keys, the schema with its append-only triggers, the design, and of each session: its
/// presentations gapless, times not going backwards, radii within what the design's display shows, response times above 0,
/// trials as planned, and an end only where nothing is left to show. Changes nothing.
/// Throws InputError for what isn't a study's database of a version that can be read; damage to one is a problem found.
StoreReport check_store(const std::filesystem::path& path);

}  // namespace stairstep
