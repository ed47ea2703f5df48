// study.sqlite: the trials of a study, append-only and durable one by one.
//
// WAL with synchronous FULL: when `append` returns, the trial is on the disk. Triggers refuse changes to what was
// recorded. The design, all seeds and the version of the program stand beside the trials, so that a session can be
// replayed.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/trial.h"

namespace stairstep {

/// How a session ended.
enum class SessionEnd { finished, aborted };

/// A session as stored.
struct SessionRecord {
    /// From 1.
    int session = 1;
    std::string observer;
    /// From 0; decides the order of the rounds.
    int observer_index = 0;
    uint64_t seed = 0;
    /// "simulated" or "person", and what else it takes to replay it, as JSON.
    std::string observer_kind;
    std::string observer_settings;
    /// Empty while the session can go on.
    std::optional<SessionEnd> end;
};

/// All members throw InputError for a file that is missing, damaged, no Stairstep study or of a newer schema, and
/// FailureError where the disk won't take more.
class TrialStore {
  public:
    /// A new database. Throws InputError where something of that name exists: a study is never overwritten.
    static TrialStore create(const std::filesystem::path& path, const std::string& study,
                             const std::string& design_json);

    /// An existing one, to read; nothing can be recorded through it.
    static TrialStore open(const std::filesystem::path& path);

    /// Starts a session; its `session` number is assigned and returned.
    int begin_session(const SessionRecord& session);

    /// Records a trial of a session that has begun. Durable on return.
    void append(const Trial& trial);

    /// Marks a recorded trial as taken back. Durable on return.
    void mark_void(int session, int presentation);

    /// Nothing more will be recorded in a session.
    void end_session(int session, SessionEnd end);

    std::string study() const;
    std::string design_json() const;
    std::vector<SessionRecord> sessions() const;
    /// All trials in the order in which they were recorded, void ones included.
    std::vector<Trial> trials() const;

  private:
    TrialStore(const std::filesystem::path& path, int flags);

    template <typename Action>
    auto guarded(const Action& action) const;

    std::filesystem::path path_;
    SQLite::Database database_;
    /// Prepared once; after the database, which must outlive it.
    std::unique_ptr<SQLite::Statement> append_;
};

}  // namespace stairstep
