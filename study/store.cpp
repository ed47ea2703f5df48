#include "study/store.h"

#include <limits>

#include "stimuli/error.h"
#include "study/database_file.h"

namespace stairstep {
namespace {

std::optional<Pattern> pattern_named(const std::string& text) {
    for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
        if (name(pattern) == text) return pattern;
    }
    return std::nullopt;
}

/// A session number as a lock's name.
std::string lock_name(int session) {
    return "session-" + std::to_string(session);
}

/// A whole number as the program holds them; SQLite's are wider.
int count_in(const SQLite::Column& column, const std::filesystem::path& path) {
    const int64_t value = column.getInt64();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
        throw InputError(path.string(),
                         std::string(column.getName()) + " " + std::to_string(value) + " is out of range",
                         "restore it from a copy");
    }
    return static_cast<int>(value);
}

}  // namespace

/// Runs an action on the database and turns SQLite's exceptions into ours.
template <typename Action>
auto TrialStore::guarded(const Action& action) const {
    try {
        return action();
    } catch (const SQLite::Exception& e) {
        rethrow(path_, e);
    }
}

TrialStore::TrialStore(const std::filesystem::path& path, SQLite::Database database, bool may_write)
    : path_(path), may_write_(may_write), database_(std::move(database)) {}

TrialStore TrialStore::create(const std::filesystem::path& path, const std::string& study,
                              const std::string& design_json, const std::string& plan_json) {
    return {path,
            make_database(path,
                          [&](SQLite::Database& database) {
                              SQLite::Statement insert(
                                  database, "INSERT INTO study (name, design, plan, program) VALUES (?, ?, ?, ?)");
                              insert.bind(1, study);
                              insert.bind(2, design_json);
                              insert.bind(3, plan_json);
                              insert.bind(4, STAIRSTEP_VERSION);
                              insert.exec();
                          }),
            true};
}

TrialStore TrialStore::open(const std::filesystem::path& path) {
    return {path, open_database_to_read(path), false};
}

TrialStore TrialStore::open_to_write(const std::filesystem::path& path) {
    TrialStore store(path, open_database_to_write(path), true);
    WriterLock::tidy_up(path);
    return store;
}

int TrialStore::begin_session(const SessionRecord& session) {
    return guarded([&] {
        SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement insert(database_,
                                 "INSERT INTO session (observer, observer_index, seed, observer_kind, "
                                 "observer_settings, schema) VALUES (?, ?, ?, ?, ?, ?)");
        insert.bind(1, session.observer);
        insert.bind(2, session.observer_index);
        insert.bind(3, static_cast<int64_t>(session.seed));
        insert.bind(4, session.observer_kind);
        insert.bind(5, session.observer_settings);
        insert.bind(6, kSchemaVersion);
        insert.exec();
        const int number = static_cast<int>(database_.getLastInsertRowid());
        // Before anybody else can know of it.
        std::optional<WriterLock> lock;
        if (!is_in_memory(path_)) lock.emplace(path_, lock_name(number));
        transaction.commit();
        held_.emplace(number, std::move(lock));
        return number;
    });
}

void TrialStore::hold_session(int session) {
    if (held_.contains(session)) return;
    if (!may_write_) throw FailureError(path_.string(), "is open to read only", "open it to write");
    guarded([&] {
        std::optional<WriterLock> lock;
        if (!is_in_memory(path_)) lock.emplace(path_, lock_name(session));
        SQLite::Statement query(database_,
                                "SELECT outcome FROM session LEFT JOIN session_end USING (session) WHERE session = ?");
        query.bind(1, session);
        const std::string subject = path_.string() + ": session " + std::to_string(session);
        if (!query.executeStep()) throw InputError(subject, "never began", "name one that did");
        if (!query.getColumn(0).isNull()) throw InputError(subject, "has ended", "begin another one");
        held_.emplace(session, std::move(lock));
    });
}

