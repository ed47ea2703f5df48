#include "study/bids.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "study/design_json.h"

namespace stairstep {
namespace {

using nlohmann::ordered_json;

/// A column of an events table: what its sidecar says of it, and a trial's value.
struct Column {
    std::string name;
    ordered_json description;
    std::string (*value)(const Trial& trial, double start_s);
};

std::string count_text(int value) {
    return std::to_string(value);
}

/// Seconds, to a tenth of a millisecond.
std::string seconds_text(double value_s) {
    return std::isfinite(value_s) ? format_fixed(value_s, 4) : "n/a";
}

std::string length_text(double value_px) {
    return std::isfinite(value_px) ? format_number(value_px) : "n/a";
}

ordered_json described(const char* text) {
    return {{"Description", text}};
}

ordered_json with_units(const char* text, const char* units) {
    return {{"Description", text}, {"Units", units}};
}

ordered_json with_levels(const char* text, const ordered_json& levels) {
    return {{"Description", text}, {"Levels", levels}};
}

/// BIDS asks for onset and duration first; trial_type and response_time are its own names.
std::vector<Column> event_columns() {
    return {
        {"onset", with_units("When the stimulus appeared, from the onset of the session's first presentation.", "s"),
         [](const Trial& t, double start_s) { return seconds_text(t.shown_at_s - start_s); }},
        {"duration", with_units("From the stimulus's onset to the answer.", "s"),
         [](const Trial& t, double) { return seconds_text(t.response_time_s); }},
        {"trial_type",
         with_levels("What the trial serves.",
                     {{"main", "moves its track on"},
                      {"practice", "easy to see; shown before the first round"},
                      {"catch", "easy to see; shown at random among the others, tells whether the observer attends"}}),
         [](const Trial& t, double) { return std::string(name(t.kind)); }},
        {"response_time", with_units("From the stimulus's onset to the answer.", "s"),
         [](const Trial& t, double) { return seconds_text(t.response_time_s); }},
        {"presentation", described("Number of the presentation in the session, from 1."),
         [](const Trial& t, double) { return count_text(t.presentation); }},
        {"round", described("Number of the round in the session, from 1. The tracks of a round run interleaved."),
         [](const Trial& t, double) { return count_text(t.round); }},
        {"track",
         described(
             "Number of the adaptive track in the session, from 1; for practice and catch trials, the track whose "
             "condition they borrow."),
         [](const Trial& t, double) { return count_text(t.track); }},
        {"trial",
         described("Number of the trial in its track, from 1; n/a for practice and catch trials. A trial that is shown "
                   "again after it was taken back keeps its number."),
         [](const Trial& t, double) { return t.kind == TrialKind::main ? count_text(t.trial) : "n/a"; }},
        {"task",
         with_levels("What was asked.",
                     {{"yes-no", "one picture: is it an artifact or a line?"},
                      {"2afc", "an artifact and its line side by side: which one is the artifact?"}}),
         [](const Trial& t, double) { return std::string(name(t.task)); }},
        {"pattern",
         with_levels("What the shadow map makes of the edge; on a line trial, of the edge that the line stands for.",
                     {{"step", "one single step"}, {"stair", "stairs at 45 degrees"}}),
         [](const Trial& t, double) { return std::string(name(t.condition.pattern)); }},
        {"kernel",
         with_levels("Shape of the filter.", {{"box", "a square of side 2·radius"},
                                              {"disk", "a disk"},
                                              {"gaussian", "a Gaussian with the disk's variance, cut off"},
                                              {"poisson", "taps spread over a disk"}}),
         [](const Trial& t, double) { return std::string(name(t.condition.kernel)); }},
        {"contrast",
         with_units("Luminance of the lit side as a share of the display's white; the shadow is black.", "1"),
         [](const Trial& t, double) { return format_number(t.condition.contrast); }},
        {"texel_px", with_units("Side of a shadow-map texel on the screen: the height of a step.", "pixel"),
         [](const Trial& t, double) { return length_text(t.condition.texel_px); }},
        {"suggested_radius_px", with_units("Filter radius that the adaptive method asked for.", "pixel"),
         [](const Trial& t, double) { return length_text(t.suggested_radius_px); }},
        {"radius_px", with_units("Filter radius that was shown: the suggestion within the display's limits.", "pixel"),
         [](const Trial& t, double) { return length_text(t.radius_px); }},
        {"stimulus",
         with_levels("What was shown; in the 2afc task, what was on the left.",
                     {{"artifact", "the edge as the shadow map samples it"}, {"line", "the true edge"}}),
         [](const Trial& t, double) { return std::string(name(t.stimulus)); }},
        {"response",
         with_levels("What the observer said it was; in the 2afc task, what was on the left.",
                     {{"artifact", "the edge as the shadow map samples it"}, {"line", "the true edge"}}),
         [](const Trial& t, double) { return std::string(name(t.response)); }},
        {"correct", with_levels("Whether response and stimulus agree.", {{"0", "no"}, {"1", "yes"}}),
         [](const Trial& t, double) { return std::string(t.correct() ? "1" : "0"); }},
        {"dropped_frames", described("Frames that the display dropped during the presentation."),
         [](const Trial& t, double) { return count_text(t.dropped_frames); }},
        {"void",
         with_levels("Whether the observer took the answer back.",
                     {{"0", "no"}, {"1", "yes: the trial is no evidence"}}),
         [](const Trial& t, double) { return std::string(t.is_void ? "1" : "0"); }},
    };
}

std::string joined(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields) line += (line.empty() ? "" : "\t") + field;
    return line + "\n";
}

std::string events_tsv(const std::vector<const Trial*>& trials) {
    const std::vector<Column> columns = event_columns();
    std::vector<std::string> fields;
    for (const Column& column : columns) fields.push_back(column.name);
    std::string text = joined(fields);
    for (const Trial* trial : trials) {
        for (size_t i = 0; i < columns.size(); ++i) fields[i] = columns[i].value(*trial, trials.front()->shown_at_s);
        text += joined(fields);
    }
    return text;
}

/// "yes-no" → "yesno": the label is the task's name without what labels can't have.
std::string task_label(Task task) {
    std::string label(name(task));
    std::erase(label, '-');
    return label;
}

ordered_json events_sidecar(const BidsStudy& study) {
    const Design& design = study.design;
    const bool is_yes_no = design.task == Task::yes_no;
    const char* description =
        is_yes_no
            ? "One filtered shadow edge is shown at a time, sampled by a shadow map (an artifact) or true (a line); "
              "the observer says which of the two it is. The filter's radius follows the answers, by an adaptive "
              "method for each condition."
            : "A filtered shadow edge as a shadow map samples it (an artifact) and the true one (a line) are shown "
              "side by side; the observer says which is the artifact. The filter's radius follows the answers, by "
              "an adaptive method for each condition.";
    // At the top level of this file the validator takes objects alone.
    ordered_json sidecar;
    sidecar["Task"] = {{"TaskName", name(design.task)}, {"TaskDescription", description}};
    sidecar["StimulusPresentation"] = ordered_json{{"SoftwareName", "Stairstep"}};
    sidecar["StudyDesign"] = to_json(design);
    if (design.viewing) {
        sidecar["StimulusPresentation"]["ScreenDistance"] = design.viewing->distance_mm / 1000;
        sidecar["ViewingGeometry"] = {{"ScreenDistance_m", design.viewing->distance_mm / 1000},
                                      {"PixelPitch_m", design.viewing->pixel_pitch_mm / 1000},
                                      {"PixelsPerDegree", design.viewing->pixels_per_degree()}};
    }
    for (const Column& column : event_columns()) sidecar[column.name] = column.description;
    return sidecar;
}

ordered_json dataset_description(const BidsStudy& study) {
    ordered_json description{{"Name", study.name}, {"BIDSVersion", "1.8.0"}, {"DatasetType", "raw"}};
    if (!study.authors.empty()) description["Authors"] = study.authors;
    description["GeneratedBy"] =
        ordered_json::array({ordered_json{{"Name", "Stairstep"}, {"Version", STAIRSTEP_VERSION}}});
    return description;
}

std::string readme(const BidsStudy& study) {
    return "# " + study.name +
           "\n\n"
           "How much filtering hides the texels of a shadow map from an observer. In each adaptive track the pattern "
           "of "
           "the edge,\nits contrast and the texel's size on the screen are fixed, and the radius of the filter follows "
           "the "
           "observer's answers\ntowards the threshold at which the edge as the shadow map samples it can just be told "
           "from "
           "the true one.\n\n"
           "Each sub-<label>/ses-<n>/beh/*_events.tsv has a row a presentation. The columns, the design of the study "
           "and, "
           "where it is\nknown, the viewing geometry are in task-" +
           task_label(study.design.task) +
           "_events.json. For thresholds take trials of trial_type main whose void is 0.\n\n"
           "Labels of people are pseudonyms, and the tables hold no dates. Observers of the kind \"simulated\" are "
           "programs.\n\n"
           "Written by Stairstep " STAIRSTEP_VERSION ".\n";
}

std::string json_text(const ordered_json& json) {
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string outcome(const SessionRecord& session) {
    if (!session.end) return "open";
    return *session.end == SessionEnd::finished ? "finished" : "aborted";
}

/// An observer's sessions that have trials, in order.
struct Participant {
    std::string label;
    std::vector<const SessionRecord*> sessions;
};

bool same_but_for_case(const std::string& a, const std::string& b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c + 0; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::vector<Participant> participants(const BidsStudy& study,
                                      const std::map<int, std::vector<const Trial*>>& session_trials) {
    std::vector<Participant> result;
    std::map<std::string, size_t> places;
    for (const SessionRecord& session : study.sessions) {
        if (!session_trials.contains(session.session)) continue;
        const auto [place, is_new] = places.try_emplace(session.observer, result.size());
        if (is_new) {
            const std::string& name = study.observer_names.at(session.observer);
            const std::string label = bids_label(name);
            const auto refuse = [&](const std::string& problem) {
                throw InputError("observer \"" + name + "\"", problem, "export with pseudonyms, without --names");
            };
            if (label.empty()) refuse("can't be a BIDS label, which has letters and digits only");
            for (const Participant& other : result) {
                // sub-Ann and sub-ann are one folder on some file systems.
                if (same_but_for_case(other.label, label)) refuse("has the same BIDS label as another: " + label);
            }
            result.push_back({label, {}});
        }
        result[place->second].sessions.push_back(&session);
    }
    return result;
}

std::string numbered(size_t number) {
    char text[24];
    std::snprintf(text, sizeof text, "%02zu", number);
    return text;
}

ordered_json outcome_column() {
    return with_levels("How the session ended.", {{"finished", "all rounds are done"},
                                                  {"aborted", "stopped for good before all rounds were done"},
                                                  {"open", "can go on"}});
}

}  // namespace

std::string bids_label(const std::string& name) {
    std::string label = name.starts_with("sub-") ? name.substr(4) : name;
    std::erase_if(label, [](char c) { return c == '-' || c == '_'; });
    const bool is_label = std::all_of(label.begin(), label.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    });
    return is_label ? label : "";
}

std::map<std::string, std::string> bids_dataset(const BidsStudy& study) {
    if (study.trials.empty()) {
        throw InputError("study " + study.name, "holds no trial, and BIDS has no dataset without one",
                         "run a session first");
    }
    std::map<int, std::vector<const Trial*>> session_trials;
    for (const Trial& trial : study.trials) session_trials[trial.session].push_back(&trial);

    std::map<std::string, std::string> files;
    std::string table = joined({"participant_id", "observer_kind", "sessions", "trials"});
    for (const Participant& participant : participants(study, session_trials)) {
        const std::string subject = "sub-" + participant.label;
        std::string sessions = joined({"session_id", "outcome", "trials"});
        size_t trials = 0;
        for (size_t i = 0; i < participant.sessions.size(); ++i) {
            const SessionRecord& record = *participant.sessions[i];
            const std::vector<const Trial*>& shown = session_trials.at(record.session);
            const std::string session = "ses-" + numbered(i + 1);
            trials += shown.size();
            sessions += joined({session, outcome(record), std::to_string(shown.size())});
            files[subject + "/" + session + "/beh/" + subject + "_" + session + "_task-" +
                  task_label(study.design.task) + "_events.tsv"] = events_tsv(shown);
        }
        files[subject + "/" + subject + "_sessions.tsv"] = sessions;
        files[subject + "/" + subject + "_sessions.json"] =
            json_text({{"outcome", outcome_column()}, {"trials", described("Presentations, void ones included.")}});
        table += joined({subject, participant.sessions.front()->observer_kind == "simulated" ? "simulated" : "person",
                         std::to_string(participant.sessions.size()), std::to_string(trials)});
    }
    files["participants.tsv"] = table;
    files["participants.json"] = json_text(
        {{"participant_id", described("Label of the observer.")},
         {"observer_kind", with_levels("Who answered.", {{"person", "a person"}, {"simulated", "a program"}})},
         {"sessions", described("Sessions that have trials.")},
         {"trials", described("Presentations in all sessions, void ones included.")}});
    files["task-" + task_label(study.design.task) + "_events.json"] = json_text(events_sidecar(study));
    files["README"] = readme(study);
    files["dataset_description.json"] = json_text(dataset_description(study));
    return files;
}

}  // namespace stairstep
