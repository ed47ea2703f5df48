// What moves is drawn, casts and receives as the same mesh moved by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/gl/context.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 180;

class MoverShadow : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

std::vector<Mesh> body() {
    std::vector<Mesh> meshes = made::box({-0.5f, -0.25f, -0.375f}, {0.5f, 0.25f, 0.375f});
    for (Mesh& side : meshes) {
        const glm::vec3 a = side.vertices[0].position;
        const glm::vec3 normal = glm::cross(side.vertices[1].position - a, side.vertices[2].position - a);
        for (Vertex& vertex : side.vertices) vertex.normal = glm::normalize(normal);
    }
    meshes.push_back(made::sphere(0.25f, 12));
    for (Vertex& vertex : meshes.back().vertices) vertex.position.y += 0.5f;
    return meshes;
}

struct Scenes {
    Scene moving;
    Scene by_hand;
};

Scenes scenes_of(const glm::dmat4& world_from_mover) {
    std::vector<Mesh> moving = body();
    std::vector<Mesh> moved = body();
    for (size_t i = 0; i < moving.size(); ++i) {
        // Mover 0 is another one, which has no mesh.
        moving[i].mover = 1;
        for (Vertex& vertex : moved[i].vertices) {
            vertex.position = glm::vec3(world_from_mover * glm::dvec4(vertex.position, 1));
            vertex.normal = glm::vec3(glm::dmat3(world_from_mover) * glm::dvec3(vertex.normal));
        }
    }
    moving.push_back(made::ground(0, 9));
    moved.push_back(made::ground(0, 9));
    return {made::scene_of(moving), made::scene_of(moved)};
}

struct Pictures {
    std::vector<float> visibility;
    std::vector<uint8_t> colour;
    std::vector<float> depth;
};

Pictures draw(const Scene& scene, const SceneState& state, const std::string& technique,
              const ShadowSettings& settings) {
    const GpuScene gpu = upload(scene);
    gl::PassTimer timer;
    Pictures pictures;
    ShadowRenderer renderer(technique_named(technique), settings, gpu, state, static_cast<double>(kWidth) / kHeight);
    const FrameTarget visibility = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    renderer.draw(gpu, state, visibility, timer);
    pictures.visibility = read_visibility(visibility);
    const FrameTarget colour = make_frame_target(Show::colour, kWidth, kHeight, 1);
    renderer.draw(gpu, state, colour, timer);
    pictures.colour = read_colour(colour).pixels;
    pictures.depth.resize(kWidth * kHeight);
    gl::GetTextureImage(colour.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, kWidth * kHeight * 4,
                        pictures.depth.data());
    return pictures;
}

template <typename T>
int differing(const std::vector<T>& a, const std::vector<T>& b, double tolerance) {
    int count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += std::abs(static_cast<double>(a[i]) - b[i]) > tolerance;
    return count;
}

struct Case {
    const char* technique;
    std::optional<int> size;
    Light light;
};

std::vector<Case> cases() {
    const Light sun = directional_light({35, 50}, 0.06);
    const Light spot = spot_light({2, 4, 3}, {0, 0.25, 0}, 0.2, 40);
    // A spot's constant radius is a length at the scene's middle, which knows nothing of where movers are.
    return {{"pcf", 256, sun},           {"pcf", std::nullopt, sun}, {"pcss", 256, sun},
            {"pcss", std::nullopt, sun}, {"hard", 256, spot},        {"pcss", std::nullopt, spot}};
}

void expect_same(const glm::dmat4& world_from_mover, int most_differing) {
    const Scenes scenes = scenes_of(world_from_mover);
    for (const Case& c : cases()) {
        SCOPED_TRACE(testing::Message() << c.technique << " " << c.size.value_or(0));
        ShadowSettings settings;
        settings.technique.filter = FilterMode::exact;
        settings.fixed_size = c.size;
        settings.largest_size = 1024;
        settings.radius = 0.08;
        SceneState state{
            camera_looking_at({1.5, 3, 3.5}, {0, 0.25, 0}, 40, 0.5, 30), c.light, {glm::dmat4(0), world_from_mover}};
        const Pictures moving = draw(scenes.moving, state, c.technique, settings);
        const Pictures by_hand = draw(scenes.by_hand, state, c.technique, settings);
        EXPECT_LE(differing(moving.depth, by_hand.depth, 1e-6), most_differing);
        EXPECT_LE(differing(moving.visibility, by_hand.visibility, 2e-3), most_differing);
        EXPECT_LE(differing(moving.colour, by_hand.colour, 1), 3 * most_differing);
        state.movers[1] = glm::dmat4(1);
        EXPECT_GT(differing(draw(scenes.moving, state, c.technique, settings).depth, by_hand.depth, 1e-6), 500)
            << "it should have moved";
    }
}

// Whole eighths and quarter turns are exact in floats.
TEST_F(MoverShadow, IsThatOfTheSameMeshElsewhere) {
    expect_same(glm::dmat4({0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0.25, 0.625, -0.375, 1}), 0);
}

// Elsewhere rounding may decide about single pixels at silhouettes.
TEST_F(MoverShadow, IsThatOfTheSameMeshTurnedByAnyAngle) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    const Basis basis = basis_towards(direction_of(back));
    expect_same(glm::dmat4(glm::dvec4(basis.right, 0), glm::dvec4(basis.up, 0), glm::dvec4(basis.back, 0),
                           {0.31, 0.77, -0.29, 1}),
                kWidth * kHeight / 2000);
}

}  // namespace
}  // namespace stairstep
