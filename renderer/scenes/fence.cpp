// A fence of fine pales that stands square to the sun: gaps of one width at one period, near to a texel of the law's map
// and along its axis, where sampling does worst (analysis/law/grating_error.h).
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

/// Pales and gaps are of one width. Pales are as thin as they are wide, so a sun that shines along z sees half of each period lit.
constexpr double kPeriod = 0.06;
constexpr double kPale = 0.03;
constexpr double kHeight = 3;
/// From x = −6 to 6 along the ground, where z is 0; the last twenty pales, from x = 4.8 on, are a gate that hinges there.
constexpr double kLeft = -6;
constexpr int kPales = 200;
constexpr int kGatePales = 20;
/// Above the pales' feet and below their heads.
constexpr double kRailFromEnd = 0.1;
constexpr double kRail = 0.06;

double foot_of(int pale) {
    return kLeft + kPeriod * pale;
}

/// Pales from the first to before the last, and the two rails that hold them from behind.
void append_pales(Mesh& mesh, int first, int last) {
    for (int i = first; i < last; ++i) {
        append_box(mesh, {foot_of(i), 0, -kPale / 2}, {foot_of(i) + kPale, kHeight, kPale / 2});
    }
    for (const double low : {kRailFromEnd, kHeight - kRailFromEnd - kRail}) {
        append_box(mesh, {foot_of(first), low, -kPale / 2 - kRail},
                   {foot_of(last - 1) + kPale, low + kRail, -kPale / 2});
    }
}

std::vector<glm::dmat4> movers_at(double t) {
    // The gate opens, and falls half shut.
    return {turn_about({foot_of(kPales - kGatePales), 0, 0}, 80 * std::sin(0.75 * std::numbers::pi * t))};
}

AnimatedScene make_fence() {
    AnimatedScene animated;
    animated.name = "fence";
    Scene& scene = animated.scene;
    append_pales(add_part(scene, {0.42f, 0.30f, 0.20f}, {}), 0, kPales - kGatePales);
    append_pales(add_part(scene, {0.20f, 0.27f, 0.24f}, {}, 0), kPales - kGatePales, kPales);
    add_floor(scene, 0, 100, {0.62f, 0.60f, 0.55f});

    Walk walk;
    walk.target = {0, 0.7, 1.2};
    walk.eye = {4.5, 8.5, 13};
    walk.turn_deg = -25;
    walk.approach = 0.7;
    walk.vertical_fov_deg = 32;
    walk.near = 1;
    walk.far = 200;
    animated.state = staged({walking_camera(walk), orbiting_light({180, 42}, -50, 6, 0.03), movers_at});
    animated.radius = 0.2;
    return animated;
}

}  // namespace

SceneEntry fence_scene() {
    return {"fence", "a fence: gaps of half a texel", make_fence};
}

}  // namespace stairstep
