// stairstep-analyze fit, on files that strain it: the right answer, a wider interval, or why there is none. No file has a NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <regex>

#include "analysis/law/law_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/random.h"
#include "study/psychometric.h"
#include "study/trials_csv.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

constexpr double kSlope = 3;

struct MadeTrials {
    int observers = 6;
    std::vector<double> texels_px{5, 10, 20};
    int trials_a_track = 60;
    /// The observers' steepness.
    double beta = 3.5;
    /// Right exactly where the radius is below the threshold.
    bool separable = false;
};

/// Radii spread over a factor of three to either side of a threshold that differs a little between observers.
std::vector<Trial> made_trials(const MadeTrials& made, uint64_t seed = 1) {
    std::vector<Trial> trials;
    const PsychometricShape shape{.beta = made.beta, .gamma = 0.5, .delta = 0.01, .p_threshold = 0.82};
    for (int i = 0; i < made.observers; ++i) {
        Random random = Random(seed).stream(static_cast<uint64_t>(i));
        const double slope = kSlope * std::exp(0.06 * (i - (made.observers - 1) / 2.0));
        for (const double a : made.texels_px) {
            for (int k = 0; k < made.trials_a_track; ++k) {
                Trial trial;
                trial.observer = "o" + std::to_string(i);
                trial.condition = {Pattern::step, KernelShape::box, 1, a};
                trial.radius_px = a * slope * std::pow(10, random.uniform() - 0.5);
                const double strength = std::log10(a / trial.radius_px);
                const double threshold = -std::log10(slope);
                const double right = probability_correct(shape, threshold_offset(shape), strength, threshold);
                const bool correct = made.separable ? strength > threshold : random.uniform() < right;
                trial.stimulus = random.below(2) == 0 ? Judgement::artifact : Judgement::line;
                const Judgement other = trial.stimulus == Judgement::artifact ? Judgement::line : Judgement::artifact;
                trial.response = correct ? trial.stimulus : other;
                trials.push_back(trial);
            }
        }
    }
    return trials;
}

class FitCommand : public testing::Test {
  protected:
    CommandResult fit(const std::vector<Trial>& trials) {
        write_file(folder_.path() / "trials.csv", trials_csv(trials));
        std::filesystem::remove(folder_.path() / "law.json");
        return run_command("cd " + folder_.path().string() + " && " + program("stairstep-analyze") +
                           " fit trials.csv --out law.json --bootstrap 200");
    }

    /// What a number that is none is printed as. What isn't known is null.
    inline static const std::regex kNoNumber{"\\b(nan|inf)\\b"};

    /// The law, which has no number that is none.
    Law fitted(const std::vector<Trial>& trials) {
        const CommandResult result = fit(trials);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        if (result.exit_code != 0) return {};
        for (const std::string& text : {read_file(folder_.path() / "law.json"), result.output, result.errors}) {
            EXPECT_FALSE(std::regex_search(text, kNoNumber)) << text;
        }
        output_ = result.output;
        return read_law(folder_.path() / "law.json");
    }

    void expect_none(const std::vector<Trial>& trials, const std::string& because) {
        const CommandResult result = fit(trials);
        EXPECT_EQ(result.exit_code, 1) << result.output;
        EXPECT_NE(result.errors.find("can't be estimated, because " + because), std::string::npos) << result.errors;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "law.json"));
    }

    TemporaryFolder folder_;
    std::string output_;
};

void expect_near(const Law& law, double slope, double tolerance = 0.1) {
    EXPECT_NEAR(std::log(law.slope / slope), 0, tolerance);
    EXPECT_LT(law.slope_ci95.first, slope);
    EXPECT_GT(law.slope_ci95.second, slope);
}

double width(const Law& law) {
    return std::log(law.slope_ci95.second / law.slope_ci95.first);
}

