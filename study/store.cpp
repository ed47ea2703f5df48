#include "study/store.h"

#include <sqlite3.h>
#include <unistd.h>

#include "embedded/study.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

/// "StSp": tells a Stairstep study from any other SQLite file.
constexpr int kApplicationId = 0x53745370;
constexpr int kSchemaVersion = 2;

[[noreturn]] void translate(const std::filesystem::path& path, const SQLite::Exception& e) {
    const std::string problem = e.what();
    switch (e.getErrorCode() & 0xff) {
        case SQLITE_NOTADB:
        case SQLITE_CORRUPT:
            throw InputError(path.string(), "is damaged or no database (" + problem + ")", "restore it from a copy");
        case SQLITE_CONSTRAINT:
        case SQLITE_MISMATCH:
            throw InputError(path.string(), "refuses this (" + problem + ")", "check the trial's values");
        default:
            throw FailureError(path.string(), "the database can't be used (" + problem + ")",
                               "check the disk's free space and the file's permissions");
    }
}

int pragma(const SQLite::Database& database, const char* name) {
    SQLite::Statement query(database, std::string("PRAGMA ") + name);
    query.executeStep();
    return query.getColumn(0).getInt();
}

std::string study_field(const SQLite::Database& database, const std::string& column) {
    SQLite::Statement query(database, "SELECT " + column + " FROM study");
    query.executeStep();
    return query.getColumn(0).getString();
}

Pattern pattern_from(const std::string& text) {
    return text == "stair" ? Pattern::stair : Pattern::step;
}

}  // namespace

/// Runs an action on the database and turns SQLite's exceptions into ours.
template <typename Action>
auto TrialStore::guarded(const Action& action) const {
    try {
        return action();
    } catch (const SQLite::Exception& e) {
        translate(path_, e);
    }
}

TrialStore::TrialStore(const std::filesystem::path& path, int flags) try
    : path_(path), database_(path.string(), flags) {
} catch (const SQLite::Exception& e) {
    translate(path, e);
}

TrialStore TrialStore::create(const std::filesystem::path& path, const std::string& study,
                              const std::string& design_json) {
    if (std::filesystem::exists(path)) {
        throw InputError(path.string(), "already exists, and a study is never overwritten",
                         "name another --db or move it away");
    }
    TrialStore store(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    store.guarded([&] {
        store.database_.exec("PRAGMA journal_mode = WAL");
        store.database_.exec("PRAGMA synchronous = FULL");
        store.database_.exec("PRAGMA foreign_keys = ON");
        SQLite::Transaction transaction(store.database_);
        store.database_.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
        store.database_.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
        store.database_.exec(std::string(embedded::schema_sql));
        SQLite::Statement insert(store.database_, "INSERT INTO study VALUES (?, ?, ?)");
        insert.bind(1, study);
        insert.bind(2, design_json);
        insert.bind(3, STAIRSTEP_VERSION);
        insert.exec();
        transaction.commit();
    });
    return store;
}

TrialStore TrialStore::open(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) throw InputError(path.string(), "doesn't exist", "check the path");
    if (std::filesystem::is_directory(path)) throw InputError(path.string(), "is a folder", "name a database");
    // A reader who may write tidies the write-ahead log up when it closes; one who may not leaves it as it is.
    const bool writable = access(path.c_str(), W_OK) == 0;
    TrialStore store(path, writable ? SQLite::OPEN_READWRITE : SQLite::OPEN_READONLY);
    store.guarded([&] {
        store.database_.exec("PRAGMA query_only = ON");
        if (pragma(store.database_, "application_id") != kApplicationId) {
            throw InputError(path.string(), "is no Stairstep study", "name a database that stairstep-study wrote");
        }
        if (const int version = pragma(store.database_, "user_version"); version != kSchemaVersion) {
            throw InputError(path.string(), "has schema version " + std::to_string(version),
                             "use a Stairstep that reads it; this one reads version " + std::to_string(kSchemaVersion));
        }
    });
    return store;
}

int TrialStore::begin_session(const SessionRecord& session) {
    return guarded([&] {
        SQLite::Statement insert(database_,
                                 "INSERT INTO session (observer, observer_index, seed, observer_kind, "
                                 "observer_settings) VALUES (?, ?, ?, ?, ?)");
        insert.bind(1, session.observer);
        insert.bind(2, session.observer_index);
        insert.bind(3, static_cast<int64_t>(session.seed));
        insert.bind(4, session.observer_kind);
        insert.bind(5, session.observer_settings);
        insert.exec();
        return static_cast<int>(database_.getLastInsertRowid());
    });
}

void TrialStore::append(const Trial& trial) {
    guarded([&] {
        if (!append_) {
            append_ = std::make_unique<SQLite::Statement>(
                database_,
                "INSERT INTO trial (session, presentation, round, track, trial, kind, task, pattern, kernel, contrast, "
                "texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s, "
                "dropped_frames) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        }
        SQLite::Statement& insert = *append_;
        insert.reset();
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
        insert.reset();
    });
}

void TrialStore::mark_void(int session, int presentation) {
    guarded([&] {
        SQLite::Statement insert(database_, "INSERT INTO void VALUES (?, ?)");
        insert.bind(1, session);
        insert.bind(2, presentation);
        insert.exec();
    });
}

void TrialStore::end_session(int session, SessionEnd end) {
    guarded([&] {
        SQLite::Statement insert(database_, "INSERT INTO session_end VALUES (?, ?)");
        insert.bind(1, session);
        insert.bind(2, end == SessionEnd::finished ? "finished" : "aborted");
        insert.exec();
    });
}

std::string TrialStore::study() const {
    return guarded([&] { return study_field(database_, "name"); });
}

std::string TrialStore::design_json() const {
    return guarded([&] { return study_field(database_, "design"); });
}

std::vector<SessionRecord> TrialStore::sessions() const {
    return guarded([&] {
        std::vector<SessionRecord> sessions;
        SQLite::Statement query(database_,
                                "SELECT session, observer, observer_index, seed, observer_kind, observer_settings, "
                                "outcome FROM session LEFT JOIN session_end USING (session) ORDER BY session");
        while (query.executeStep()) {
            SessionRecord session{query.getColumn(0).getInt(),
                                  query.getColumn(1).getString(),
                                  query.getColumn(2).getInt(),
                                  static_cast<uint64_t>(query.getColumn(3).getInt64()),
                                  query.getColumn(4).getString(),
                                  query.getColumn(5).getString(),
                                  std::nullopt};
            if (!query.getColumn(6).isNull()) {
                session.end = query.getColumn(6).getString() == "finished" ? SessionEnd::finished : SessionEnd::aborted;
            }
            sessions.push_back(session);
        }
        return sessions;
    });
}

std::vector<Trial> TrialStore::trials() const {
    const std::string study_name = study();
    return guarded([&] {
        std::vector<Trial> trials;
        SQLite::Statement query(
            database_,
            "SELECT observer, session, presentation, round, track, trial, kind, task, pattern, kernel, contrast, "
            "texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s, "
            "dropped_frames, (session, presentation) IN (SELECT session, presentation FROM void) "
            "FROM trial JOIN session USING (session) ORDER BY id");
        while (query.executeStep()) {
            int column = 0;
            const auto text = [&] { return query.getColumn(column++).getString(); };
            const auto number = [&] { return query.getColumn(column++).getDouble(); };
            const auto count = [&] { return query.getColumn(column++).getInt(); };
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
            trial.condition.pattern = pattern_from(text());
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
