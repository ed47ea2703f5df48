#include "study/trial.h"

#include <cmath>

namespace stairstep {

std::string_view name(Judgement judgement) {
    return judgement == Judgement::artifact ? "artifact" : "line";
}

std::optional<Judgement> judgement_named(std::string_view text) {
    for (const Judgement judgement : {Judgement::artifact, Judgement::line}) {
        if (name(judgement) == text) return judgement;
    }
    return std::nullopt;
}

std::string_view name(Task task) {
    return task == Task::yes_no ? "yes-no" : "2afc";
}

std::optional<Task> task_named(std::string_view text) {
    for (const Task task : {Task::yes_no, Task::two_alternative}) {
        if (name(task) == text) return task;
    }
    return std::nullopt;
}

std::string_view name(TrialKind kind) {
    switch (kind) {
        case TrialKind::main: return "main";
        case TrialKind::practice: return "practice";
        case TrialKind::attention: return "catch";
    }
    return "";
}

std::optional<TrialKind> trial_kind_named(std::string_view text) {
    for (const TrialKind kind : {TrialKind::main, TrialKind::practice, TrialKind::attention}) {
        if (name(kind) == text) return kind;
    }
    return std::nullopt;
}

double Trial::strength() const {
    return std::log10(condition.texel_px / radius_px);
}

std::vector<Trial> evidence(std::vector<Trial> trials) {
    std::erase_if(trials, [](const Trial& trial) { return !trial.is_evidence(); });
    return trials;
}

}  // namespace stairstep
