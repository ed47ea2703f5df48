#include "analysis/power.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/commands/commands.h"
#include "stimuli/error.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

struct Options {
    std::string effect = "slope-ratio=0.9";
    std::string observers = "5,10,15,20";
    std::string trials = "40";
    std::string texels = "5,10,20,30";
    double target = 0.8;
    SimulatedPopulation population;
    CoverageSettings settings{.studies = 200};
    bool as_json = false;
};

std::vector<int> counts(const std::string& text, const char* flag, int most) {
    std::vector<int> values;
    for (const double value : parse_number_list(text, flag)) {
        if (!(value >= 2 && value <= most) || value != static_cast<int>(value)) {
            throw InputError(flag, format_number(value) + " is out of range",
                             "use whole numbers from 2 to " + std::to_string(most));
        }
        values.push_back(static_cast<int>(value));
    }
    if (values.empty()) throw InputError(flag, "is empty", "use for example 10");
    return values;
}

nlohmann::ordered_json json(const std::vector<Power>& powers, const PlannedEffect& effect, const std::string& advice) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Power& power : powers) {
        const Interval ci = power.ci95();
        rows.push_back({{"observers", power.plan.observers},
                        {"trials_a_track", power.plan.trials_a_track},
                        {"texels_px", power.plan.texels_px},
                        {"trials_an_observer", power.plan.trials_an_observer(effect)},
                        {"studies", power.studies},
                        {"power", power.power()},
                        {"ci95", {ci.first, ci.second}}});
    }
    return {{"plans", rows}, {"plan", advice}};
}

void print_power(const Options& options) {
    const PlannedEffect effect = parse_effect(options.effect);
    require_valid(options.population);
    const std::vector<int> observers = counts(options.observers, "--observers", 1000);
    const std::vector<int> trials = counts(options.trials, "--trials", 10000);
    const std::vector<double> texels = parse_number_list(options.texels, "--texels");
    std::vector<StudyPlan> plans;
    for (const int trials_a_track : trials) {
        for (const int n : observers) plans.push_back({n, trials_a_track, texels});
    }
    Progress progress("simulating studies", static_cast<long>(plans.size()) * options.settings.studies);
    std::vector<Power> powers;
    for (const StudyPlan& plan : plans) {
        powers.push_back(power_of(plan, effect, options.population, options.settings, [&] { progress.advance(); }));
    }
    // The cheapest plan, in trials of all observers together, that reaches the target.
    const Power* best = nullptr;
    const auto cost = [&](const Power& p) { return p.plan.observers * p.plan.trials_an_observer(effect); };
    for (const Power& power : powers) {
        if (power.power() >= options.target && (!best || cost(power) < cost(*best))) best = &power;
    }
    const std::string advice = best ? sentence(*best, effect, options.population, options.settings)
                                    : "None of these plans reaches a power of " + format_number(options.target) + ".";
    if (options.as_json) {
        std::cout << json(powers, effect, advice).dump(2) << "\n";
        return;
    }
    std::cout << "observers  trials a track  trials an observer  power  95 % interval\n";
    for (const Power& power : powers) {
        const Interval ci = power.ci95();
        std::printf("%9d  %14d  %18d  %5.2f  %.2f to %.2f\n", power.plan.observers, power.plan.trials_a_track,
                    power.plan.trials_an_observer(effect), power.power(), ci.first, ci.second);
    }
    std::fflush(stdout);
    std::cout << "\n" << advice << "\n";
}

}  // namespace

void add_power_command(CLI::App& app) {
    auto* command =
        app.add_subcommand("power", "Simulate studies of several sizes and say with which power each finds an effect.");
    const auto options = std::make_shared<Options>();
    command->add_option("--effect", options->effect, "slope-ratio=0.9 (half contrast over full) or exponent=0.8")
        ->capture_default_str();
    command->add_option("--observers", options->observers, "numbers of observers to try")->capture_default_str();
    command->add_option("--trials", options->trials, "numbers of trials a track to try")->capture_default_str();
    command->add_option("--texels", options->texels, "texel sizes of a study, px")->capture_default_str();
    command->add_option("--target", options->target, "power that the plan should have")
        ->check(CLI::Range(0.01, 0.999))
        ->capture_default_str();
    command
        ->add_option("--between-observer-sd", options->population.between_observer_sd, "SD of ln c between observers")
        ->capture_default_str();
    command
        ->add_option("--deviation-sd", options->population.deviation_sd,
                     "SD of ln r between an observer's texel sizes, beyond the law")
        ->capture_default_str();
    command->add_option("--beta", options->population.shape.beta, "steepness of the psychometric function")
        ->capture_default_str();
    command->add_option("--lapse", options->population.shape.delta, "share of blind answers")->capture_default_str();
    command->add_option("--studies", options->settings.studies, "simulated studies a plan")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    command->add_option("--p", options->settings.p_threshold, "share of right answers that defines a threshold")
        ->check(CLI::Range(0.55, 0.9))
        ->capture_default_str();
    command->add_option("--seed", options->settings.seed, "same seed, same studies")->capture_default_str();
    command->add_option("--jobs", options->settings.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { print_power(*options); });
}

}  // namespace stairstep
