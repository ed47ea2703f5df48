#include "renderer/shadow_renderer.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace stairstep {
namespace {

/// Frames that a first frame's size may take to settle: the first guess, what it finds, and what that finds.
constexpr int kMostSettlingFrames = 4;

const Light& light_of(const SceneState& state, size_t index) {
    return index == 0 ? state.light : state.more_lights[index - 1];
}

/// The state as one light sees it that lights a slice of the view, or all of it.
SceneState seen_by(const SceneState& state, size_t light, const glm::dvec2* slice) {
    SceneState own = state;
    own.light = light_of(state, light);
    own.more_lights.clear();
    if (slice) {
        own.camera.near = slice->x;
        own.camera.far = slice->y;
    }
    return own;
}

/// Of all casters, where they are.
glm::dvec3 middle_of_casters(const SceneExtents& extents, const SceneState& state) {
    Bounds bounds;
    for (size_t i = 0; i < extents.parts.size(); ++i) {
        const glm::dmat4 placement = SceneExtents::placement(state, i);
        for (const glm::vec3& corner : extents.parts[i].casters) {
            bounds.add(glm::dvec3(placement * glm::dvec4(corner, 1)));
        }
    }
    return bounds.empty() ? glm::dvec3(0) : bounds.centre();
}

/// The plane through the eye, facing along the view.
glm::dvec4 along_view(const Camera& camera) {
    return {-camera.basis.back, glm::dot(camera.basis.back, camera.eye)};
}

/// Milliseconds that something takes on the CPU.
template <typename Work>
double timed_ms(Work work) {
    const auto started = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
}

}  // namespace

ShadowRenderer::ShadowRenderer(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                               const SceneState& first, double aspect)
    : entry_(entry),
      settings_(settings),
      middle_(middle_of_casters(scene.extents, first)),
      lighting_pass_(std::string(entry.name)) {
    match_lights(scene, first, aspect);
}

void ShadowRenderer::match_lights(const GpuScene& scene, const SceneState& state, double aspect) {
    const size_t wanted = (1 + state.more_lights.size()) * settings_.cascades.count;
    while (shadows_.size() > wanted) shadows_.pop_back();
    while (shadows_.size() < wanted) {
        const size_t light = shadows_.size() / settings_.cascades.count;
        shadows_.emplace_back(entry_, settings_, scene, seen_by(state, light, nullptr), aspect, middle_);
    }
}

ShadowRenderer::Asked ShadowRenderer::questions_of(const std::vector<Turn>& turns) {
    Asked asked;
    for (size_t i = 0; i < turns.size(); ++i) {
        if (const auto question = shadows_[i].question(turns[i].shape, turns[i].state, turns[i].part)) {
            asked.questions.push_back(*question);
            asked.turns.push_back(i);
        }
    }
    return asked;
}

void ShadowRenderer::ask(const Asked& asked, std::vector<Turn>& turns, const GpuScene& scene, const SceneState& state,
                         const FrameTarget& target) {
    const std::vector<Shown> answers = query_.ask(scene, state, target, asked.questions);
    for (size_t i = 0; i < answers.size(); ++i) {
        turns[asked.turns[i]].shown = answers[i];
        shadows_[asked.turns[i]].answered(answers[i]);
    }
}

void ShadowRenderer::choose_whether_to_store(const std::vector<Turn>& turns, bool asks, const GpuScene& scene,
                                             const SceneState& state, const FrameTarget& target) {
    const std::optional<uint64_t> fragments = surface_pass_.take_fragments();
    const std::optional<uint64_t> pixels = lighting_pass_.take_pixels();
    // Surfaces that are stored still are lit without being counted again.
    if (fragments && pixels) {
        choice_.counts = {.fragments = static_cast<double>(*fragments),
                          .pixels = static_cast<double>(*pixels),
                          .triangles = static_cast<double>(stored_triangles_)};
    }
    std::vector<double> costs;
    bool repeats = false;
    for (size_t i = 0; i < turns.size(); ++i) {
        costs.push_back(shadows_[i].lighting_cost(turns[i].shown));
        SceneState lit = turns[i].state;
        lit.camera = state.camera;
        repeats = repeats || shadows_[i].repeats(turns[i].shown, turns[i].shape, scene, lit, target);
    }
    choice_ = choose_surfaces(choice_, costs, asks || repeats || !settings_.skips.needless_storing);
}

