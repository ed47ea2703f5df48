// A study as a behavioural dataset in the Brain Imaging Data Structure (BIDS 1.8.0, "Behavioral experiments"):
//
//   dataset_description.json  README  participants.tsv  participants.json
//   task-<task>_events.json                               every column of the tables below; design, viewing
//   sub-<label>/sub-<label>_sessions.tsv and .json        how each session ended
//   sub-<label>/ses-<n>/beh/sub-<label>_ses-<n>_task-<task>_events.tsv
//
// The task is the design's, "yesno" or "2afc". A session counts within its observer: ses-01 is an observer's first. An events
// table has a row a presentation, practice, catch and void trials included, with onset and duration in seconds from the
// onset of the session's first presentation; what is missing is n/a. No date leaves the study, since it may tell who took part.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/design.h"
#include "study/store.h"

namespace stairstep {

struct BidsStudy {
    std::string name;
    Design design;
    std::vector<SessionRecord> sessions;
    /// In the order of recording.
    std::vector<Trial> trials;
    /// What each observer is called.
    std::map<std::string, std::string> observer_names;
    /// Of the dataset; may be empty.
    std::vector<std::string> authors;
};

/// The dataset's files: content by path within the dataset. Sessions and observers without trials are left out. Throws
/// InputError for a study without trials, and for observers whose names can't be told apart as BIDS labels: these have
/// letters and digits only, so that "sub-07" is 07 and "P-7" is P7, and "Anna Öz" is none.
std::map<std::string, std::string> bids_dataset(const BidsStudy& study);

/// What a BIDS label makes of an observer's name; empty where it can't be one.
std::string bids_label(const std::string& name);

}  // namespace stairstep
