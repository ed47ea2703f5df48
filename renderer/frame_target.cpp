#include "renderer/frame_target.h"

#include <atomic>

#include "renderer/gl/program.h"

namespace stairstep {
namespace {

/// OpenGL's rows run upwards.
template <typename T>
void flip_rows(std::vector<T>& values, size_t row) {
    const size_t rows = values.size() / row;
    for (size_t i = 0; i < rows / 2; ++i) {
        std::swap_ranges(values.begin() + i * row, values.begin() + (i + 1) * row,
                         values.begin() + (rows - 1 - i) * row);
    }
}

}  // namespace

FrameTarget make_frame_target(Show show, int width, int height, int samples) {
    static std::atomic<uint64_t> targets = 0;
    FrameTarget target;
    target.serial = ++targets;
    target.show = show;
    target.width = width;
    target.height = height;
    target.samples = show == Show::colour ? samples : 1;
    const GLenum format = show == Show::colour ? GL_SRGB8_ALPHA8 : GL_R32F;
    target.colour = gl::make_texture(format, width, height);
    if (target.samples > 1) {
        target.multisample_colour = gl::make_multisample_texture(format, width, height, samples);
        target.depth = gl::make_multisample_texture(GL_DEPTH_COMPONENT32F, width, height, samples);
        target.multisample_framebuffer = gl::make_framebuffer(target.multisample_colour.id(), target.depth.id());
        target.framebuffer = gl::make_framebuffer(target.colour.id(), 0);
    } else {
        target.depth = gl::make_texture(GL_DEPTH_COMPONENT32F, width, height);
        target.framebuffer = gl::make_framebuffer(target.colour.id(), target.depth.id());
        target.need = gl::make_texture(GL_R32F, width, height);
        target.need_framebuffer = gl::make_framebuffer({target.colour.id(), target.need.id()}, target.depth.id());
        target.planes = gl::make_texture(GL_RGBA32F, width, height);
        target.materials = gl::make_texture(GL_RG32UI, width, height);
        // Whole numbers can't be read through a filter.
        gl::TextureParameteri(target.materials.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl::TextureParameteri(target.materials.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        target.surface_framebuffer =
            gl::make_framebuffer({target.planes.id(), target.materials.id()}, target.depth.id());
    }
    return target;
}

Image read_colour(const FrameTarget& target) {
    Image image(target.width, target.height, 3);
    gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl::GetTextureImage(target.colour.id(), 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(image.pixels.size()),
                        image.pixels.data());
    gl::throw_on_error("reading a picture");
    flip_rows(image.pixels, static_cast<size_t>(target.width) * 3);
    return image;
}

std::vector<float> read_visibility(const FrameTarget& target) {
    std::vector<float> values(static_cast<size_t>(target.width) * target.height);
    gl::GetTextureImage(target.colour.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                        values.data());
    gl::throw_on_error("reading visibility");
    flip_rows(values, target.width);
    return values;
}

}  // namespace stairstep
