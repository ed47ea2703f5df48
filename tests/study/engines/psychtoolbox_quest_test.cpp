// Against Psychtoolbox itself: numbers that it gave once, kept in psychtoolbox_reference.csv, and live under Octave.
#include "study/engines/psychtoolbox_quest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/random.h"
#include "study/engines/quest.h"
#include "tests/support/command.h"
#include "tests/support/psychtoolbox_reference.h"

namespace stairstep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool equal(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-9;
}

TEST(PsychtoolboxQuest, GivesTheNumbersOfPsychtoolbox) {
    const auto references = psychtoolbox_references();
    ASSERT_GE(references.size(), 15u);
    for (size_t i = 0; i < references.size(); ++i) {
        SCOPED_TRACE("row " + std::to_string(i + 1));
        const PsychtoolboxReference& r = references[i];
        PsychtoolboxQuest quest(r.settings);
        for (const QuestTrial& trial : r.trials) quest.update(trial.intensity, trial.correct);
        EXPECT_NEAR(quest.mean(), r.mean, 1e-9);
        EXPECT_NEAR(quest.mode(), r.mode, 1e-9);
        EXPECT_NEAR(quest.quantile(), r.quantile, 1e-9);
        EXPECT_NEAR(quest.sd(), r.sd, 1e-9);
        EXPECT_NEAR(quest.estimate().low, r.low, 1e-9);
        EXPECT_NEAR(quest.estimate().high, r.high, 1e-9);
        EXPECT_NEAR(quest.quantile_order(), r.quantile_order, 1e-9);
        EXPECT_NEAR(quest.x_threshold(), r.x_threshold, 1e-9);
        EXPECT_EQ(quest.trials(), static_cast<int>(r.trials.size()));
    }
}

TEST(PsychtoolboxQuest, GivesTheNumbersPsychoPyIsTestedWith) {
    // PsychoPy's QUEST is a port of Psychtoolbox's; its test suite has this sequence.
    PsychtoolboxQuestSettings settings{.guess = 50, .guess_sd = 50};
    settings.range = 100;
    PsychtoolboxQuest quest(settings);
    const double intensities[] = {50,
                                  45.139710407074872,
                                  37.291086503930742,
                                  58.297413127139947,
                                  80.182967131096547,
                                  75.295251409003527,
                                  71.57627192423783,
                                  79.881680484036906,
                                  90.712313302815517,
                                  88.265808957695796};
    const bool correct[] = {true, true, false, false, true, true, false, false, true, true};
    for (int i = 0; i < 10; ++i) {
        // The intensities are the quantiles themselves, but for the first.
        if (i > 0) {
            EXPECT_NEAR(quest.suggest(), intensities[i], 1e-8) << i;
        }
        quest.update(intensities[i], correct[i]);
    }
    EXPECT_NEAR(quest.mean(), 86.0772169427, 1e-9);
    EXPECT_NEAR(quest.mode(), 80.11, 1e-9);
    EXPECT_NEAR(quest.quantile(), 86.3849031085, 1e-9);
}

TEST(PsychtoolboxQuest, InterpolatesTheThresholdsOffset) {
    // log10(−ln .205)/3.5 (Harvey 1986: .0571); the table's error shrinks with the square of its grain.
    PsychtoolboxQuestSettings settings;
    settings.shape = {.beta = 3.5, .gamma = 0, .delta = 0, .p_threshold = 0.795};
    const double exact = threshold_offset(settings.shape);
    EXPECT_NEAR(exact, 0.0571, 5e-5);
    EXPECT_NEAR(exact, std::log10(-std::log(0.205)) / 3.5, 1e-15);
    EXPECT_NEAR(PsychtoolboxQuest(settings).x_threshold(), exact, 5e-5);
    settings.grain = 0.001;
    EXPECT_NEAR(PsychtoolboxQuest(settings).x_threshold(), exact, 5e-7);
}

TEST(PsychtoolboxQuest, KeepsPsychtoolboxsFaults) {
    const auto after = [](PsychtoolboxQuestSettings settings, double intensity) {
        PsychtoolboxQuest quest(settings);
        quest.update(intensity, true);
        return quest;
    };
    PsychtoolboxQuestSettings settings;
    EXPECT_EQ(after(settings, -1 + 2.6).mean(), after(settings, -1 + 1e6).mean());  // beyond the range
    EXPECT_EQ(after(settings, -1 + 2.6).clamped_trials(), 1);
    EXPECT_EQ(after(settings, -0.5).clamped_trials(), 0);
    EXPECT_EQ(after(settings, -0.503).mean(), after(settings, -0.4996).mean());  // one grid point
    settings.shape.gamma = 0.9;
    EXPECT_EQ(PsychtoolboxQuest(settings).gamma(), 0.5);

    // Two answers are enough where nothing is put down to a slip, and nothing brings the posterior back.
    settings.shape = {.gamma = 0, .delta = 0};
    settings.range = 10;
    PsychtoolboxQuest vanished(settings);
    vanished.update(4, false);
    vanished.update(-6, true);
    vanished.update(-1, true);
    EXPECT_TRUE(std::isnan(vanished.mean()));
    EXPECT_THROW(vanished.quantile(), FailureError);
}

