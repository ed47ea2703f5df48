CREATE TABLE study (
    name TEXT NOT NULL,
    design TEXT NOT NULL,           -- JSON
    plan TEXT NOT NULL,             -- JSON: who takes part, where that is known beforehand; else {}
    program TEXT NOT NULL           -- version that created the database
) STRICT;

CREATE TABLE session (
    session INTEGER PRIMARY KEY,
    observer TEXT NOT NULL,
    observer_index INTEGER NOT NULL, -- from 0; decides the order of rounds
    seed INTEGER NOT NULL,
    observer_kind TEXT NOT NULL,
    observer_settings TEXT NOT NULL, -- JSON
    schema INTEGER NOT NULL         -- version of the schema that it was recorded in
) STRICT;

CREATE TABLE session_end (
    session INTEGER PRIMARY KEY REFERENCES session,
    outcome TEXT NOT NULL CHECK (outcome IN ('finished', 'aborted'))
) STRICT;

CREATE TABLE trial (
    id INTEGER PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    presentation INTEGER NOT NULL,  -- from 1 in the session
    round INTEGER NOT NULL,
    track INTEGER NOT NULL,
    trial INTEGER NOT NULL,         -- from 1 in the track; 0 for practice and catch trials
    kind TEXT NOT NULL CHECK (kind IN ('main', 'practice', 'catch')),
    task TEXT NOT NULL CHECK (task IN ('yes-no', '2afc')),
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
    UNIQUE (session, presentation)
) STRICT;

-- Trials that the observer took back: kept, but no evidence.
CREATE TABLE void (
    session INTEGER NOT NULL,
    presentation INTEGER NOT NULL,
    PRIMARY KEY (session, presentation),
    FOREIGN KEY (session, presentation) REFERENCES trial (session, presentation)
) STRICT;

-- What was recorded stays as it was.
CREATE TRIGGER trial_is_final_update BEFORE UPDATE ON trial BEGIN SELECT RAISE(ABORT, 'trials are append-only'); END;
CREATE TRIGGER trial_is_final_delete BEFORE DELETE ON trial BEGIN SELECT RAISE(ABORT, 'trials are append-only'); END;
CREATE TRIGGER session_is_final_update BEFORE UPDATE ON session BEGIN SELECT RAISE(ABORT, 'sessions are append-only'); END;
CREATE TRIGGER session_is_final_delete BEFORE DELETE ON session BEGIN SELECT RAISE(ABORT, 'sessions are append-only'); END;
CREATE TRIGGER void_is_final_update BEFORE UPDATE ON void BEGIN SELECT RAISE(ABORT, 'append-only'); END;
CREATE TRIGGER void_is_final_delete BEFORE DELETE ON void BEGIN SELECT RAISE(ABORT, 'append-only'); END;
CREATE TRIGGER session_end_is_final_update BEFORE UPDATE ON session_end BEGIN SELECT RAISE(ABORT, 'append-only'); END;
CREATE TRIGGER session_end_is_final_delete BEFORE DELETE ON session_end BEGIN SELECT RAISE(ABORT, 'append-only'); END;
CREATE TRIGGER study_is_final_update BEFORE UPDATE ON study BEGIN SELECT RAISE(ABORT, 'append-only'); END;
CREATE TRIGGER study_is_final_delete BEFORE DELETE ON study BEGIN SELECT RAISE(ABORT, 'append-only'); END;

-- A session that has ended stays ended.
CREATE TRIGGER trial_comes_before_end BEFORE INSERT ON trial
    WHEN EXISTS (SELECT 1 FROM session_end WHERE session = NEW.session)
    BEGIN SELECT RAISE(ABORT, 'the session has ended'); END;
CREATE TRIGGER void_comes_before_end BEFORE INSERT ON void
    WHEN EXISTS (SELECT 1 FROM session_end WHERE session = NEW.session)
    BEGIN SELECT RAISE(ABORT, 'the session has ended'); END;
