#include "study/bench/timing.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <sstream>

#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "stimuli/random.h"
#include "study/bench/simulated_tracks.h"
#include "study/engines/law_directed.h"
#include "study/engines/psi_marginal.h"
#include "study/engines/psychtoolbox_quest.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

constexpr int kTrials = 60;
constexpr int kLawTracks = 4;

/// The upper of the two in the middle where their number is even.
double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <typename Work>
double seconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The median over tracks of a trial's time. A clock is too slow to be read twice a trial, so each track is timed as a whole
/// with the answers of a track that was run before: same luck, same intensities, same answers.
template <AdaptiveEngine E>
double median_trial_s(const E& fresh, int tracks, uint64_t seed) {
    TrackSimulation simulation;
    simulation.seed = seed;
    std::vector<double> times;
    for (int track = 0; track < tracks; ++track) {
        TrackObserver observer(simulation, track);
        std::vector<bool> answers;
        E rehearsal(fresh);
        for (int trial = 0; trial < kTrials; ++trial) {
            const double intensity = rehearsal.suggest();
            answers.push_back(observer.answers_correctly(intensity));
            rehearsal.update(intensity, answers.back());
        }
        E engine(fresh);
        times.push_back(seconds([&] {
                            for (const bool correct : answers) engine.update(engine.suggest(), correct);
                        }) /
                        kTrials);
    }
    return median(std::move(times));
}

/// The same for one observer's four tracks together, 160 trials.
double median_law_directed_s(int rounds, uint64_t seed) {
    const LawDirected fresh({.tracks = kLawTracks});
    TrackSimulation simulation;
    simulation.seed = seed;
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
        TrackObserver observer(simulation, round);
        LawDirected engine(fresh);
        double total = 0;
        for (int trial = 0; trial < 40 * kLawTracks; ++trial) {
            LawDirected::Suggestion next;
            total += seconds([&] { next = engine.suggest(); });
            const bool correct = observer.answers_correctly(next.intensity);
            total += seconds([&] { engine.update(next.track, next.intensity, correct); });
        }
        times.push_back(total / (40 * kLawTracks));
    }
    return median(std::move(times));
}

/// QuestQuantile and QuestUpdate are timed, and the observer between them is not.
constexpr const char* kOctaveScript = R"(
tracks = TRACKS; trials = TRIALS; rand('twister', SEED); randn('twister', SEED);
for t = 1:tracks
  evalc('q = QuestCreate(0, .5, .82, 3.5, .01, .5, .01, 5);');
  q.normalizePdf = 1; q.warnPdf = 0; threshold = .5*randn; spent = 0;
  for k = 1:trials
    start = tic; x = QuestQuantile(q); spent = spent + toc(start);
    p = .005 + .99*(1 - .5*exp(-10^(3.5*(x - threshold + q.xThreshold))));
    correct = rand < p;
    start = tic; q = QuestUpdate(q, x, correct); spent = spent + toc(start);
  end
  printf('R %.17g\n', spent/trials);
end
exit(0);
)";

std::string with(std::string text, const std::string& word, const std::string& value) {
    const size_t at = text.find(word);
    return text.replace(at, word.size(), value);
}

/// A text between the quotes of Octave, or of a shell, given how they write a quote inside.
std::string quoted(const std::string& text, const char* quote) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string(quote) : std::string(1, c);
    return result + "'";
}

std::string timing_script(const std::filesystem::path& psychtoolbox, int tracks, int trials, uint64_t seed) {
    std::string paths = "addpath(";
    for (const char* folder : {"PsychBasic", "PsychProbability", "Quest"}) {
        paths += (paths.back() == '(' ? "" : ", ") + quoted((psychtoolbox / folder).string(), "''");
    }
    std::string script = with(kOctaveScript, "TRACKS", std::to_string(tracks));
    script = with(std::move(script), "TRIALS", std::to_string(trials));
    // Both generators take seeds below 2³².
    for (int i = 0; i < 2; ++i) script = with(std::move(script), "SEED", std::to_string(seed % 4294967296));
    return paths + ");" + script;
}

}  // namespace

