// What a shadow map covers, fitted to what can be seen.
//
// The light plane lies across the light. A directional light's has coordinates along basis.right and basis.up in world
// units; a spot's has tangents: the same, over the depth along the light. Filter radii, texels and extents are lengths in
// the light plane.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "renderer/depth_encoding.h"
#include "renderer/light_warp.h"
#include "renderer/scene_extents.h"

namespace stairstep {

struct LightFrustum {
    Light::Kind kind = Light::Kind::directional;
    /// back points to the light; right and up are the map's axes, turned about it where that makes the map smaller.
    Basis basis;
    /// Of a spot.
    glm::dvec3 position{0};
    /// In the light plane.
    glm::dvec2 low;
    glm::dvec2 high;
    /// Depths along the light between which the casters lie strictly; an empty texel stores `farthest`. A spot's nearest
    /// is above 0.
    double nearest = 0;
    double farthest = 1;
    /// How depths are stored.
    DepthEncoding encoding{};
    /// Half-width of a penumbra's filter in the light plane for each unit between the stored depths of receiver and
    /// caster: stored depth is linear in depth for a directional light and in its reciprocal for a spot, and so is the
    /// half-width (light.h), so their quotient is a constant.
    double softness = 0;
    /// Whether no caster can shade anything visible. The frustum is then of no place in particular.
    bool shadowless = false;
    /// Depth of the visible receiver farthest along the light, as stored depths are, but above 1 beyond the map's end.
    double receiver_depth = 1;
    /// Distances along the view of the nearest and the farthest visible receiver that may be shadowed, world units; infinite and 0
    /// for none.
    glm::dvec2 view_range{0};
    /// Of a directional light's map; basis.up is then along the view's direction.
    LightWarp warp;

    /// A convex volume, world space, dot(plane.xyz, p) + plane.w ≥ 0: what lies outside can't shade what is visible. Planes along
    /// the light around all visible receivers, at their technique's reach, and one behind the farthest of them.
    std::vector<glm::dvec4> caster_planes{};

    /// Whether planes are planes of what is stored: of all but a spot's linear depths.
    bool stores_planes() const { return kind == Light::Kind::directional || encoding.spot == SpotDepth::reciprocal; }

    /// What texels as large as the map's largest would span.
    glm::dvec2 extent() const { return warp.warps() ? warp.extent() : high - low; }
};

enum class Fit {
    /// Along the light's own axes.
    axis_aligned,
    /// Along the axes that make the map's area smallest: one is along a side of a convex hull (Freeman & Shapira 1975;
    /// Brabec 2003, section 4.2).
    smallest_rectangle,
};

/// How far from a receiver's own place its technique looks, light plane, ≥ 0, given the frustum's depths, softness and receiver_depth.
using Reach = std::function<double(const LightFrustum&)>;

/// PSR = L ∩ V ∩ S (Brabec 2003): a rectangle that holds all of the casters' extent that the reach of a visible receiver
/// overlaps, and no more. Beyond its sides no visible receiver sees a caster: what lies outside is lit. Depth spans the
/// casters; receivers may lie beyond its far end: their depth is clamped to it, which leaves every comparison as it was,
/// so they cost the depth no precision. Casters nearer to a spot than 1/1000 of its farthest are clamped likewise.
/// `aspect` is the picture's width over its height. A warp chooses the axes, whatever `fit` is, and fits the map to what is seen
/// of a perspective view; a spot's map keeps none, being in perspective already, nor has one whose light shines along the view. The far end is where `encoding` can tell
/// the last caster from it.
LightFrustum fit_light_frustum(const SceneExtents& extents, const SceneState& state, double aspect, Fit fit,
                               const Reach& reach, Warp warp = Warp::none, const DepthEncoding& encoding = {});

/// In the light plane, then the depth along the light.
glm::dvec3 light_plane_point(const LightFrustum& frustum, const glm::dvec3& world);

}  // namespace stairstep
