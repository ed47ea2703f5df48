#include "renderer/depth_pass.h"

#include "embedded/shaders.h"
#include "renderer/back_faces.h"

namespace stairstep {

DepthPass::DepthPass() : program_(gl::make_program("depth", {embedded::depth_vert}, {embedded::depth_frag})) {}

void DepthPass::clear(const DepthMap& memory, const ShadowMapShape& shape) const {
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, memory.framebuffer.id());
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(0, 0, shape.width + 2 * kGuardTexels, shape.height + 2 * kGuardTexels);
    const float empty = 1;
    gl::ClearNamedFramebufferfv(memory.framebuffer.id(), GL_DEPTH, 0, &empty);
    gl::Disable(GL_SCISSOR_TEST);
}

void DepthPass::draw(const GpuScene& scene, const SceneState& state, const DrawList& casters, const DepthMap& memory,
                     const ShadowMapShape& shape) {
    const LightFrustum& frustum = shape.frustum;
    const bool linear = !frustum.stores_planes();
    if (linear && !linear_program_.id()) {
        linear_program_ = gl::make_program("linear depth", {embedded::depth_vert}, {embedded::linear_depth_frag});
    }
    const gl::Program& program = linear ? linear_program_ : program_;
    if (linear) gl::set_uniform(program, "depth_ends", glm::vec2(frustum.nearest, frustum.farthest));
    const glm::dmat4 texel_from_world = stairstep::texel_from_world(shape);
    gl::set_uniform(program, "map_size", glm::vec2(shape.width, shape.height));
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, memory.framebuffer.id());
    gl::Viewport(kGuardTexels, kGuardTexels, shape.width, shape.height);
    gl::Enable(GL_DEPTH_TEST);
    // A caster nearer to a spot than its nearest depth still casts.
    gl::Enable(GL_DEPTH_CLAMP);
    gl::UseProgram(program.id());
    gl::BindVertexArray(scene.vertex_array.id());
    const std::vector<glm::dvec3> starts = ray_starts(shape.frustum);
    for (const DrawList::Item& item : casters.items) {
        if (!casters.back_faces) set_faces(scene.draws[item.draw], state, starts);
        const glm::dmat4 texel_from_model = texel_from_world * world_from_model(scene.draws[item.draw], state);
        gl::set_uniform(program, "texel_from_model", glm::mat4(texel_from_model));
        draw_runs(scene, item);
    }
    set_both_faces();
    gl::Disable(GL_DEPTH_CLAMP);
}

}  // namespace stairstep
