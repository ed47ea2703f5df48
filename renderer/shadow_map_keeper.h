// A shadow map that is drawn only as far as something changed.
//
// Nothing changed: no pass at all. Casters moved under the same light and frustum: those that stand still come from a copy, and only
// the moving ones are drawn. Else everything is drawn. What counts as a change is what the map is made of, no more and no less: the
// frustum, the texels, the casters within reach, and where those that move are.
#pragma once

#include <optional>
#include <vector>

#include "renderer/depth_pass.h"

namespace stairstep {

class ShadowMapKeeper {
  public:
    struct Options {
        /// Leave out casters that can't shade anything visible.
        bool cull = true;
        /// Keep what didn't change.
        bool keep = true;
        /// Draw the back faces of solids as well: they are nowhere nearest to the light.
        bool back_faces = false;
    };

    /// Makes `map` hold its shape's casters. Whether it had to draw.
    bool update(const GpuScene& scene, const SceneState& state, const ShadowMap& map, const Options& options);

    /// Triangles drawn by the last update.
    size_t triangles() const { return triangles_; }

  private:
    struct Content {
        uint64_t scene = 0;
        ShadowMapShape shape;
        DrawList casters;
        /// Of moving casters: where they are.
        std::vector<glm::dmat4> movers;

        bool same_as(const Content& other) const;
    };

    void copy_still_casters(const ShadowMap& map) const;

    DepthPass pass_;
    /// Of a map's memory, by its texture; and what that holds.
    GLuint drawn_into_ = 0;
    std::optional<Content> drawn_;
    /// Those that stand still, behind the last frame's frustum; empty until a caster moves in it.
    DepthMap still_memory_;
    int still_side_ = 0;
    std::optional<Content> still_;
    size_t triangles_ = 0;
};

}  // namespace stairstep
