// Every kind of context that can be made here, and a small picture to draw in each.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/gl/program.h"
#include "stimuli/error.h"
#include "tests/support/virtual_display.h"

namespace stairstep {

namespace gl {
/// Names a test's kind in its output.
inline void PrintTo(ContextKind kind, std::ostream* out) {
    *out << name(kind);
}
}  // namespace gl

constexpr std::array kContextKinds{gl::ContextKind::osmesa, gl::ContextKind::egl, gl::ContextKind::window};

/// A display for the windows; make it before any of them.
class MadeContexts {
  public:
    /// Why a kind can't be made here, empty if it can: no Xvfb, or no EGL device. OSMesa always can.
    std::string why_not(gl::ContextKind kind) {
        if (kind == gl::ContextKind::window) {
            if (!display_) display_ = std::make_unique<VirtualDisplay>();
            return display_->is_there() ? "" : "no windows here: Xvfb doesn't start: install xvfb";
        }
        if (kind == gl::ContextKind::egl) {
            try {
                gl::make_egl_context();
            } catch (const FailureError& e) {
                return std::string("no EGL here: ") + e.what();
            }
        }
        return "";
    }

  private:
    std::unique_ptr<VirtualDisplay> display_;
};

constexpr int kPictureSide = 64;
/// The triangle's legs lie on the picture's left and bottom edges. No pixel's centre is on its third side, x + y = leg.
constexpr double kTriangleLeg_px = 48.5;

/// A picture of kPictureSide², RGBA, bottom row first: a triangle on black whose red and green are the pixel's place
/// over the side, whose blue is 1. Drawn by the current context.
inline std::vector<uint8_t> triangle_picture() {
    const gl::Program program =
        gl::make_program("triangle",
                         {"#version 450 core\n"
                          "layout(location = 0) in vec2 place;\n"  // over the side
                          "out vec2 colour;\n"
                          "void main() { colour = place; gl_Position = vec4(2 * place - 1, 0, 1); }\n"},
                         {"#version 450 core\n"
                          "in vec2 colour;\n"
                          "out vec4 result;\n"
                          "void main() { result = vec4(colour, 1, 1); }\n"});
    constexpr float kLeg = kTriangleLeg_px / kPictureSide;
    constexpr std::array<float, 6> kCorners{0, 0, kLeg, 0, 0, kLeg};
    const gl::Buffer corners = gl::make_buffer(std::as_bytes(std::span(kCorners)));
    const gl::VertexArray vertices = gl::make_vertex_array();
    gl::EnableVertexArrayAttrib(vertices.id(), 0);
    gl::VertexArrayAttribFormat(vertices.id(), 0, 2, GL_FLOAT, GL_FALSE, 0);
    gl::VertexArrayAttribBinding(vertices.id(), 0, 0);
    gl::VertexArrayVertexBuffer(vertices.id(), 0, corners.id(), 0, 2 * sizeof(float));

    const gl::Texture texture = gl::make_texture(GL_RGBA8, kPictureSide, kPictureSide);
    const gl::Framebuffer framebuffer = gl::make_framebuffer(texture.id(), 0);
    constexpr std::array<float, 4> kBlack{0, 0, 0, 1};
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, kBlack.data());
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, kPictureSide, kPictureSide);
    gl::UseProgram(program.id());
    gl::BindVertexArray(vertices.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    gl::UseProgram(0);
    std::vector<uint8_t> levels(static_cast<size_t>(4) * kPictureSide * kPictureSide);
    gl::GetTextureImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(levels.size()), levels.data());
    gl::throw_on_error("drawing a triangle");
    return levels;
}

}  // namespace stairstep
