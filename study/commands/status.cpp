#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "stimuli/number.h"
#include "study/commands/commands.h"
#include "study/pseudonyms.h"
#include "study/store.h"
#include "study/study_status.h"

namespace stairstep {
namespace {

using nlohmann::ordered_json;

struct StatusOptions {
    std::string database;
    bool as_json = false;
};

std::string state_name(const SessionRecord& session) {
    if (!session.end) return "open";
    return *session.end == SessionEnd::finished ? "finished" : "aborted";
}

/// What isn't known is null; so is what JSON has no number for.
ordered_json number_or_null(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json to_json(const TrackStatus& track) {
    const TrackState& state = track.state;
    return {{"track", track.track},
            {"round", state.round},
            {"pattern", name(state.condition.pattern)},
            {"kernel", name(state.condition.kernel)},
            {"contrast", state.condition.contrast},
            {"texel_px", state.condition.texel_px},
            {"trials", state.trials},
            {"finished", state.is_finished},
            {"threshold", number_or_null(state.estimate.threshold)},
            {"sd", number_or_null(state.estimate.sd)},
            {"bound_sd", number_or_null(track.bound_sd)},
            {"sd_over_bound", number_or_null(track.sd_over_bound())}};
}

ordered_json to_json(const SessionStatus& status, const std::string& pseudonym) {
    ordered_json json{{"session", status.session.session},
                      {"observer", status.session.observer},
                      {"pseudonym", pseudonym},
                      {"kind", status.session.observer_kind},
                      {"trials", status.presentations},
                      {"finished", status.session.end.has_value()},
                      {"state", state_name(status.session)},
                      {"main_trials", status.main_trials},
                      {"practice_trials", status.practice_trials},
                      {"voids", status.voids},
                      {"catch", {{"right", status.catch_right}, {"shown", status.catch_trials}}},
                      {"presentation_s", number_or_null(status.presentation_s)}};
    if (!status.progress) {
        json["note"] = status.note;
        return json;
    }
    const SessionProgress& progress = *status.progress;
    json["expected_trials"] = progress.expected_trials;
    json["progress"] = progress.share;
    json["rounds"] = {{"done", progress.rounds_done}, {"of", progress.rounds}};
    json["tracks"] = {{"done", progress.tracks_done}, {"of", progress.tracks}};
    json["sd_over_bound"] = number_or_null(progress.sd_over_bound);
    json["time_left_s"] = number_or_null(progress.time_left_s);
    json["track_states"] = ordered_json::array();
    for (const TrackStatus& track : progress.begun) json["track_states"].push_back(to_json(track));
    return json;
}

/// Columns as wide as their longest field, those after the `left` first ones flush right.
class TextTable {
  public:
    TextTable(size_t left, std::vector<std::string> header) : left_(left), rows_{std::move(header)} {}

    void row(std::vector<std::string> fields) { rows_.push_back(std::move(fields)); }

    std::string text(const std::string& indent) const {
        std::vector<size_t> widths(rows_[0].size(), 0);
        for (const auto& row : rows_) {
            for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
        }
        std::string text;
        for (const auto& row : rows_) {
            std::string line = indent;
            for (size_t i = 0; i < row.size(); ++i) {
                const std::string space(widths[i] - width(row[i]), ' ');
                line += (i > 0 ? "  " : "") + (i < left_ ? row[i] + space : space + row[i]);
            }
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        }
        return text;
    }

  private:
    /// Characters of a UTF-8 text.
    static size_t width(const std::string& text) {
        return static_cast<size_t>(std::count_if(
            text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
    }

    size_t left_;
    std::vector<std::vector<std::string>> rows_;
};

std::string of(int done, int all) {
    return std::to_string(done) + "/" + std::to_string(all);
}

std::string decimals_or_dash(const std::optional<double>& value, int decimals) {
    return value && std::isfinite(*value) ? format_fixed(*value, decimals) : "-";
}

/// "45 s", "12 min", "1 h 05 min".
std::string duration_text(double value_s) {
    const long seconds = std::lround(std::clamp(value_s, 0.0, 1e9));
    if (seconds < 60) return std::to_string(seconds) + " s";
    const long minutes = (seconds + 30) / 60;
    if (minutes < 60) return std::to_string(minutes) + " min";
    char text[40];
    std::snprintf(text, sizeof text, "%ld h %02ld min", minutes / 60, minutes % 60);
    return text;
}

/// Whatever someone typed, without what would steer the terminal.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, '?');
    return text;
}

std::vector<std::string> session_row(const SessionStatus& status, const std::string& pseudonym) {
    std::vector<std::string> row{std::to_string(status.session.session), printable(status.session.observer), pseudonym,
                                 state_name(status.session)};
    const auto& progress = status.progress;
    row.push_back(progress ? of(progress->rounds_done, progress->rounds) : "-");
    row.push_back(progress ? of(progress->tracks_done, progress->tracks) : "-");
    row.push_back(progress ? of(status.main_trials, progress->expected_trials) : std::to_string(status.main_trials));
    row.push_back(progress ? decimals_or_dash(progress->sd_over_bound, 2) : "-");
    const bool has_time = progress && progress->time_left_s;
    row.push_back(has_time ? duration_text(*progress->time_left_s) : "-");
    row.push_back(std::to_string(status.voids));
    row.push_back(status.catch_trials > 0 ? of(status.catch_right, status.catch_trials) : "-");
    return row;
}

/// The tracks of a session that goes on; of those that ended, the median stands in the table of sessions.
std::string track_table(const SessionProgress& progress) {
    TextTable table(2, {"track", "condition", "trials", "SD", "SD/bound"});
    for (const TrackStatus& track : progress.begun) {
        const Condition& c = track.state.condition;
        table.row({std::to_string(track.track),
                   std::string(name(c.pattern)) + ", contrast " + format_number(c.contrast) + ", texel " +
                       format_number(c.texel_px) + " px",
                   std::to_string(track.state.trials), decimals_or_dash(track.state.estimate.sd, 3),
                   decimals_or_dash(track.sd_over_bound(), 2)});
    }
    return table.text("    ");
}

void print_status(const StatusOptions& options) {
    const TrialStore store = TrialStore::open(options.database);
    const std::vector<Trial> trials = store.trials();
    const std::vector<SessionRecord> records = store.sessions();
    const auto names = pseudonyms(records);
    const std::vector<SessionStatus> sessions = study_status(store.design_json(), records, trials, options.database);
    if (options.as_json) {
        ordered_json list = ordered_json::array();
        for (const SessionStatus& status : sessions) list.push_back(to_json(status, names.at(status.session.observer)));
        std::cout << ordered_json{{"study", store.study()}, {"trials", trials.size()}, {"sessions", list}}.dump(
                         2, ' ', false, ordered_json::error_handler_t::replace)
                  << "\n";
        return;
    }
    std::cout << "study " << printable(store.study()) << ": " << trials.size() << " trials in " << sessions.size()
              << (sessions.size() == 1 ? " session\n" : " sessions\n");
    if (sessions.empty()) return;
    TextTable table(4, {"session", "observer", "exported as", "state", "rounds", "tracks", "trials", "SD/bound", "left",
                        "voids", "catch"});
    for (const SessionStatus& status : sessions) table.row(session_row(status, names.at(status.session.observer)));
    std::cout << "\n" << table.text("  ");
    for (const SessionStatus& status : sessions) {
        if (status.session.end || !status.progress || status.presentations == 0) continue;
        std::cout << "\n  session " << status.session.session << ", open:\n" << track_table(*status.progress);
    }
    const auto has_note = [](const SessionStatus& status) { return !status.note.empty(); };
    if (std::any_of(sessions.begin(), sessions.end(), has_note)) std::cout << "\n";
    for (const SessionStatus& status : sessions) {
        if (has_note(status))
            std::cout << "  session " << status.session.session << ": " << printable(status.note) << "\n";
    }
    std::cout << "\n  trials: main ones of those expected. SD/bound: median over tracks of the estimate's SD over the "
                 "smallest possible.\n";
}

}  // namespace

void add_status_command(CLI::App& app) {
    auto* command =
        app.add_subcommand("status", "Say how far a study's sessions are and how sure of their thresholds.");
    const auto options = std::make_shared<StatusOptions>();
    command->add_option("--db", options->database, "the study's database")->required();
    command->add_flag("--json", options->as_json, "print JSON, each track included");
    command->callback([options] { print_status(*options); });
}

}  // namespace stairstep
