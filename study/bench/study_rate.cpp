#include "study/bench/study_rate.h"

#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/io/progress.h"
#include "stimuli/io/temporary_folder.h"
#include "study/design_json.h"
#include "study/session.h"
#include "study/simulation.h"
#include "study/store.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// A new folder for the database, removed with all that is in it.
class DatabaseFolder {
  public:
    explicit DatabaseFolder(const fs::path& parent) {
        if (parent.empty()) {
            temporary_.emplace();
            path_ = temporary_->path();
            return;
        }
        path_ = parent / ("stairstep-bench." + std::to_string(getpid()));
        std::error_code error;
        if (!fs::create_directory(path_, error)) {
            throw FailureError(path_.string(), "can't be made as a new folder", "name another --folder");
        }
    }
    ~DatabaseFolder() {
        std::error_code ignored;
        if (!temporary_) fs::remove_all(path_, ignored);
    }
    DatabaseFolder(const DatabaseFolder&) = delete;
    DatabaseFolder& operator=(const DatabaseFolder&) = delete;

    const fs::path& path() const { return path_; }

  private:
    std::optional<TemporaryFolder> temporary_;
    fs::path path_;
};

/// Runs all sessions; returns how many trials they had.
long run_sessions(const Design& design, const Simulation& simulation, TrialStore* store, Progress& progress) {
    long trials = 0;
    for (int i = 0; i < simulation.observers; ++i) {
        SessionRecord record = session_record(simulation, i);
        if (store != nullptr) record.session = store->begin_session(record);
        Session session(design, identity_of(record));
        run_session(session, simulated_observer(simulation, i), {.record = [&](const Trial& trial) {
                        if (store != nullptr) store->append(trial);
                        ++trials;
                    }});
        if (store != nullptr) store->end_session(record.session, SessionEnd::finished);
        progress.advance();
    }
    return trials;
}

}  // namespace

BenchTable measure_study_rate(const StudyRateSettings& settings) {
    const Design design;
    const Simulation simulation{.observers = settings.observers, .seed = settings.seed, .population = {}};
    BenchTable table{.name = "study",
                     .title = "A whole simulated study",
                     .columns = {"store", "observers", "trials", "seconds", "trials_per_s", "us_per_trial"}};
    Progress progress("simulating studies, observers", 3L * settings.observers);
    const auto measure = [&](const char* name, const fs::path& database) {
        const auto start = std::chrono::steady_clock::now();
        std::optional<TrialStore> store;
        if (!database.empty()) {
            store.emplace(
                TrialStore::create(database, design.name, to_json(design).dump(), to_json(simulation).dump()));
        }
        const long trials = run_sessions(design, simulation, store ? &*store : nullptr, progress);
        store.reset();
        const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const auto count = static_cast<double>(trials);
        table.rows.push_back(
            {{name, settings.observers, {count, 0}, {time_s, 3}, {count / time_s, 0}, {1e6 * time_s / count, 1}}});
    };
    const DatabaseFolder folder(settings.folder);
    measure("none", {});
    measure("in memory", ":memory:");
    measure("on disk", folder.path() / "study.sqlite");
    table.notes = {
        "One thread. On disk each trial waits for one fsync, which is this disk's figure and not the program's; the "
        "other "
        "two rows are what the program itself takes."};
    return table;
}

}  // namespace stairstep
