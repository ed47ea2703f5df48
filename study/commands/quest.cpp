#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/io/program.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"
#include "study/answer_stream.h"
#include "study/commands/commands.h"
#include "study/engines/psychtoolbox_quest.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

constexpr const char* kSource = "standard input";

struct QuestOptions {
    PsychtoolboxQuestSettings settings;
    std::optional<double> quantile_order;
    std::string engine = "psychtoolbox";
    bool as_json = false;
};

struct Posterior {
    double mean = 0;
    double mode = 0;
    double quantile = 0;
    double sd = 0;
    int trials = 0;
    double quantile_order = 0;
};

/// Refuses what no engine can do with, naming the flag.
void require_valid(const QuestOptions& options) {
    const auto require = [](bool holds, const char* flag, double value, const std::string& what) {
        if (!holds) throw InputError(flag, format_number(value) + " " + what, "see stairstep-study quest --help");
    };
    const auto above_zero = [](double value) { return value > 0 && std::isfinite(value); };
    const PsychtoolboxQuestSettings& s = options.settings;
    const double beta = s.shape.beta, gamma = s.shape.gamma, delta = s.shape.delta, p = s.shape.p_threshold;
    require(std::isfinite(s.guess), "--guess", s.guess, "is not finite");
    require(above_zero(s.guess_sd), "--guess-sd", s.guess_sd, "is no finite number above 0");
    require(above_zero(beta), "--beta", beta, "is no finite number above 0");
    require(gamma >= 0 && gamma < 1, "--gamma", gamma, "is not in [0, 1)");
    require(delta >= 0 && delta < 1, "--delta", delta, "is not in [0, 1)");
    const double most = 1 - delta * (1 - gamma);
    require(p > gamma && p < most, "--p-threshold", p,
            "is not between --gamma and 1 - delta*(1 - gamma), here " + format_number(gamma) + " and " +
                format_number(most));
    require(above_zero(s.grain), "--grain", s.grain, "is no finite number above 0");
    if (s.range) {
        require(above_zero(*s.range), "--range", *s.range, "is no finite number above 0");
        require(*s.range / s.grain <= 1e6, "--range", *s.range, "is more than 10^6 times --grain");
    }
    if (options.quantile_order) {
        const double order = *options.quantile_order;
        require(order >= 0 && order <= 1, "--quantile-order", order, "is no probability");
    }
}

/// Size of what stands behind standard input, 0 where that isn't known.
long input_size() {
    struct stat status {};
    if (fstat(STDIN_FILENO, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
    return static_cast<long>(status.st_size);
}

/// Gives the engine all trials of standard input, one by one.
template <typename Engine>
void read_trials(Engine& engine) {
    if (isatty(STDIN_FILENO) != 0) {
        throw InputError(kSource, "is a terminal", "give it trials: stairstep-study quest < trials.csv");
    }
    AnswerStream answers(stdin, kSource);
    Progress progress("reading trials, bytes", input_size());
    long bytes = 0;
    while (const auto answer = answers.next()) {
        engine.update(answer->intensity, answer->correct);
        if (answers.bytes() != bytes) progress.advance(answers.bytes() - bytes);
        bytes = answers.bytes();
    }
    if (engine.trials() == 0) throw InputError(kSource, "has no trials", "rows of intensity,response are needed");
}

Posterior psychtoolbox_posterior(const QuestOptions& options) {
    PsychtoolboxQuest quest(options.settings);
    read_trials(quest);
    if (quest.clamped_trials() > 0) {
        const std::string message = std::to_string(quest.clamped_trials()) +
                                    " intensities lie beyond the range and count as its ends, as in Psychtoolbox; a "
                                    "larger --range, or --engine stairstep, tells them apart";
        warn(kSource, message.c_str());
    }
    const double order = options.quantile_order.value_or(quest.quantile_order());
    return {quest.mean(), quest.mode(), quest.quantile(order), quest.sd(), quest.trials(), order};
}

Posterior stairstep_posterior(const QuestOptions& options) {
    QuestSettings settings{.guess = options.settings.guess, .guess_sd = options.settings.guess_sd};
    settings.shape = options.settings.shape;
    settings.grain = options.settings.grain;
    settings.range = options.settings.range.value_or(500 * settings.grain);
    if (!(settings.range > 2 * settings.grain)) {
        throw InputError("--range", format_number(settings.range) + " is not more than two grains",
                         "choose a larger one, or a smaller --grain");
    }
    Quest quest(settings);
    read_trials(quest);
    const double order = options.quantile_order.value_or(best_quantile_order(settings.shape));
    return {quest.mean(), quest.mode(), quest.quantile(order), quest.sd(), quest.trials(), order};
}

void print_posterior(const QuestOptions& options) {
    require_valid(options);
    const Posterior p = options.engine == "stairstep" ? stairstep_posterior(options) : psychtoolbox_posterior(options);
    if (options.as_json) {
        std::cout << nlohmann::ordered_json{{"mean", p.mean},
                                            {"mode", p.mode},
                                            {"quantile", p.quantile},
                                            {"sd", p.sd},
                                            {"trials", p.trials}}
                         .dump(2)
                  << "\n";
        return;
    }
    char text[200];
    std::snprintf(text, sizeof text,
                  "mean      %.6g\nmode      %.6g\nquantile  %.6g  (order %.4g)\nsd        %.6g\ntrials    %d\n",
                  p.mean, p.mode, p.quantile, p.quantile_order, p.sd, p.trials);
    std::cout << text;
}

}  // namespace

void add_quest_command(CLI::App& app) {
    auto* command = app.add_subcommand(
        "quest",
        "Print the QUEST posterior of the threshold after the trials on standard input, CSV with the columns\n"
        "intensity,response (0 or 1). The numbers are those of Psychtoolbox's QuestMean, QuestMode, QuestQuantile\n"
        "and QuestSd, its rounding and clamping included. Psychtoolbox has no defaults but for grain and range;\n"
        "those here are what its QuestDemo proposes.");
    const auto options = std::make_shared<QuestOptions>();
    PsychtoolboxQuestSettings& s = options->settings;
    command->add_option("--guess", s.guess, "prior mean of the threshold")->capture_default_str();
    command->add_option("--guess-sd", s.guess_sd, "prior standard deviation")->capture_default_str();
    command->add_option("--p-threshold", s.shape.p_threshold, "probability of response 1 at threshold")
        ->capture_default_str();
    command->add_option("--beta", s.shape.beta, "slope of the Weibull function")->capture_default_str();
    command->add_option("--delta", s.shape.delta, "share of blind answers")->capture_default_str();
    command->add_option("--gamma", s.shape.gamma, "probability of response 1 at no intensity")->capture_default_str();
    command->add_option("--grain", s.grain, "distance of the grid's points")->capture_default_str();
    command->add_option("--range", s.range, "width of the grid around the guess; without it, 500 grains");
    command->add_option("--quantile-order", options->quantile_order,
                        "order of the quantile; without it, the one at which a trial tells most");
    command
        ->add_option("--engine", options->engine,
                     "psychtoolbox, or stairstep: no rounding to the grid, no clamping to the range")
        ->check(CLI::IsMember({"psychtoolbox", "stairstep"}))
        ->capture_default_str();
    command->add_flag("--json", options->as_json, "print JSON: mean, mode, quantile, sd, trials");
    command->callback([options] { print_posterior(*options); });
}

}  // namespace stairstep
