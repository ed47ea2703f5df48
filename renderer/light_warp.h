// Light space perspective shadow maps (Wimmer, Scherzer & Purgathofer 2004): a shadow map whose texels are smaller where the
// camera is near.
//
// In the light plane y runs along the view's direction as the light sees it. With w = 1 + k(y − y₀), which is 1 at the near end
// y₀ of what is seen, and 1 + kd at its far end y₀ + d, a place of the light plane and a depth along the light become
//
//     u = ((x − x₀)/w − left)/(right − left)        v = (1/d + k)(y − y₀)/w        depth/w
//
// u and v in [0, 1] over the map. The division is a perspective one, from a centre at (x₀, y₀ − n), n = 1/k: planes stay planes,
// and light rays are parallel still: along one, w is constant. k = 0 is the map without a warp. The error that a texel makes
// on screen is equal at both ends of the view for
//
//     n = (z_near + √(z_near·z_far))/sin γ
//
// γ being the angle between light and view. Where the light shines along the view, or against it, k → 0 and the warp vanishes.
//
// Lengths in texels, of one in the light plane, differ by place: along x they go by 1/w, along y by 1/w². Besides, u changes
// along y: what is a square in texels is sheared by at most k·max(|left|, |right|) in the light plane. Filters don't make up
// for the shear, nor for how w changes within them, by a share of at most their half-width over n.
//
// Texels can't be made to stay where they are as the camera moves: each has a size of its own.
//
// Anchor: z_near 1, z_far 4, γ 90° → n = 3; over d = 3 texels at the far end are 2 times as wide and 4 times as long as at
// the near one.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace stairstep {

enum class Warp { none, lispsm };

struct LightWarp {
    /// k ≥ 0, one over a length in the light plane; 0 is no warp, whatever the rest is.
    double curvature = 0;
    /// x₀.
    double middle = 0;
    /// Of (x − x₀)/w over what is seen; left < right.
    double left = 0;
    double right = 1;
    /// y₀, and d > 0.
    double first = 0;
    double length = 1;

    bool operator==(const LightWarp&) const = default;

    bool warps() const { return curvature > 0; }
    /// w where it is largest: 1 + kd ≥ 1.
    double largest_w() const { return 1 + curvature * length; }
    /// What texels as large as the map's largest would span: those at the far end.
    glm::dvec2 extent() const { return largest_w() * glm::dvec2(right - left, length); }
    /// How many times as long texels of the far end are as those of the near one.
    glm::dvec2 texel_ratio() const { return {largest_w(), largest_w() * largest_w()}; }
};

/// What decides a warp.
struct WarpView {
    /// sin γ in [0, 1].
    double sin_angle = 0;
    /// Distances along the view of what is seen, world units, 0 < near ≤ far.
    double near = 1;
    double far = 1;
    /// The camera's eye along the light plane's x: the centre lies behind it.
    double eye_x = 0;
    /// Of a filter, light plane, ≥ 0. n is at least twice that, so that w is above 0 wherever a filter touches the map.
    double reach = 0;
};

/// The warp for what is seen, the corners of a convex body (at least one) in the light plane: the map holds all of it, with the
/// filters that look out from it. `margin` > 0 is added at all sides.
LightWarp lispsm_warp(const std::vector<glm::dvec2>& body, const WarpView& view, double margin);

}  // namespace stairstep
