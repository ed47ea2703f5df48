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

Framebuffer make_framebuffer(std::span<const GLuint> colour_textures, GLuint depth_texture) {
    GLuint id = 0;
    CreateFramebuffers(1, &id);
    Framebuffer framebuffer(id);
    std::vector<GLenum> buffers;
    for (const GLuint texture : colour_textures) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
        NamedFramebufferTexture(id, buffers.back(), texture, 0);
    }
    if (buffers.empty()) buffers.push_back(GL_NONE);
    if (depth_texture) NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth_texture, 0);
    NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(buffers.size()), buffers.data());
    NamedFramebufferReadBuffer(id, buffers.front());
    if (CheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw FailureError("OpenGL", "the driver can't draw into this kind of framebuffer",
                           "use fewer --samples or a smaller picture");
    }
    return framebuffer;
}

Framebuffer make_framebuffer(GLuint colour_texture, GLuint depth_texture) {
    const std::span colours(&colour_texture, colour_texture ? 1 : 0);
    return make_framebuffer(colours, depth_texture);
}

Query make_timer_query() {
    GLuint id = 0;
    CreateQueries(GL_TIME_ELAPSED, 1, &id);
    return Query(id);
}

Query make_sample_query() {
    GLuint id = 0;
    CreateQueries(GL_SAMPLES_PASSED, 1, &id);
    return Query(id);
}

}  // namespace stairstep::gl
