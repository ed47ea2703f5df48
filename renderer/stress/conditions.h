// The conditions that the renderer is put under: each a stage and what is done to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/depth_encoding.h"
#include "renderer/stress/stage.h"

namespace stairstep::stress {

/// What is drawn, and how often.
enum class Course {
    /// One picture.
    picture,
    /// Picture after picture with a map of another size each.
    sizes,
    /// A light that swings to and fro, frame after frame; a state repeats each period.
    frames,
};

struct Condition {
    /// What is varied, and to what: "world offset", "1e6".
    std::string what;
    std::string value;
    Stage stage = plain_stage();
    Placement placement;
    /// Half-width of a constant filter in the light plane as ShadowSettings', at home.
    double radius = 0.08;
    /// As ShadowSettings'.
    std::optional<int> fixed_size;
    DepthEncoding depth;
    /// Drawn besides the stage, in its mover's space; none of them throws a shadow into the picture.
    std::vector<Mesh> extra;
    Course course = Course::picture;
    /// Of sizes or frames.
    int steps = 1;
};

/// Frames after which a swinging light is back.
inline constexpr int kPeriod = 40;

/// All conditions; with `quick` a few of each kind, and short courses. `long_run` animates for 10⁵ frames.
std::vector<Condition> all_conditions(bool quick, bool long_run);

/// The stage at a moment of its swing.
Stage swung(const Stage& stage, int frame);

}  // namespace stairstep::stress
