#include "study/store.h"

#include <sqlite3.h>
#include <unistd.h>

#include "embedded/study.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

/// "StSp": tells a Stairstep study from any other SQLite file.
constexpr int kApplicationId = 0x53745370;
constexpr int kSchemaVersion = 1;

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
                                 "INSERT INTO session (observer, seed, observer_kind, observer_settings) "
                                 "VALUES (?, ?, ?, ?)");
        insert.bind(1, session.observer);
        insert.bind(2, static_cast<int64_t>(session.seed));
        insert.bind(3, session.observer_kind);
        insert.bind(4, session.observer_settings);
        insert.exec();
        return static_cast<int>(database_.getLastInsertRowid());
    });
}

void TrialStore::append(const Trial& trial) {
    guarded([&] {
        SQLite::Statement insert(database_,
                                 "INSERT INTO trial (session, round, track, trial, pattern, kernel, contrast, "
                                 "texel_px, suggested_radius_px, "
                                 "radius_px, stimulus, response, response_time_s, shown_at_s, dropped_frames) "
                                 "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        insert.bind(1, trial.session);
        insert.bind(2, trial.round);
        insert.bind(3, trial.track);
        insert.bind(4, trial.trial);
        insert.bind(5, std::string(name(trial.condition.pattern)));
        insert.bind(6, std::string(name(trial.condition.kernel)));
        insert.bind(7, trial.condition.contrast);
        insert.bind(8, trial.condition.texel_px);
        insert.bind(9, trial.suggested_radius_px);
        insert.bind(10, trial.radius_px);
        insert.bind(11, std::string(name(trial.stimulus)));
        insert.bind(12, std::string(name(trial.response)));
        insert.bind(13, trial.response_time_s);
        insert.bind(14, trial.shown_at_s);
        insert.bind(15, trial.dropped_frames);
        insert.exec();  // a statement outside a transaction commits by itself
    });
}

void TrialStore::finish_session(int session) {
    guarded([&] {
        SQLite::Statement insert(database_, "INSERT INTO session_end VALUES (?)");
        insert.bind(1, session);
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
                                "SELECT session, observer, seed, observer_kind, observer_settings, "
                                "session IN (SELECT session FROM session_end) FROM session ORDER BY session");
        while (query.executeStep()) {
            sessions.push_back({query.getColumn(0).getInt(), query.getColumn(1).getString(),
                                static_cast<uint64_t>(query.getColumn(2).getInt64()), query.getColumn(3).getString(),
                                query.getColumn(4).getString(), query.getColumn(5).getInt() != 0});
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
            "SELECT observer, session, round, track, trial, pattern, kernel, contrast, texel_px, suggested_radius_px, "
            "radius_px, stimulus, response, response_time_s, shown_at_s, dropped_frames "
            "FROM trial JOIN session USING (session) ORDER BY id");
        while (query.executeStep()) {
            const auto text = [&query](int column) { return query.getColumn(column).getString(); };
            const auto kernel = kernel_shape_named(text(6));
            if (!kernel)
                throw InputError(path_.string(), "names the kernel \"" + text(6) + "\"", "use a newer Stairstep");
            Trial trial;
            trial.study = study_name;
            trial.observer = text(0);
            trial.session = query.getColumn(1).getInt();
            trial.round = query.getColumn(2).getInt();
            trial.track = query.getColumn(3).getInt();
            trial.trial = query.getColumn(4).getInt();
            trial.condition = {pattern_from(text(5)), *kernel, query.getColumn(7).getDouble(),
                               query.getColumn(8).getDouble()};
            trial.suggested_radius_px = query.getColumn(9).getDouble();
            trial.radius_px = query.getColumn(10).getDouble();
            trial.stimulus = *judgement_named(text(11));
            trial.response = *judgement_named(text(12));
            trial.response_time_s = query.getColumn(13).getDouble();
            trial.shown_at_s = query.getColumn(14).getDouble();
            trial.dropped_frames = query.getColumn(15).getInt();
            trials.push_back(trial);
        }
        return trials;
    });
}

}  // namespace stairstep
