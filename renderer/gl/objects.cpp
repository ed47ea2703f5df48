#include "renderer/gl/objects.h"

#include <array>
#include <string>

#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

void require_texture_size(int width, int height) {
    GLint largest = 0;
    GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw FailureError("texture of " + std::to_string(width) + "x" + std::to_string(height),
                           "this driver can't make it", "use sides of 1 to " + std::to_string(largest));
    }
}

}  // namespace

Texture make_texture(GLenum format, int width, int height, int levels) {
    require_texture_size(width, height);
    GLuint id = 0;
    CreateTextures(GL_TEXTURE_2D, 1, &id);
    Texture texture(id);
    TextureStorage2D(id, levels, format, width, height);
    throw_on_error("making a texture");
    return texture;
}

Texture make_multisample_texture(GLenum format, int width, int height, int samples) {
    require_texture_size(width, height);
    GLint most = 0;
    GetIntegerv(GL_MAX_SAMPLES, &most);
    if (samples > most) {
        throw FailureError("picture with " + std::to_string(samples) + " samples a pixel", "this driver can't make it",
                           "use at most " + std::to_string(most));
    }
    GLuint id = 0;
    CreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &id);
    Texture texture(id);
    TextureStorage2DMultisample(id, samples, format, width, height, GL_TRUE);
    throw_on_error("making a multisampled texture");
    return texture;
}

Buffer make_buffer(std::span<const std::byte> content) {
    GLuint id = 0;
    CreateBuffers(1, &id);
    Buffer buffer(id);
    NamedBufferStorage(id, static_cast<GLsizeiptr>(content.size()), content.data(), 0);
    throw_on_error("making a buffer");
    return buffer;
}

VertexArray make_vertex_array() {
    GLuint id = 0;
    CreateVertexArrays(1, &id);
    return VertexArray(id);
}

Buffer make_read_buffer(size_t bytes) {
    GLuint id = 0;
    CreateBuffers(1, &id);
    Buffer buffer(id);
    NamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), nullptr, GL_CLIENT_STORAGE_BIT);
    throw_on_error("making a buffer");
    return buffer;
}

Framebuffer make_framebuffer(GLuint colour_texture, GLuint depth_texture, GLuint second_colour_texture) {
    GLuint id = 0;
    CreateFramebuffers(1, &id);
    Framebuffer framebuffer(id);
    const GLenum colour = colour_texture ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    if (colour_texture) NamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, colour_texture, 0);
    if (depth_texture) NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth_texture, 0);
    if (second_colour_texture) {
        constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        NamedFramebufferTexture(id, GL_COLOR_ATTACHMENT1, second_colour_texture, 0);
        NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(kBoth.size()), kBoth.data());
    } else {
        NamedFramebufferDrawBuffer(id, colour);
    }
    NamedFramebufferReadBuffer(id, colour);
    if (CheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw FailureError("OpenGL", "the driver can't draw into this kind of framebuffer",
                           "use fewer --samples or a smaller picture");
    }
    return framebuffer;
}

Query make_timer_query() {
    GLuint id = 0;
    CreateQueries(GL_TIME_ELAPSED, 1, &id);
    return Query(id);
}

}  // namespace stairstep::gl