TEST(PsychtoolboxQuest, RefusesImpossibleSettings) {
    const auto refuses = [](auto change) {
        PsychtoolboxQuestSettings settings;
        change(settings);
        EXPECT_THROW(PsychtoolboxQuest{settings}, InputError);
    };
    refuses([](auto& s) { s.guess = kNaN; });
    refuses([](auto& s) { s.guess_sd = 0; });
    refuses([](auto& s) { s.grain = -1; });
    refuses([](auto& s) { s.range = 0; });
    refuses([](auto& s) { s.grain = 1e-9, s.range = 1; });
    refuses([](auto& s) { s.grain = 100; });  // the psychometric function is a step on this grid
    refuses([](auto& s) { s.shape.beta = 0; });
    refuses([](auto& s) { s.shape.delta = 1; });
    refuses([](auto& s) { s.shape.p_threshold = 0.999; });
    EXPECT_THROW(PsychtoolboxQuest({}).update(kNaN, true), InputError);
    EXPECT_THROW(PsychtoolboxQuest({}).quantile(1.1), InputError);
}

/// A case for the live comparison.
struct LiveCase {
    PsychtoolboxQuestSettings settings;
    std::vector<QuestTrial> trials;
};

template <typename T>
T one_of(Random& random, std::initializer_list<T> values) {
    return values.begin()[random.below(values.size())];
}

/// Any settings, sensible or not, and sequences that stay in the range, leave it, hit the middle between grid points, or
/// contradict themselves.
LiveCase random_case(Random& random, int trials) {
    LiveCase made;
    PsychtoolboxQuestSettings& s = made.settings;
    s.guess = one_of(random, {0.0, -1.0, 2.5, 50.0}) + one_of(random, {0.0, 1.0}) * random.normal();
    s.guess_sd = one_of(random, {1e-6, 0.05, 0.5, 1.0, 3.0, 50.0, 1e9});
    s.shape.gamma = one_of(random, {0.0, 0.02, 0.25, 0.5});
    s.shape.delta = one_of(random, {0.0, 0.01, 0.05, 0.2});
    s.shape.beta = std::exp(std::log(0.5) + random.uniform() * std::log(30.0));
    const double low = s.shape.gamma + 0.02;
    s.shape.p_threshold = low + random.uniform() * (0.99 - s.shape.delta * (1 - s.shape.gamma) - low);
    s.grain = one_of(random, {0.005, 0.01, 0.02, 0.05, 0.1, 0.07});
    if (random.below(3) > 0) s.range = one_of(random, {0.5, 1.0, 2.5, 4.2, 5.0, 5.01});

    const double width = s.range.value_or(500 * s.grain);
    const double truth = s.guess + 0.2 * width * (random.uniform() - 0.5);
    const double offset = threshold_offset(s.shape);
    const bool contradictory = random.below(4) == 0;
    for (int i = 0; i < trials; ++i) {
        double x = truth + 0.3 * random.normal();
        switch (random.below(10)) {
            case 0: x = s.guess + (static_cast<double>(random.below(400)) - 199.5) * s.grain; break;
            case 1: x = s.guess + width * random.normal(); break;
            case 2: x = one_of(random, {-1e12, -40.0, 40.0, 1e12}); break;
            default: break;
        }
        const double p = contradictory ? 0.5 : probability_correct(s.shape, offset, x, truth);
        made.trials.push_back({x, random.uniform() < p});
    }
    return made;
}

/// After how many trials the two are compared.
std::vector<size_t> checkpoints(size_t trials) {
    std::vector<size_t> at;
    for (const size_t n : {size_t{1}, size_t{10}, size_t{100}, trials}) {
        if (n <= trials && (at.empty() || n > at.back())) at.push_back(n);
    }
    return at;
}

/// One line of numbers for each checkpoint: mean, mode, quantile, quantiles .025 and .975, SD, order, offset. NaN where a
/// quantile is refused; a single "refused" where the settings are.
constexpr const char* kLiveScript = R"(
addpath('%/PsychBasic', '%/PsychProbability', '%/Quest');
function value = or_nan(f)
  try, value = f(); catch, value = NaN; end
end
file = fopen('cases.bin'); cases = fread(file, 1, 'double');
for c = 1:cases
  p = fread(file, 9, 'double'); d = reshape(fread(file, 2*p(9), 'double'), 2, []);
  try
    if isnan(p(8)), evalc('q = QuestCreate(p(1), p(2), p(3), p(4), p(5), p(6), p(7));');
    else, evalc('q = QuestCreate(p(1), p(2), p(3), p(4), p(5), p(6), p(7), p(8));'); end
  catch, printf('R refused\n'); continue; end
  q.normalizePdf = 1; q.warnPdf = 0; n = p(9);
  for k = 1:n
    q = QuestUpdate(q, d(1,k), d(2,k));
    if k == 1 || k == 10 || k == 100 || k == n
      printf('R %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n', QuestMean(q), QuestMode(q), or_nan(@() QuestQuantile(q)), or_nan(@() QuestQuantile(q, .025)), or_nan(@() QuestQuantile(q, .975)), real(QuestSd(q)), q.quantileOrder, q.xThreshold);
    end
  end