TEST_F(FitCommand, SaysWhyThereIsNoLaw) {
    expect_none(made_trials({.observers = 1}), "only one observer (o0) has thresholds");
    expect_none({made_trials({}).front()}, "no observer's trials bound a threshold");
    std::vector<Trial> trials = made_trials({});
    for (Trial& trial : trials) trial.response = trial.stimulus;
    expect_none(trials, "no observer's trials bound a threshold");
    for (Trial& trial : trials) {
        trial.response = trial.stimulus == Judgement::line ? Judgement::artifact : Judgement::line;
    }
    expect_none(trials, "no observer's trials bound a threshold");
}

TEST_F(FitCommand, FewSizesAndFarOnes) {
    expect_near(fitted(made_trials({.texels_px = {10, 20}})), kSlope);
    const Law one_size = fitted(made_trials({.texels_px = {10}}));
    expect_near(one_size, kSlope);
    EXPECT_FALSE(one_size.conditions[0].has_form);
    EXPECT_NE(output_.find("not estimated"), std::string::npos) << output_;
    const Law far = fitted(made_trials({.texels_px = {1e-3, 1e6}}));
    expect_near(far, kSlope);
    EXPECT_NEAR(far.conditions[0].exponent, 1, 0.02);
}

TEST_F(FitCommand, DuplicatedRowsChangeNoSlope) {
    std::vector<Trial> trials = made_trials({});
    const Law once = fitted(trials);
    expect_near(once, kSlope);
    const std::vector<Trial> copy = trials;
    trials.insert(trials.end(), copy.begin(), copy.end());
    const Law twice = fitted(trials);
    EXPECT_EQ(twice.trials, 2 * once.trials);
    EXPECT_NEAR(std::log(twice.slope / once.slope), 0, 0.05);
    // Observers, not rows, are the unit.
    EXPECT_GT(width(twice), 0.5 * width(once));
}

TEST_F(FitCommand, SeparableAnswersHaveTheirStep) {
    // A slope at the upper bound of what the prior allows. Guessing gives half of right answers where nothing is seen, so that a
    // function's foot, not its .82, lies where all answers turn wrong: c is a little below, never above.
    const Law law = fitted(made_trials({.separable = true}));
    EXPECT_LT(law.slope, kSlope * 1.02);
    EXPECT_GT(law.slope, kSlope * 0.75);
}

TEST_F(FitCommand, HardlyAnySlopeWidensTheIntervalOrLeavesNone) {
    const double usual = width(fitted(made_trials({})));
    const std::vector<Trial> flat = made_trials({.beta = 0.4});
    const CommandResult result = fit(flat);
    if (result.exit_code == 0) {
        EXPECT_GT(width(fitted(flat)), 1.5 * usual);
    } else {
        expect_none(flat, "");
    }
}

TEST_F(FitCommand, FollowsTheUnitsOfItsColumns) {
    const std::vector<Trial> trials = made_trials({});
    const Law law = fitted(trials);
    for (const double scale : {1e-8, 1e8}) {
        std::vector<Trial> in_other_unit = trials;
        for (Trial& trial : in_other_unit) {
            trial.condition.texel_px *= scale;
            trial.radius_px *= scale;
        }
        const Law same = fitted(in_other_unit);
        EXPECT_NEAR(same.slope, law.slope, 1e-6 * law.slope);
        EXPECT_NEAR(same.slope_ci95.second, law.slope_ci95.second, 1e-5 * law.slope);
        EXPECT_NEAR(same.conditions[0].exponent, law.conditions[0].exponent, 1e-5);
        std::vector<Trial> wide = trials;
        for (Trial& trial : wide) trial.radius_px *= scale;
        EXPECT_NEAR(fitted(wide).slope / scale, law.slope, 1e-6 * law.slope);
    }
}

TEST_F(FitCommand, SameSeedSameBytesOnAnyNumberOfThreads) {
    write_file(folder_.path() / "trials.csv", trials_csv(made_trials({.observers = 4})));
    const auto bytes = [&](int jobs) {
        const CommandResult result =
            run_command("cd " + folder_.path().string() + " && " + program("stairstep-analyze") +
                        " fit trials.csv --out law.json --bootstrap 300 --seed 5 --jobs " + std::to_string(jobs));
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return read_file(folder_.path() / "law.json");
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

}  // namespace
}  // namespace stairstep
