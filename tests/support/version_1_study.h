// A study's database as version 1 of the schema had it, made by that version's own SQL.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>

namespace stairstep {

inline constexpr const char* kVersion1Schema = R"(
CREATE TABLE study (
    name TEXT NOT NULL,
    design TEXT NOT NULL,           -- JSON
    program TEXT NOT NULL           -- version that created the database
) STRICT;

CREATE TABLE session (
    session INTEGER PRIMARY KEY,
    observer TEXT NOT NULL,
    seed INTEGER NOT NULL,
    observer_kind TEXT NOT NULL,
    observer_settings TEXT NOT NULL -- JSON
) STRICT;

CREATE TABLE session_end (
    session INTEGER PRIMARY KEY REFERENCES session
) STRICT;

CREATE TABLE trial (
    id INTEGER PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    round INTEGER NOT NULL,
    track INTEGER NOT NULL,
    trial INTEGER NOT NULL,
    pattern TEXT NOT NULL CHECK (pattern IN ('step', 'stair')),
    kernel TEXT NOT NULL,
    contrast REAL NOT NULL CHECK (contrast > 0 AND contrast <= 1),
    texel_px REAL NOT NULL CHECK (texel_px > 0),
    suggested_radius_px REAL NOT NULL,
    radius_px REAL NOT NULL CHECK (radius_px > 0),
    stimulus TEXT NOT NULL CHECK (stimulus IN ('artifact', 'line')),
    response TEXT NOT NULL CHECK (response IN ('artifact', 'line')),
    response_time_s REAL NOT NULL,
    shown_at_s REAL NOT NULL,       -- Unix time
    dropped_frames INTEGER NOT NULL,
    UNIQUE (session, track, trial)
) STRICT;

-- What was recorded stays as it was.
CREATE TRIGGER trial_is_final_update BEFORE UPDATE ON trial BEGIN SELECT RAISE(ABORT, 'trials are append-only'); END;
CREATE TRIGGER trial_is_final_delete BEFORE DELETE ON trial BEGIN SELECT RAISE(ABORT, 'trials are append-only'); END;
CREATE TRIGGER session_is_final_update BEFORE UPDATE ON session BEGIN SELECT RAISE(ABORT, 'sessions are append-only'); END;
CREATE TRIGGER session_is_final_delete BEFORE DELETE ON session BEGIN SELECT RAISE(ABORT, 'sessions are append-only'); END;
)";

/// Two sessions of three trials over two tracks, recorded in turn; the first has ended.
inline void make_version_1_study(const std::filesystem::path& path) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("PRAGMA journal_mode = WAL");
    database.exec("PRAGMA foreign_keys = ON");
    SQLite::Transaction transaction(database);
    database.exec("PRAGMA application_id = 1400132464");  // "StSp"
    database.exec("PRAGMA user_version = 1");
    database.exec(kVersion1Schema);
    database.exec(R"(
        INSERT INTO study VALUES ('kreuzer-2017', '{"name":"kreuzer-2017","patterns":["step","stair"],
            "contrasts":[1.0,0.5],"texels_px":[5.0,10.0,20.0,30.0],"kernel":"box",
            "task":"one interval: was the original a line? lines on half the trials of each track",
            "engine":{"name":"quest","guess_radius_texels":3.0,"guess_sd":0.5,"p_threshold":0.82,"beta":3.5,"gamma":0.5,
            "delta":0.01,"grain":0.01,"range":5.0},"stop":{"least_trials":10,"most_trials":100,"converged_sd":0.05},
            "radius_px":[0.25,320.0]}', '0.1.0');
        INSERT INTO session VALUES (1, 'sim01', 11, 'simulated', '{"step_slope":3.47}'),
                                   (2, 'sim02', 22, 'simulated', '{"step_slope":3.47}');
        INSERT INTO trial (session, round, track, trial, pattern, kernel, contrast, texel_px, suggested_radius_px,
            radius_px, stimulus, response, response_time_s, shown_at_s, dropped_frames) VALUES
            (1, 1, 2, 1, 'step',  'box', 1.0, 10.0, 400.1, 320.0, 'artifact', 'line',     0.70, 946684800.5, 0),
            (2, 1, 5, 1, 'stair', 'box', 0.5, 5.0,  15.25, 15.25, 'line',     'line',     0.81, 946771200.5, 1),
            (1, 1, 1, 1, 'step',  'box', 1.0, 5.0,  15.5,  15.5,  'line',     'artifact', 0.92, 946684802.5, 0),
            (1, 1, 2, 2, 'step',  'box', 1.0, 10.0, 31.5,  31.5,  'artifact', 'artifact', 1.03, 946684804.5, 0),
            (2, 1, 5, 2, 'stair', 'box', 0.5, 5.0,  14.5,  14.5,  'artifact', 'line',     1.14, 946771202.5, 0),
            (2, 1, 6, 1, 'stair', 'box', 0.5, 10.0, 30.5,  30.5,  'artifact', 'line',     1.25, 946771204.5, 0);
        INSERT INTO session_end VALUES (1);
    )");
    transaction.commit();
}

}  // namespace stairstep
