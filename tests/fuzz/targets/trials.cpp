#include <cmath>
#include <nlohmann/json.hpp>

#include "study/trials_csv.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

/// All that trials.csv keeps exactly: response times are written to 0.1 ms.
bool same(const Trial& a, const Trial& b) {
    return a.study == b.study && a.observer == b.observer && a.session == b.session &&
           a.presentation == b.presentation && a.round == b.round && a.track == b.track && a.trial == b.trial &&
           a.kind == b.kind && a.task == b.task && a.condition == b.condition &&
           a.suggested_radius_px == b.suggested_radius_px && a.radius_px == b.radius_px && a.stimulus == b.stimulus &&
           a.response == b.response && a.is_void == b.is_void;
}

}  // namespace

void run_trials(std::string_view input) {
    std::vector<Trial> trials;
    if (!accepted([&] { trials = read_trials_csv(InputFile(input).path()); })) return;
    require(!trials.empty() && trials.size() <= input.size(), "there are trials, and no more than bytes");
    for (const Trial& trial : trials) {
        require(std::isfinite(trial.strength()), "a trial's strength is finite");
        require(std::isfinite(trial.response_time_s), "a response time is finite");
        // Results name observers in JSON, which holds UTF-8 alone; dump throws for anything else.
        nlohmann::json(trial.observer).dump();
        nlohmann::json(trial.study).dump();
    }
    const std::vector<Trial> again = read_trials_csv(InputFile(trials_csv(trials)).path());
    require(again.size() == trials.size(), "as many trials are read back as were written");
    for (size_t i = 0; i < trials.size(); ++i)
        require(same(again[i], trials[i]), "a trial reads back as it was written");
}

}  // namespace stairstep::fuzz
