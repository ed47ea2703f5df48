// A trial: what was shown and what the observer said. The columns of trials.csv and of the store.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// What a trial shows, and what an observer says of it: the silhouette sampled by a shadow map, or a true line.
enum class Judgement { artifact, line };

std::string_view name(Judgement judgement);
std::optional<Judgement> judgement_named(std::string_view name);

/// What is asked. yes-no: one picture, "is it an artifact or a line?"; lines are shown on a set share of the trials.
/// 2afc: an artifact and its line side by side, "which is the artifact?"; `stimulus` is what the left one is, `response` what
/// the observer says it is, so that an answer is right where the two agree, as for yes-no.
enum class Task { yes_no, two_alternative };

std::string_view name(Task task);
std::optional<Task> task_named(std::string_view name);

/// main trials move their track on. practice comes before them; a catch trial, easy to see, comes at random among them and
/// tells whether the observer attends. Neither belongs to the track whose condition it borrows: its `trial` is 0.
enum class TrialKind { main, practice, attention };

/// "main", "practice" or "catch".
std::string_view name(TrialKind kind);
std::optional<TrialKind> trial_kind_named(std::string_view name);

/// What an adaptive track holds fixed.
struct Condition {
    /// step or stair; on a line trial, whose line it is.
    Pattern pattern = Pattern::step;
    KernelShape kernel = KernelShape::box;
    double contrast = 1;
    double texel_px = 10;

    bool operator==(const Condition&) const = default;
};

struct Trial {
    std::string study;
    std::string observer;
    /// Numbers from 1: session in the store; presentation, round and track in the session; trial in the track. A trial that
    /// is shown again after the observer took it back keeps its number in the track and gets a new one as presentation.
    int session = 1;
    int presentation = 1;
    int round = 1;
    int track = 1;
    int trial = 1;
    TrialKind kind = TrialKind::main;
    Task task = Task::yes_no;
    Condition condition;
    /// What the engine asked for, and what was shown after limiting it to what the display can show, px.
    double suggested_radius_px = 0;
    double radius_px = 0;
    Judgement stimulus = Judgement::artifact;
    Judgement response = Judgement::artifact;
    /// From onset to answer, s.
    double response_time_s = 0;
    /// Onset, Unix time, s.
    double shown_at_s = 0;
    int dropped_frames = 0;
    /// Taken back by the observer: kept, but no evidence.
    bool is_void = false;

    bool correct() const { return stimulus == response; }

    /// Whether the trial says something about its condition's threshold.
    bool is_evidence() const { return kind == TrialKind::main && !is_void; }

    /// x = log10(texel_px/radius_px) as shown.
    double strength() const;
};

/// Those that are evidence, in order.
std::vector<Trial> evidence(std::vector<Trial> trials);

}  // namespace stairstep
