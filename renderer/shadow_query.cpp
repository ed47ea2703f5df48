#include "renderer/shadow_query.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "embedded/shaders.h"
#include "renderer/view_passes.h"

namespace stairstep {
namespace {

/// As in shaders/shadow_query.frag: pixels of a tile's side, and lights a look can tell apart.
constexpr int kTileSide = 8;
constexpr size_t kLightsAtOnce = 32;
/// Pixels from one that is looked at to the next, at first.
constexpr int kFirstStep = 4;
constexpr int kLongestWait = 16;
/// Roundings of a place in eye space, of its distance.
constexpr double kRounding = 1e-6;

/// shaders/shadow_query.frag has the same two, laid out by std430.
struct AskedLight {
    glm::vec3 right;
    float reach;
    glm::vec3 up;
    float softness;
    glm::vec3 back;
    float cone_cosine;
    glm::vec3 from_eye;
    float nearest;
    glm::vec2 slice;
    int first_box;
    int box_count;
    int is_spot;
    int looks_anywhere;
    int unused[2];
};
static_assert(sizeof(AskedLight) == 96);

struct AskedBox {
    glm::vec3 axis_x;
    float half_x;
    glm::vec3 axis_y;
    float half_y;
    glm::vec3 axis_z;
    float half_z;
    glm::vec3 centre;
    float reach_factor;
    glm::vec3 spread;
    float rounding;
};
static_assert(sizeof(AskedBox) == 80);

bool is_outside(const TurnedBox& box, const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    return glm::dot(normal, box.centre) + plane.w + box.extent(normal) < 0;
}

/// The box as the shader has it; `depths` are those of its ends along the light.
AskedBox asked_box(const TurnedBox& box, const LightFrustum& frustum, const glm::dvec3& eye, const glm::dvec2& depths) {
    const glm::dvec3 centre = box.centre - eye;
    const double factor = frustum.kind == Light::Kind::spot ? depths.y : 1;
    const glm::dvec3 spread = glm::abs(frustum.basis.right * box.axes) + glm::abs(frustum.basis.up * box.axes);
    return {glm::vec3(box.axes[0]), static_cast<float>(box.half.x),
            glm::vec3(box.axes[1]), static_cast<float>(box.half.y),
            glm::vec3(box.axes[2]), static_cast<float>(box.half.z),
            glm::vec3(centre),      static_cast<float>(factor),
            glm::vec3(spread),      static_cast<float>(kRounding * (glm::length(centre) + glm::length(box.half)))};
}

/// Appends the boxes that may shade what is visible. Depths are from the eye, and from the light for a spot.
AskedLight asked_light(const ShadowQuestion& question, const std::vector<TurnedBox>& casters, const glm::dvec3& eye,
                       std::vector<AskedBox>& boxes) {
    const LightFrustum& frustum = question.frustum;
    const glm::dvec3& back = frustum.basis.back;
    const bool spot = frustum.kind == Light::Kind::spot;
    const glm::dvec3 origin = spot ? frustum.position : eye;
    double nearest = INFINITY;
    const size_t first = boxes.size();
    for (const TurnedBox& box : casters) {
        const auto& planes = frustum.caster_planes;
        if (std::any_of(planes.begin(), planes.end(), [&](const auto& plane) { return is_outside(box, plane); })) {
            continue;
        }
        const double middle = glm::dot(back, origin - box.centre);
        const double half = box.extent(back);
        if (spot && middle + half <= 0) continue;
        nearest = std::min(nearest, middle - half);
        boxes.push_back(asked_box(box, frustum, eye, {middle - half, middle + half}));
    }
    // What is nearer to a spot is stored as if it were there.
    if (spot) nearest = std::max(nearest, frustum.nearest);
    return {.right = glm::vec3(frustum.basis.right),
            .reach = static_cast<float>(question.reach),
            .up = glm::vec3(frustum.basis.up),
            .softness = static_cast<float>(question.softness),
            .back = glm::vec3(back),
            .cone_cosine = static_cast<float>(std::cos(question.light.cone_deg * std::numbers::pi / 180)),
            .from_eye = glm::vec3(frustum.position - eye),
            .nearest = static_cast<float>(nearest),
            .slice = question.slice ? glm::vec2(*question.slice) : glm::vec2(-INFINITY, INFINITY),
            .first_box = static_cast<int>(first),
            .box_count = static_cast<int>(boxes.size() - first),
            .is_spot = spot,
            .looks_anywhere = question.looks_anywhere,
            .unused = {}};
}

}  // namespace

ShadowQuery::ShadowQuery()
    : program_(gl::make_program(
          "shadow query", {embedded::fullscreen_vert},
          {"#version 450 core\n", embedded::surface_glsl, embedded::surface_stored_glsl, embedded::shadow_query_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void ShadowQuery::reserve(const FrameTarget& target) {
    const glm::ivec2 count = (glm::ivec2(target.width, target.height) + kTileSide - 1) / kTileSide;
    if (count == tile_count_) return;
    tile_count_ = count;
    tiles_ = gl::make_texture(GL_RG32UI, count.x, count.y);
    framebuffer_ = gl::make_framebuffer(tiles_.id(), 0);
}

ShadowQuery::Bits ShadowQuery::look(int step, uint32_t known, const FrameTarget& target) const {
    gl::set_uniform(program_, "step_px", step);
    gl::set_uniform(program_, "known", static_cast<int>(known));
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, tile_count_.x, tile_count_.y);
    gl::Disable(GL_DEPTH_TEST);
    gl::UseProgram(program_.id());
    gl::BindVertexArray(no_vertices_.id());
    gl::BindTextureUnit(4, target.planes.id());
    gl::BindTextureUnit(5, target.materials.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<glm::uvec2> tiles(static_cast<size_t>(tile_count_.x) * tile_count_.y);
    gl::GetTextureImage(tiles_.id(), 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                        static_cast<GLsizei>(tiles.size() * sizeof(glm::uvec2)), tiles.data());
    Bits bits;
    for (const glm::uvec2& tile : tiles) {
        bits.lit |= tile.x;
        bits.shaded |= tile.y;
    }
    return bits;
}

std::vector<Shown> ShadowQuery::ask(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                                    std::span<const ShadowQuestion> questions) {
    std::vector<Shown> answers;
    if (questions.empty()) return answers;
    reserve(target);
    if (boxes_of_ != scene.serial) {
        boxes_ = caster_boxes(scene);
        boxes_of_ = scene.serial;
    }
    std::vector<TurnedBox> casters;
    for (const CasterBox& box : boxes_) casters.push_back(box_at(box, state));
    set_ray_uniforms(program_, state.camera, target);
    gl::set_uniform(program_, "view_back", glm::vec3(state.camera.basis.back));

    for (size_t first = 0; first < questions.size(); first += kLightsAtOnce) {
        const std::span<const ShadowQuestion> some =
            questions.subspan(first, std::min(kLightsAtOnce, questions.size() - first));
        std::vector<AskedLight> lights;
        std::vector<AskedBox> boxes;
        for (const ShadowQuestion& one : some) lights.push_back(asked_light(one, casters, state.camera.eye, boxes));
        // Buffers can't be empty.
        if (boxes.empty()) boxes.emplace_back();
        const gl::Buffer light_buffer = gl::make_buffer(std::as_bytes(std::span(lights)));
        const gl::Buffer box_buffer = gl::make_buffer(std::as_bytes(std::span(boxes)));
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, light_buffer.id());
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, box_buffer.id());
        gl::set_uniform(program_, "light_count", static_cast<int>(lights.size()));
        const auto all = static_cast<uint32_t>((uint64_t{1} << lights.size()) - 1);
        Bits found = look(kFirstStep, 0, target);
        if (found.shaded != all) {
            const Bits more = look(1, found.shaded, target);
            found = {found.lit | more.lit, found.shaded | more.shaded};
        }
        for (size_t i = 0; i < lights.size(); ++i) {
            const uint32_t bit = uint32_t{1} << i;
            answers.push_back(found.shaded & bit ? Shown::shadow : found.lit & bit ? Shown::light : Shown::nothing);
        }
    }
    return answers;
}

void QueryPatience::answered(Shown shown) {
    if (shown == Shown::shadow) {
        // Counted from the next frame on.
        wait_ = next_wait_ + 1;
        next_wait_ = std::min(2 * next_wait_, kLongestWait);
    } else {
        *this = {};
    }
}

}  // namespace stairstep
