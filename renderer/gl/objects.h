// OpenGL objects as move-only values: made by a function that names what it is for, deleted when they go.
// A context must be current for all of it. Functions here throw FailureError where the driver says no.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "renderer/gl/functions.h"

namespace stairstep::gl {

/// The name of one GL object, owned. `Delete` is the function that ends it.
template <void (*Delete)(GLuint)>
class Object {
  public:
    Object() = default;
    explicit Object(GLuint id) : id_(id) {}
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Object() {
        if (id_) Delete(id_);
    }

    /// 0 for an object that was moved from or never made.
    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

inline void delete_texture(GLuint id) {
    DeleteTextures(1, &id);
}
inline void delete_buffer(GLuint id) {
    DeleteBuffers(1, &id);
}
inline void delete_vertex_array(GLuint id) {
    DeleteVertexArrays(1, &id);
}
inline void delete_framebuffer(GLuint id) {
    DeleteFramebuffers(1, &id);
}
inline void delete_query(GLuint id) {
    DeleteQueries(1, &id);
}
inline void delete_shader(GLuint id) {
    DeleteShader(id);
}
inline void delete_program(GLuint id) {
    DeleteProgram(id);
}

using Texture = Object<delete_texture>;
using Buffer = Object<delete_buffer>;
using VertexArray = Object<delete_vertex_array>;
using Framebuffer = Object<delete_framebuffer>;
using Query = Object<delete_query>;
using Shader = Object<delete_shader>;
using Program = Object<delete_program>;

/// A 2D texture of `levels` mipmap levels, its content undefined. Sides in [1, GL_MAX_TEXTURE_SIZE].
Texture make_texture(GLenum format, int width, int height, int levels = 1);

/// A multisampled 2D texture; the driver may round `samples` up, and refuses what it can't do.
Texture make_multisample_texture(GLenum format, int width, int height, int samples);

/// An immutable buffer with this content, which must not be empty.
Buffer make_buffer(std::span<const std::byte> content);

VertexArray make_vertex_array();

/// A framebuffer that draws into these; 0 stands for none. Throws if the driver finds it incomplete.
Framebuffer make_framebuffer(GLuint colour_texture, GLuint depth_texture);

/// A framebuffer that draws into several colours, at most 8, at once.
Framebuffer make_framebuffer(std::span<const GLuint> colour_textures, GLuint depth_texture);
inline Framebuffer make_framebuffer(std::initializer_list<GLuint> colour_textures, GLuint depth_texture) {
    return make_framebuffer(std::span(colour_textures.begin(), colour_textures.size()), depth_texture);
}

/// A buffer of this many bytes that GL writes, and that is read back.
Buffer make_read_buffer(size_t bytes);

/// A timer query (GL_TIME_ELAPSED).
Query make_timer_query();

/// A query that counts samples (GL_SAMPLES_PASSED).
Query make_sample_query();

}  // namespace stairstep::gl
