#include "renderer/need_meter.h"

#include <algorithm>
#include <cmath>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

constexpr int kTileSide = 8;
/// What receiver.glsl writes for no need.
constexpr float kNoNeed = 1e30f;

/// The value below which `share` of the finite ones lie.
double quantile(std::vector<float> values, double share) {
    std::erase_if(values, [](float value) { return !(value < kNoNeed); });
    if (values.empty()) return INFINITY;
    const auto rank = static_cast<ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[rank];
}

}  // namespace

double needed_texel(const TileNeeds& tiles, const NeedStatistic& statistic) {
    switch (statistic.kind) {
        case NeedStatistic::Kind::extreme: return quantile(tiles.finest, 0);
        case NeedStatistic::Kind::percentile: return quantile(tiles.one_pixel, statistic.share);
        case NeedStatistic::Kind::tiles: return quantile(tiles.finest, statistic.share);
    }
    return INFINITY;
}

NeedMeter::NeedMeter()
    : program_(gl::make_program("need", {embedded::fullscreen_vert}, {embedded::need_tiles_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void NeedMeter::measure(const FrameTarget& target) {
    const int width = (target.width + kTileSide - 1) / kTileSide;
    const int height = (target.height + kTileSide - 1) / kTileSide;
    if (width != width_ || height != height_) {
        tiles_ = gl::make_texture(GL_RG32F, width, height);
        framebuffer_ = gl::make_framebuffer(tiles_.id(), 0);
        read_back_ = gl::make_read_buffer(sizeof(glm::vec2) * width * height);
        width_ = width;
        height_ = height;
    }
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, width, height);
    gl::Disable(GL_DEPTH_TEST);
    gl::UseProgram(program_.id());
    gl::BindVertexArray(no_vertices_.id());
    gl::BindTextureUnit(0, target.need.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);

    gl::BindBuffer(GL_PIXEL_PACK_BUFFER, read_back_.id());
    gl::GetTextureImage(tiles_.id(), 0, GL_RG, GL_FLOAT, static_cast<GLsizei>(sizeof(glm::vec2) * width * height),
                        nullptr);
    gl::BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    pending_ = true;
}

std::optional<TileNeeds> NeedMeter::take() {
    if (!pending_) return std::nullopt;
    pending_ = false;
    std::vector<glm::vec2> tiles(static_cast<size_t>(width_) * height_);
    gl::GetNamedBufferSubData(read_back_.id(), 0, static_cast<GLsizeiptr>(sizeof(glm::vec2) * tiles.size()),
                              tiles.data());
    TileNeeds needs;
    for (const glm::vec2& tile : tiles) {
        if (!(tile.x < kNoNeed)) continue;
        needs.finest.push_back(tile.x);
        needs.one_pixel.push_back(tile.y);
    }
    return needs;
}

}  // namespace stairstep
