// A scene at a moment: where the camera and the light are, and where what moves has moved to.
//
// Frames are drawn of a Scene, which never changes, in a SceneState, which may differ from frame to frame.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/light.h"
#include "renderer/scene.h"
#include "renderer/view.h"

namespace stairstep {

struct SceneState {
    Camera camera;
    Light light;
    /// World space from the space of a mover's vertices: rotation and translation alone.
    std::vector<glm::dmat4> movers;
    /// Each with a shadow of its own, and as bright as the first.
    std::vector<Light> more_lights{};

    /// World space from that of a mover's vertices, or of those that stand still.
    glm::dmat4 placement(std::optional<size_t> mover) const { return mover ? movers[*mover] : glm::dmat4(1); }
};

/// What an animation moves.
enum class Motion { still, light, caster, camera };

/// A scene with its motions.
struct AnimatedScene {
    std::string name;
    Scene scene;
    /// The state at time t in [0, 1] of a motion; at t = 0 all motions start from the same state, and `still` stays
    /// there. Smooth in t; t = 1 needn't equal t = 0.
    std::function<SceneState(Motion motion, double t)> state;
    /// Half-width of a filter of moderate blur, world units across the light (at the light's distance from the scene's
    /// middle, for a spot): 1 to 3 % of the visible extent.
    double radius = 0;
};

/// Bounds of all that casts shadows, where it is now.
Bounds caster_bounds(const Scene& scene, const SceneState& state);

}  // namespace stairstep
