#include "renderer/shadow_query.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "embedded/shaders.h"
#include "renderer/view_passes.h"

namespace stairstep {
namespace {

constexpr std::string_view kVersion = "#version 450 core\n";
/// A look at a picture: pixels of a tile's side, and from one that is looked at to the next.
struct Look {
    int side;
    int step;
};
constexpr std::array<Look, 3> kLooks{{{16, 16}, {8, 4}, {8, 1}}};
/// Lights whose answers come at once: their tiles lie one above the other, in a texture that isn't too tall.
constexpr size_t kLightsAtOnce = 16;
constexpr int kLongestWait = 16;
/// Roundings of a place in eye space, of its distance.
constexpr double kRounding = 1e-6;

/// As in shaders/shadow_query.frag, laid out by std140.
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
static_assert(sizeof(AskedBox) == 80 && 80 * kMostCasterBoxes <= 16384);

bool is_outside(const TurnedBox& box, const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    return glm::dot(normal, box.centre) + plane.w + box.extent(normal) < 0;
}

/// The box as the shader has it; `far_depth` is that of its far end along the light.
AskedBox asked_box(const TurnedBox& box, const LightFrustum& frustum, const glm::dvec3& eye, double far_depth) {
    const glm::dvec3 centre = box.centre - eye;
    const double factor = frustum.kind == Light::Kind::spot ? far_depth : 1;
    const glm::dvec3 spread = glm::abs(frustum.basis.right * box.axes) + glm::abs(frustum.basis.up * box.axes);
    return {glm::vec3(box.axes[0]), static_cast<float>(box.half.x),
            glm::vec3(box.axes[1]), static_cast<float>(box.half.y),
            glm::vec3(box.axes[2]), static_cast<float>(box.half.z),
            glm::vec3(centre),      static_cast<float>(factor),
            glm::vec3(spread),      static_cast<float>(kRounding * (glm::length(centre) + glm::length(box.half)))};
}

/// Those that may shade what is visible, and the depth of the first: from the eye, or from the light for a spot.
std::pair<std::vector<AskedBox>, double> asked_boxes(const ShadowQuestion& question,
                                                     const std::vector<TurnedBox>& casters, const glm::dvec3& eye) {
    const LightFrustum& frustum = question.frustum;
    const glm::dvec3& back = frustum.basis.back;
    const bool spot = frustum.kind == Light::Kind::spot;
    const glm::dvec3 origin = spot ? frustum.position : eye;
    double nearest = INFINITY;
    std::vector<AskedBox> boxes;
    for (const TurnedBox& box : casters) {
        const auto& planes = frustum.caster_planes;
        if (std::any_of(planes.begin(), planes.end(), [&](const auto& plane) { return is_outside(box, plane); })) {
            continue;
        }
        const double middle = glm::dot(back, origin - box.centre);
        const double half = box.extent(back);
        if (spot && middle + half <= 0) continue;
        nearest = std::min(nearest, middle - half);
        boxes.push_back(asked_box(box, frustum, eye, middle + half));
    }
    // What is nearer to a spot is stored as if it were there.
    return {std::move(boxes), spot ? std::max(nearest, frustum.nearest) : nearest};
}

void set_light_uniforms(const gl::Program& program, const ShadowQuestion& question, const glm::dvec3& eye,
                        double nearest, size_t box_count) {
    const LightFrustum& frustum = question.frustum;
    const glm::dvec2 everywhere(-1e30, 1e30);
    gl::set_uniform(program, "is_spot", frustum.kind == Light::Kind::spot ? 1 : 0);
    gl::set_uniform(program, "light_right", glm::vec3(frustum.basis.right));
    gl::set_uniform(program, "light_up", glm::vec3(frustum.basis.up));
    gl::set_uniform(program, "light_back", glm::vec3(frustum.basis.back));
    gl::set_uniform(program, "light_place", glm::vec3(frustum.position - eye));
    gl::set_uniform(program, "cone_cosine",
                    static_cast<float>(std::cos(question.light.cone_deg * std::numbers::pi / 180)));
    gl::set_uniform(program, "slice", glm::vec2(question.slice.value_or(everywhere)));
    gl::set_uniform(program, "looks_anywhere", question.looks_anywhere ? 1 : 0);
    gl::set_uniform(program, "constant_reach", static_cast<float>(question.reach));
    gl::set_uniform(program, "softness", static_cast<float>(question.softness));
    gl::set_uniform(program, "nearest", static_cast<float>(std::min(nearest, 1e30)));
    gl::set_uniform(program, "box_count", static_cast<int>(box_count));
}

}  // namespace

ShadowQuery::ShadowQuery()
    : tiles_program_(gl::make_program(
          "surface tiles", {embedded::fullscreen_vert},
          {kVersion, embedded::surface_glsl, embedded::surface_stored_glsl, embedded::surface_tiles_frag})),
      query_program_(gl::make_program(
          "shadow query", {embedded::fullscreen_vert},
          {kVersion, embedded::surface_glsl, embedded::surface_stored_glsl, embedded::shadow_query_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void ShadowQuery::Tiles::reserve(const glm::ivec2& wanted_count, size_t wanted_lights) {
    if (count == wanted_count && lights == wanted_lights) return;
    if (count != wanted_count) {
        for (gl::Texture& bound : bounds) bound = gl::make_texture(GL_RGBA32F, wanted_count.x, wanted_count.y);
        bounds_framebuffer = gl::make_framebuffer({bounds[0].id(), bounds[1].id(), bounds[2].id(), bounds[3].id()}, 0);
    }
    answers = gl::make_texture(GL_R32UI, wanted_count.x, wanted_count.y * static_cast<int>(wanted_lights));
    answers_framebuffer = gl::make_framebuffer(answers.id(), 0);
    count = wanted_count;
    lights = wanted_lights;
}

std::vector<Shown> ShadowQuery::look(size_t index, const Camera& camera, const FrameTarget& target,
                                     std::span<const ShadowQuestion> questions, const std::vector<TurnedBox>& casters) {
    const auto [side, step] = kLooks[index];
    Tiles& tiles = tiles_[index];
    tiles.reserve((glm::ivec2(target.width, target.height) + side - 1) / side, questions.size());
    gl::Disable(GL_DEPTH_TEST);
    gl::BindVertexArray(no_vertices_.id());
    gl::BindTextureUnit(4, target.planes.id());
    gl::BindTextureUnit(5, target.materials.id());
    for (const gl::Program* program : {&tiles_program_, &query_program_}) {
        set_ray_uniforms(*program, camera, target);
        gl::set_uniform(*program, "side_px", side);
        gl::set_uniform(*program, "step_px", step);
    }
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, tiles.bounds_framebuffer.id());
    gl::Viewport(0, 0, tiles.count.x, tiles.count.y);
    gl::UseProgram(tiles_program_.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);

    for (GLuint i = 0; i < tiles.bounds.size(); ++i) gl::BindTextureUnit(i, tiles.bounds[i].id());
    gl::set_uniform(query_program_, "view_back", glm::vec3(camera.basis.back));
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, tiles.answers_framebuffer.id());
    gl::UseProgram(query_program_.id());
    for (size_t i = 0; i < questions.size(); ++i) {
        auto [boxes, nearest] = asked_boxes(questions[i], casters, camera.eye);
        const int first_row = static_cast<int>(i) * tiles.count.y;
        set_light_uniforms(query_program_, questions[i], camera.eye, nearest, boxes.size());
        gl::set_uniform(query_program_, "first_row", first_row);
        // What isn't looked at one by one may be anywhere.
        if (boxes.size() > kMostCasterBoxes) gl::set_uniform(query_program_, "looks_anywhere", 1);
        // As large as the shader says it is.
        boxes.resize(kMostCasterBoxes);
        const gl::Buffer buffer = gl::make_buffer(std::as_bytes(std::span(boxes)));
        gl::BindBufferBase(GL_UNIFORM_BUFFER, 0, buffer.id());
        gl::Viewport(0, first_row, tiles.count.x, tiles.count.y);
        gl::DrawArrays(GL_TRIANGLES, 0, 3);
    }

    const ptrdiff_t tiles_each = static_cast<ptrdiff_t>(tiles.count.x) * tiles.count.y;
    std::vector<uint32_t> found(tiles_each * questions.size());
    gl::GetTextureImage(tiles.answers.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                        static_cast<GLsizei>(found.size() * sizeof(uint32_t)), found.data());
    std::vector<Shown> answers;
    for (auto first = found.begin(); first != found.end(); first += tiles_each) {
        const uint32_t most = *std::max_element(first, first + tiles_each);
        answers.push_back(most == 0 ? Shown::nothing : most == 1 ? Shown::light : Shown::shadow);
    }
    return answers;
}

std::vector<Shown> ShadowQuery::ask(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                                    std::span<const ShadowQuestion> questions) {
    std::vector<Shown> answers(questions.size(), Shown::nothing);
    if (questions.empty()) return answers;
    if (boxes_of_ != scene.serial) {
        boxes_ = caster_boxes(scene);
        boxes_of_ = scene.serial;
    }
    std::vector<TurnedBox> casters;
    for (const CasterBox& box : boxes_) casters.push_back(box_at(box, state));

    for (size_t index = 0; index < kLooks.size(); ++index) {
        std::vector<size_t> open;
        for (size_t i = 0; i < answers.size(); ++i) {
            if (answers[i] != Shown::shadow) open.push_back(i);
        }
        for (size_t first = 0; first < open.size(); first += kLightsAtOnce) {
            const size_t count = std::min(kLightsAtOnce, open.size() - first);
            std::vector<ShadowQuestion> some;
            for (size_t i = 0; i < count; ++i) some.push_back(questions[open[first + i]]);
            const std::vector<Shown> found = look(index, state.camera, target, some, casters);
            for (size_t i = 0; i < count; ++i) answers[open[first + i]] = found[i];
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