FrameTime ShadowRenderer::draw_once(const ShadowMapShape* first_shape, bool again, const GpuScene& scene,
                                    const SceneState& state, const FrameTarget& target, gl::PassTimer& timer) {
    const double aspect = static_cast<double>(target.width) / target.height;
    const size_t slices = settings_.cascades.count;
    const size_t lights = 1 + state.more_lights.size();
    // Surfaces of several samples can't be.
    const bool may_store = settings_.skips.hidden_surfaces && target.samples == 1;
    FrameTime time;

    match_lights(scene, state, aspect);
    DrawList surfaces;
    std::vector<Turn> turns(shadows_.size());
    time.fit_ms += timed_ms([&] {
        const std::vector<glm::dvec4> view =
            settings_.skips.unseen_triangles ? view_planes(state.camera, aspect) : std::vector<glm::dvec4>{};
        const bool back_faces = !settings_.skips.back_faces;
        surfaces = settings_.skips.overdraw ? draw_list_from(along_view(state.camera), scene, state, view, back_faces)
                                            : draw_list(scene, state, view, Which::all, back_faces);
        std::vector<double> borders;
        for (size_t i = 0; i < turns.size(); ++i) {
            auto& [own, part, shape, shown] = turns[i];
            const size_t slice = i % slices;
            part.index = i / slices;
            if (slices > 1 && slice == 0) {
                const glm::dvec2 range = shadows_[i].shadowed_range(scene, seen_by(state, part.index, nullptr), aspect);
                borders = split_distances(range.x, range.y, settings_.cascades);
            }
            part.count = lights;
            glm::dvec2 range;
            if (slices > 1) {
                range = {borders[slice], borders[slice + 1]};
                // Nearer and farther surfaces are the first's and the last's.
                part.slice = glm::dvec2(slice == 0 ? -2 : range.x, slice + 1 == slices ? 1e30 : range.y);
            }
            own = seen_by(state, part.index, slices > 1 ? &range : nullptr);
            shape = i == 0 && first_shape ? *first_shape : shadows_[i].choose(scene, own, aspect, target.height, again);
            if (settings_.skips.unseen_shadows && shape.frustum.shadowless) shown = Shown::light;
        }
    });
    Asked asked;
    if (may_store) {
        asked = questions_of(turns);
        choose_whether_to_store(turns, !asked.questions.empty(), scene, state, target);
        time.stored = choice_.stored;
    }
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (time.stored) {
        timer.start();
        // Nothing that is seen has moved, and nobody else has stored surfaces here since.
        Stored now{scene.serial, target.serial, *target.stored_surfaces, state.camera, state.movers};
        if (!settings_.skips.unchanged_pixels || stored_ != now) {
            surface_pass_.draw(scene, state, surfaces, target);
            stored_triangles_ = triangle_count(surfaces);
            now.count = *target.stored_surfaces;
            stored_ = std::move(now);
        }
        time.surfaces = timer.stop();
        timer.start();
        ask(asked, turns, scene, state, target);
        time.query = timer.stop();
    }
    for (size_t i = 0; i < turns.size(); ++i) {
        const auto& [own, part, shape, shown] = turns[i];
        shadows_[i].update_map(shape, shown, scene, own, timer, time);
        // The picture is the whole camera's.
        SceneState lit = own;
        lit.camera = state.camera;
        shadows_[i].light(shown, scene, lit, surfaces, time.stored, target, part, lighting_pass_, timer, time);
    }
    gl::throw_on_error("drawing a frame");
    return time;
}

FrameTime ShadowRenderer::draw_with(const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                                    const FrameTarget& target, gl::PassTimer& timer) {
    return draw_once(&shape, false, scene, state, target, timer);
}

FrameTime ShadowRenderer::draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                               gl::PassTimer& timer) {
    match_lights(scene, state, static_cast<double>(target.width) / target.height);
    const auto texels = [&] {
        std::vector<glm::dvec2> list;
        for (const LightShadow& shadow : shadows_) list.push_back(shadow.map().shape.texel());
        return list;
    };
    FrameTime time = draw_once(nullptr, false, scene, state, target, timer);
    const bool settles = target.samples == 1 && std::any_of(shadows_.begin(), shadows_.end(),
                                                            [](const LightShadow& one) { return one.settles(); });
    for (int i = 1; settles && i < kMostSettlingFrames; ++i) {
        const std::vector<glm::dvec2> before = texels();
        time = draw_once(nullptr, true, scene, state, target, timer);
        if (texels() == before) break;
    }
    return time;
}

}  // namespace stairstep
