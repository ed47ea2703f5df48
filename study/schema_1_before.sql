-- A database of version 1, on its way to version 2: what is there makes room. The triggers would hold back the removal, and a
-- constraint (one trial a number in a track) changes, which takes new tables.
DROP TRIGGER IF EXISTS trial_is_final_update;
DROP TRIGGER IF EXISTS trial_is_final_delete;
DROP TRIGGER IF EXISTS session_is_final_update;
DROP TRIGGER IF EXISTS session_is_final_delete;
ALTER TABLE study RENAME TO study_1;
ALTER TABLE session RENAME TO session_1;
ALTER TABLE session_end RENAME TO session_end_1;
ALTER TABLE trial RENAME TO trial_1;
