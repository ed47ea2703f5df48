#include "renderer/depth_pass.h"

#include "embedded/shaders.h"

namespace stairstep {

DepthPass::DepthPass() : program_(gl::make_program("depth", {embedded::depth_vert}, {embedded::depth_frag})) {}

void DepthPass::draw(const GpuScene& scene, const SceneState& state, const ShadowMap& map) const {
    const int width = map.shape.width;
    const int height = map.shape.height;
    const glm::dmat4 texel_from_world = stairstep::texel_from_world(map.shape);
    gl::set_uniform(program_, "map_size", glm::vec2(width, height));

    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, map.memory.framebuffer.id());
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(0, 0, width + 2 * kGuardTexels, height + 2 * kGuardTexels);
    const float empty = 1;
    gl::ClearNamedFramebufferfv(map.memory.framebuffer.id(), GL_DEPTH, 0, &empty);
    gl::Disable(GL_SCISSOR_TEST);
    gl::Viewport(kGuardTexels, kGuardTexels, width, height);
    gl::Enable(GL_DEPTH_TEST);
    // A caster nearer to a spot than its nearest depth still casts.
    gl::Enable(GL_DEPTH_CLAMP);
    gl::UseProgram(program_.id());
    gl::BindVertexArray(scene.vertex_array.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        if (!draw.casts) continue;
        gl::set_uniform(program_, "texel_from_model", glm::mat4(texel_from_world * world_from_model(draw, state)));
        draw_elements(draw);
    }
    gl::Disable(GL_DEPTH_CLAMP);
}

}  // namespace stairstep