PsychtoolboxTimes time_psychtoolbox(const std::filesystem::path& psychtoolbox, int tracks, int trials, uint64_t seed) {
    if (!std::filesystem::exists(psychtoolbox / "Quest" / "QuestCreate.m")) {
        return {.missing = "Psychtoolbox isn't in " + psychtoolbox.string()};
    }
    if (std::system("octave-cli --version >/dev/null 2>&1") != 0) return {.missing = "octave-cli isn't installed"};
    const TemporaryFolder folder;
    write_file(folder.path() / "timing.m", timing_script(psychtoolbox, tracks, trials, seed));
    const std::string command = "cd " + quoted(folder.path().string(), "'\\''") +
                                " && octave-cli --no-gui --norc -q timing.m >times.txt 2>errors.txt </dev/null";
    if (std::system(command.c_str()) != 0) return {.missing = "Psychtoolbox failed under Octave"};
    PsychtoolboxTimes times;
    std::istringstream lines(read_file(folder.path() / "times.txt"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("R ")) continue;
        if (const std::optional<double> time = parse_number(line.substr(2))) times.track_s.push_back(*time);
    }
    if (times.track_s.empty()) times.missing = "Psychtoolbox printed no times under Octave";
    return times;
}

BenchTable measure_times(const TimingSettings& settings) {
    BenchTable table{.name = "time",
                     .title = "Time per trial (suggest and update)",
                     .columns = {"engine", "tracks", "us_per_trial", "psychtoolbox_ratio"}};
    const int slow_tracks = std::max(5, settings.tracks / 10);
    Progress progress("measuring times, engines", 5);

    const QuestSettings quest_settings{.range = 5};
    // Before and after Psychtoolbox: the ratio is of times under the same load, as nearly as can be.
    const double quest_before_s = median_trial_s(Quest(quest_settings), settings.tracks, settings.seed);
    const PsychtoolboxTimes reference =
        time_psychtoolbox(settings.psychtoolbox, std::max(5, settings.tracks / 10), kTrials, settings.seed);
    progress.advance();
    const double quest_after_s = median_trial_s(Quest(quest_settings), settings.tracks, settings.seed);
    const double quest_s = (quest_before_s + quest_after_s) / 2;
    progress.advance();
    const double nothing = std::nan("");
    const double reference_s = reference.track_s.empty() ? nothing : median(reference.track_s);

    const auto add = [&](const char* engine, int tracks, double time_s, std::optional<double> limit_us) {
        BenchRow row{{engine, tracks, {1e6 * time_s, 2}, {reference_s / time_s, 1}}};
        if (limit_us) row.bar = at_most(1e6 * time_s, *limit_us, 0);
        table.rows.push_back(std::move(row));
    };
    table.rows.push_back({{"Psychtoolbox under Octave, 501 points",
                           static_cast<int>(reference.track_s.size()),
                           {1e6 * reference_s, 2},
                           {reference.track_s.empty() ? nothing : 1, 1}}});
    add("Quest, 501 points", 2 * settings.tracks, quest_s, 2);
    const BenchBar ratio_bar = at_least(reference_s / quest_s, 500, 0);
    table.rows.push_back({{"Quest, times faster than Psychtoolbox", {}, {}, {reference_s / quest_s, 1}}, ratio_bar});
    add("PsychtoolboxQuest, 501 points, the same numbers", settings.tracks,
        median_trial_s(PsychtoolboxQuest({.guess = 0, .guess_sd = 0.5, .range = 5}), settings.tracks, settings.seed),
        std::nullopt);
    add("minimum entropy, 501 points", slow_tracks,
        median_trial_s(PsiMarginal(minimum_entropy_settings(quest_settings)), slow_tracks, settings.seed),
        std::nullopt);
    progress.advance();
    add("psi-marginal, 251 thresholds x 52 shapes", slow_tracks,
        median_trial_s(PsiMarginal(PsiMarginalSettings{}), slow_tracks, settings.seed), 300);
    progress.advance();
    const int law_rounds = std::max(3, slow_tracks / 3);
    add("LawDirected, 4 tracks, 501 points x 6 shapes", law_rounds, median_law_directed_s(law_rounds, settings.seed),
        5000);
    progress.advance();

    table.notes = {
        "Medians over tracks of 60 trials (160 for LawDirected), wall time, one thread. Times are this machine's, with "
        "whatever else ran on it; ratios to Psychtoolbox, which ran in the same minute, are what counts."};
    if (!reference.missing.empty()) {
        table.notes.push_back("No ratios: " + reference.missing + ". Debian has octave and psychtoolbox-3-common.");
    }
    return table;
}

}  // namespace stairstep
