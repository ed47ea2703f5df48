-- The tables of version 2 stand empty beside those of version 1. Version 1 wrote a sentence as the design's task; it had one
-- task, half lines, one trial a presentation, and observers in the order of their sessions.
INSERT INTO study (name, design, plan, program)
    SELECT name,
           CASE WHEN json_valid(design) AND json_type(design, '$.task') = 'text'
                THEN json_set(design, '$.task', json('{"name":"yes-no","line_share":0.5}'))
                ELSE design END,
           '{}', program
    FROM study_1;
INSERT INTO session (session, observer, observer_index, seed, observer_kind, observer_settings, schema)
    SELECT session, observer, session - 1, seed, observer_kind, observer_settings, 1 FROM session_1;
INSERT INTO trial (id, session, presentation, round, track, trial, kind, task, pattern, kernel, contrast, texel_px,
                   suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s, dropped_frames)
    SELECT id, session, row_number() OVER (PARTITION BY session ORDER BY id), round, track, trial, 'main', 'yes-no', pattern,
           kernel, contrast, texel_px, suggested_radius_px, radius_px, stimulus, response, response_time_s, shown_at_s,
           dropped_frames
    FROM trial_1 ORDER BY id;
INSERT INTO session_end (session, outcome) SELECT session, 'finished' FROM session_end_1;
DROP TABLE trial_1;
DROP TABLE session_end_1;
DROP TABLE session_1;
DROP TABLE study_1;