void TrialStore::append(const Trial& trial) {
    hold_session(trial.session);
    guarded([&] {
        if (!append_) {
            append_ = std::make_unique<SQLite::Statement>(
                database_,
                "INSERT INTO trial (session, presentation, round, track, trial, kind, task, pattern, kernel, contrast, "
                "texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s, "
                "dropped_frames) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        }
        SQLite::Statement& insert = *append_;
        // Also where it failed: a reset that may throw would say so again next time.
        const struct Reset {
            SQLite::Statement& statement;
            ~Reset() { statement.tryReset(); }
        } reset{insert};
        int column = 0;
        const auto bind = [&](const auto& value) { insert.bind(++column, value); };
        bind(trial.session);
        bind(trial.presentation);
        bind(trial.round);
        bind(trial.track);
        bind(trial.trial);
        bind(std::string(name(trial.kind)));
        bind(std::string(name(trial.task)));
        bind(std::string(name(trial.condition.pattern)));
        bind(std::string(name(trial.condition.kernel)));
        bind(trial.condition.contrast);
        bind(trial.condition.texel_px);
        bind(trial.suggested_radius_px);
        bind(trial.radius_px);
        bind(std::string(name(trial.stimulus)));
        bind(std::string(name(trial.response)));
        bind(trial.response_time_s);
        bind(trial.shown_at_s);
        bind(trial.dropped_frames);
        insert.exec();  // a statement outside a transaction commits by itself
    });
}

void TrialStore::mark_void(int session, int presentation) {
    hold_session(session);
    guarded([&] {
        SQLite::Statement insert(database_, "INSERT INTO void VALUES (?, ?)");
        insert.bind(1, session);
        insert.bind(2, presentation);
        insert.exec();
    });
}

void TrialStore::end_session(int session, SessionEnd end) {
    hold_session(session);
    guarded([&] {
        SQLite::Statement insert(database_, "INSERT INTO session_end VALUES (?, ?)");
        insert.bind(1, session);
        insert.bind(2, end == SessionEnd::finished ? "finished" : "aborted");
        insert.exec();
    });
    held_.erase(session);
}

std::string TrialStore::study_field(const std::string& column) const {
    return guarded([&] {
        SQLite::Statement query(database_, "SELECT " + column + " FROM study");
        if (!query.executeStep()) throw InputError(path_.string(), "holds no study", "restore it from a copy");
        return query.getColumn(0).getString();
    });
}

std::string TrialStore::study() const {
    return study_field("name");
}

std::string TrialStore::design_json() const {
    return study_field("design");
}

std::string TrialStore::plan_json() const {
    return study_field("plan");
}

std::vector<SessionRecord> TrialStore::sessions() const {
    return guarded([&] {
        std::vector<SessionRecord> sessions;
        SQLite::Statement query(database_,
                                "SELECT session, observer, observer_index, seed, observer_kind, observer_settings, "
                                "outcome, schema FROM session LEFT JOIN session_end USING (session) ORDER BY session");
        while (query.executeStep()) {
            SessionRecord session{count_in(query.getColumn(0), path_),
                                  query.getColumn(1).getString(),
                                  count_in(query.getColumn(2), path_),
                                  static_cast<uint64_t>(query.getColumn(3).getInt64()),
                                  query.getColumn(4).getString(),
                                  query.getColumn(5).getString(),
                                  std::nullopt,
                                  count_in(query.getColumn(7), path_)};
            if (session.observer_index < 0) {
                throw InputError(path_.string() + ": session " + std::to_string(session.session),
                                 "has an observer before the first", "restore it from a copy");
            }
            if (!query.getColumn(6).isNull()) {
                session.end = query.getColumn(6).getString() == "finished" ? SessionEnd::finished : SessionEnd::aborted;
            }
            sessions.push_back(session);
        }
        return sessions;
    });
}

std::vector<Trial> TrialStore::trials() const {
    return trials_where("");
}

std::vector<Trial> TrialStore::trials(int session) const {
    return trials_where("WHERE session = " + std::to_string(session) + " ");
}

std::vector<Trial> TrialStore::trials_where(const std::string& condition) const {
    const std::string study_name = study();
    return guarded([&] {
        std::vector<Trial> trials;
        SQLite::Statement query(
            database_,
            std::string(
                "SELECT observer, session, presentation, round, track, trial, kind, task, pattern, kernel, contrast, "
                "texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s, "
                "dropped_frames, (session, presentation) IN (SELECT session, presentation FROM void) "
                "FROM trial JOIN session USING (session) ") +
                condition + "ORDER BY id");
        while (query.executeStep()) {
            int column = 0;
            const auto text = [&] { return query.getColumn(column++).getString(); };
            const auto number = [&] { return query.getColumn(column++).getDouble(); };
            const auto count = [&] { return count_in(query.getColumn(column++), path_); };
            // A word that the schema's checks don't hold back comes from a newer program.
            const auto known = [&](const auto& value, const std::string& word) {
                if (!value) throw InputError(path_.string(), "says \"" + word + "\"", "use a newer Stairstep");
                return *value;
            };
            const auto named = [&](const auto& parse) {
                const std::string word = text();
                return known(parse(word), word);
            };
            Trial trial;
            trial.study = study_name;
            trial.observer = text();
            trial.session = count();
            trial.presentation = count();
            trial.round = count();
            trial.track = count();
            trial.trial = count();
            trial.kind = named(trial_kind_named);
            trial.task = named(task_named);
            trial.condition.pattern = named(pattern_named);
            trial.condition.kernel = named(kernel_shape_named);
            trial.condition.contrast = number();
            trial.condition.texel_px = number();
            trial.suggested_radius_px = number();
            trial.radius_px = number();
            trial.stimulus = named(judgement_named);
            trial.response = named(judgement_named);
            trial.response_time_s = number();
            trial.shown_at_s = number();
            trial.dropped_frames = count();
            trial.is_void = count() != 0;
            trials.push_back(trial);
        }
        return trials;
    });
}

}  // namespace stairstep