end
exit(0);
)";

std::string live_script() {
    std::string script;
    for (const char* c = kLiveScript; *c != '\0'; ++c) {
        // '%/ stands for Psychtoolbox's folder.
        if (std::strncmp(c, "'%/", 3) == 0) {
            script += "'/usr/share/psychtoolbox-3/";
            c += 2;
        } else {
            script += *c;
        }
    }
    return script;
}

void append(std::string& bytes, double value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary(const std::vector<LiveCase>& cases) {
    std::string bytes;
    append(bytes, static_cast<double>(cases.size()));
    for (const LiveCase& c : cases) {
        const PsychtoolboxQuestSettings& s = c.settings;
        for (const double value : {s.guess, s.guess_sd, s.shape.p_threshold, s.shape.beta, s.shape.delta, s.shape.gamma,
                                   s.grain, s.range.value_or(kNaN), static_cast<double>(c.trials.size())}) {
            append(bytes, value);
        }
        for (const QuestTrial& trial : c.trials) {
            append(bytes, trial.intensity);
            append(bytes, trial.correct ? 1 : 0);
        }
    }
    return bytes;
}

double or_nan(const PsychtoolboxQuest& quest, double order) {
    try {
        return quest.quantile(order);
    } catch (const FailureError&) {
        return kNaN;
    }
}

std::vector<double> numbers_of(const PsychtoolboxQuest& quest) {
    return {quest.mean(),           quest.mode(),         or_nan(quest, quest.quantile_order()),
            or_nan(quest, 0.025),   or_nan(quest, 0.975), quest.sd(),
            quest.quantile_order(), quest.x_threshold()};
}

std::vector<double> parse(const std::string& line) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));  // NA is NaN here
    return numbers;
}

TEST(PsychtoolboxQuest, AgreesWithPsychtoolboxLive) {
    if (run_command("octave-cli --version").exit_code != 0 ||
        !std::filesystem::exists("/usr/share/psychtoolbox-3/Quest/QuestCreate.m")) {
        if (std::getenv("STAIRSTEP_ALLOW_MISSING_ORACLES") != nullptr) {
            GTEST_SKIP() << "not compared with Psychtoolbox: it isn't installed, and that was allowed";
        }
        FAIL() << "octave and psychtoolbox-3-common are needed (./test.sh installs them); set "
                  "STAIRSTEP_ALLOW_MISSING_ORACLES=1 to do without this comparison";
    }
    Random random(20);
    std::vector<LiveCase> cases;
    for (int i = 0; i < 60; ++i) cases.push_back(random_case(random, 10 + static_cast<int>(random.below(120))));
    for (int i = 0; i < 3; ++i) cases.push_back(random_case(random, 1000));
    cases.push_back(random_case(random, 3000));

    const TemporaryFolder folder;
    write_file(folder.path() / "cases.bin", binary(cases));
    write_file(folder.path() / "live.m", live_script());
    const CommandResult octave =
        run_command("cd " + folder.path().string() + " && octave-cli --no-gui --norc -q live.m");
    ASSERT_EQ(octave.exit_code, 0) << octave.errors;

    std::vector<std::string> lines;
    std::istringstream output(octave.output);
    for (std::string line; std::getline(output, line);) {
        if (line.starts_with("R ")) lines.push_back(line.substr(2));
    }
    size_t next = 0;
    int refused = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        ASSERT_LT(next, lines.size());
        if (lines[next] == "refused") {
            ++next;
            ++refused;
            EXPECT_THROW(PsychtoolboxQuest{cases[i].settings}, InputError) << "case " << i;
            continue;
        }
        PsychtoolboxQuest quest(cases[i].settings);
        for (const QuestTrial& trial : cases[i].trials) {
            quest.update(trial.intensity, trial.correct);
            const auto at = checkpoints(cases[i].trials.size());
            if (std::find(at.begin(), at.end(), static_cast<size_t>(quest.trials())) == at.end()) continue;
            ASSERT_LT(next, lines.size());
            const std::vector<double> theirs = parse(lines[next++]);
            const std::vector<double> ours = numbers_of(quest);
            ASSERT_EQ(theirs.size(), ours.size());
            for (size_t k = 0; k < ours.size(); ++k) {
                EXPECT_TRUE(equal(ours[k], theirs[k])) << "case " << i << ", trial " << quest.trials() << ", number "
                                                       << k << ": " << ours[k] << " against " << theirs[k];
            }
        }
    }
    EXPECT_EQ(next, lines.size());
    EXPECT_LT(refused, 20);  // most cases say something
}

}  // namespace
}  // namespace stairstep
