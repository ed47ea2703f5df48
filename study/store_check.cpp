#include "study/store_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "study/database_file.h"
#include "study/design_json.h"
#include "study/simulation.h"
#include "study/store.h"

namespace stairstep {
namespace {

/// So many lines of one kind are enough.
constexpr int kMostLines = 100;

/// Whether the file starts as a study does that we can read: SQLite's magic, and in its header the schema's version (byte 60)
/// and our application id (byte 68). What such a file has wrong further on is damage; anything else is another file.
bool starts_as_study(const std::filesystem::path& path) {
    std::array<unsigned char, 72> header{};
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(header.data()), header.size());
    const auto number_at = [&header](size_t place) {
        uint32_t number = 0;
        for (size_t i = place; i < place + 4; ++i) number = number << 8 | header[i];
        return number;
    };
    return file && std::equal(header.begin(), header.begin() + 16, "SQLite format 3") &&
           number_at(68) == kApplicationId && number_at(60) >= 1 && number_at(60) <= kSchemaVersion;
}

void check_integrity(const SQLite::Database& database, std::vector<std::string>& problems) {
    SQLite::Statement integrity(database, "PRAGMA integrity_check(" + std::to_string(kMostLines) + ")");
    while (integrity.executeStep()) {
        const std::string line = integrity.getColumn(0).getString();
        if (line != "ok") problems.push_back("integrity: " + line);
    }
    SQLite::Statement keys(database, "PRAGMA foreign_key_check");
    for (int lines = 0; lines < kMostLines && keys.executeStep(); ++lines) {
        problems.push_back("foreign key: " + keys.getColumn(0).getString() + " row " +
                           std::to_string(keys.getColumn(1).getInt64()) + " refers to a " +
                           keys.getColumn(2).getString() + " that isn't there");
    }
    for (const std::string& fault : schema_faults(database)) problems.push_back("schema: " + fault);
}

/// Notes problems of one session's trials.
class SessionCheck {
  public:
    SessionCheck(const std::string& session, std::vector<std::string>& problems)
        : session_(session), problems_(problems) {}

    void require(bool holds, const Trial& trial, const std::string& problem) {
        if (holds || ++lines_ > kMostLines) return;
        problems_.push_back(session_ + ", presentation " + std::to_string(trial.presentation) + ": " + problem);
    }

  private:
    std::string session_;
    std::vector<std::string>& problems_;
    int lines_ = 0;
};

/// What can be said of trials one by one. Returns whether they are numbered without a gap.
bool check_trials(const std::vector<Trial>& trials, const std::optional<Design>& design, const std::string& session,
                  std::vector<std::string>& problems) {
    SessionCheck check(session, problems);
    int expected = 1;
    bool gapless = true;
    double previous_s = -std::numeric_limits<double>::infinity();
    for (const Trial& trial : trials) {
        if (trial.presentation != expected) {
            gapless = false;
            check.require(false, trial, "comes where " + std::to_string(expected) + " should");
        }
        expected = trial.presentation < std::numeric_limits<int>::max() ? trial.presentation + 1 : 1;
        check.require(trial.shown_at_s >= previous_s, trial, "was shown before the one before it");
        previous_s = trial.shown_at_s;
        check.require(trial.response_time_s > 0 && std::isfinite(trial.response_time_s), trial,
                      "has the response time " + format_number(trial.response_time_s) + " s");
        check.require(trial.dropped_frames >= 0, trial, "has a negative number of dropped frames");
        if (design) {
            check.require(trial.radius_px >= design->smallest_radius_px && trial.radius_px <= design->largest_radius_px,
                          trial,
                          "has a radius of " + format_number(trial.radius_px) + " px, which the display doesn't show");
        }
    }
    return gapless;
}

void check_session(const TrialStore& store, const SessionRecord& record, const std::optional<Design>& design,
                   StoreReport& report) {
    const std::string session = "session " + std::to_string(record.session);
    const std::vector<Trial> trials = store.trials(record.session);
    report.trials += trials.size();
    const bool gapless = check_trials(trials, design, session, report.problems);
    if (record.schema != kSchemaVersion) {
        report.not_replayed.push_back(record.session);
        return;
    }
    // Where some are missing, those after them can't be derived.
    if (!design || !gapless) return;
    const std::string source = "replay";
    try {
        const Session replayed = resumed_session(*design, identity_of(record), trials, source);
        if (record.end == SessionEnd::finished && replayed.next()) {
            report.problems.push_back(session + ": is marked as finished, but presentation " +
                                      std::to_string(replayed.next()->presentation) + " was still to come");
        }
    } catch (const InputError& e) {
        // "replay: session 1, presentation 3: problem: remedy"; the remedy is for going on.
        const std::string text = std::string(e.what()).substr(source.size() + 2);
        report.problems.push_back(text.substr(0, text.rfind(": ")));
    }
}

/// Runs a part of the check; what it throws is a problem too, and the other parts run all the same.
template <typename Part>
void note_problems(const std::filesystem::path& path, StoreReport& report, const Part& part) {
    try {
        try {
            part();
        } catch (const SQLite::Exception& e) {
            rethrow(path, e);
        }
    } catch (const Error& e) {
        report.problems.push_back(e.what());
    }
}

void check_content(const std::filesystem::path& path, StoreReport& report) {
    const TrialStore store = TrialStore::open(path);
    report.study = store.study();
    std::optional<Design> design;
    note_problems(path, report, [&] { design = design_from_json(store.design_json(), "design"); });
    const std::vector<SessionRecord> sessions = store.sessions();
    report.sessions = sessions.size();
    for (const SessionRecord& record : sessions) {
        note_problems(path, report, [&] { check_session(store, record, design, report); });
    }
}

}  // namespace

StoreReport check_store(const std::filesystem::path& path) {
    StoreReport report;
    try {
        const SQLite::Database database = open_as_it_is(path);
        report.schema = schema_version(database);
        note_problems(path, report, [&] { check_integrity(database, report.problems); });
    } catch (const InputError& e) {
        if (!starts_as_study(path)) throw;
        report.problems.push_back(e.what());
        return report;
    }
    note_problems(path, report, [&] { check_content(path, report); });
    return report;
}

}  // namespace stairstep
