// study.sqlite: the trials of a study, append-only and durable one by one.
//
// WAL with synchronous FULL: when `append` returns, the trial is on the disk. Triggers refuse changes to what was
// recorded. The design, all seeds and the version of the program stand beside the trials, so that a session can be
// replayed. One process writes a session at a time; several may write sessions of one database.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/schema.h"
#include "study/trial.h"
#include "study/writer_lock.h"

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
    /// The version of the schema that it was recorded in. What came before this one can be read but not replayed.
    int schema = kSchemaVersion;
};

/// All members throw InputError for a file that is missing, damaged, no Stairstep study or of a newer schema, and
/// FailureError where the disk won't take more.
class TrialStore {
  public:
    /// A new database, to write; the path ":memory:" makes one that is kept nowhere. `plan_json` says who takes part, where
    /// that is known beforehand. Throws InputError where something of that name exists: a study is never overwritten.
    static TrialStore create(const std::filesystem::path& path, const std::string& study,
                             const std::string& design_json, const std::string& plan_json = "{}");

    /// An existing one, to read; nothing can be recorded through it, and nothing is changed. Also for databases of an older
    /// schema, and for files and folders that can't be written.
    static TrialStore open(const std::filesystem::path& path);

    /// An existing one, to go on with sessions or begin others. A database of an older schema is brought to this one.
    static TrialStore open_to_write(const std::filesystem::path& path);

    /// Starts a session and holds it; its `session` number is assigned and returned.
    int begin_session(const SessionRecord& session);

    /// Makes this the one process that writes a session, until the session ends or the store goes. To be called before what
    /// was recorded is read for going on. Throws FailureError where another process writes it, naming that, and InputError
    /// for a session that doesn't exist or has ended.
    void hold_session(int session);

    /// Records a trial of a session that has begun, and holds that. Durable on return. After a FailureError (a full disk)
    /// nothing of the trial is recorded, and recording can go on once there is room.
    void append(const Trial& trial);

    /// Marks a recorded trial as taken back. Durable on return.
    void mark_void(int session, int presentation);

    /// Nothing more will be recorded in a session.
    void end_session(int session, SessionEnd end);

    std::string study() const;
    std::string design_json() const;
    std::string plan_json() const;
    std::vector<SessionRecord> sessions() const;
    /// All trials in the order in which they were recorded, void ones included.
    std::vector<Trial> trials() const;
    /// Those of one session.
    std::vector<Trial> trials(int session) const;

  private:
    TrialStore(const std::filesystem::path& path, SQLite::Database database, bool may_write);

    template <typename Action>
    auto guarded(const Action& action) const;

    std::string study_field(const std::string& column) const;
    std::vector<Trial> trials_where(const std::string& condition) const;

    std::filesystem::path path_;
    /// The locks of the sessions that are held; none for a database in memory.
    std::map<int, std::optional<WriterLock>> held_;
    bool may_write_;
    SQLite::Database database_;
    /// Prepared once; after the database, which must outlive it.
    std::unique_ptr<SQLite::Statement> append_;
};

}  // namespace stairstep
