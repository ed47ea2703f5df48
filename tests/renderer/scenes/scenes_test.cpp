// Every scene of the list, in every motion.
#include "renderer/scenes/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderer/scene_import.h"
#include "stimuli/error.h"
#include "tests/renderer/scenes/mesh_properties.h"

namespace stairstep {
namespace {

constexpr Motion kMotions[] = {Motion::still, Motion::light, Motion::caster, Motion::camera};
const std::string kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";

/// The scenes by name and a model; each is made once.
const std::vector<AnimatedScene>& all() {
    static const std::vector<AnimatedScene> made = [] {
        std::vector<AnimatedScene> list;
        for (const SceneEntry& entry : scenes()) list.push_back(entry.make());
        list.push_back(load_animated_scene(kTruck));
        return list;
    }();
    return made;
}

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0;
    for (int i = 0; i < 16; ++i) largest = std::max(largest, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    return largest;
}

glm::dmat4 matrix_of(const Basis& basis, const glm::dvec3& origin) {
    return {glm::dvec4(basis.right, 0), glm::dvec4(basis.up, 0), glm::dvec4(basis.back, 0), glm::dvec4(origin, 1)};
}

/// Over camera, light and movers.
double largest_difference(const SceneState& a, const SceneState& b) {
    double largest = std::max(
        largest_difference(matrix_of(a.camera.basis, a.camera.eye), matrix_of(b.camera.basis, b.camera.eye)),
        largest_difference(matrix_of(a.light.basis, a.light.position), matrix_of(b.light.basis, b.light.position)));
    largest =
        std::max({largest, std::abs(a.camera.near - b.camera.near), std::abs(a.camera.far - b.camera.far),
                  std::abs(a.camera.vertical_fov_deg - b.camera.vertical_fov_deg),
                  std::abs(a.light.half_side - b.light.half_side), std::abs(a.light.cone_deg - b.light.cone_deg)});
    for (size_t i = 0; i < a.movers.size(); ++i) {
        largest = std::max(largest, largest_difference(a.movers[i], b.movers[i]));
    }
    return largest;
}

bool is_rigid(const glm::dmat4& m) {
    const glm::dmat3 rotation(m);
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    return largest_difference(glm::dmat4(product), glm::dmat4(1)) < 1e-12 && glm::determinant(rotation) > 0 &&
           m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
}

/// Whether a point is in a picture of 16:9.
bool is_seen(const Camera& camera, const glm::dvec3& point) {
    const glm::vec4 p = glm::mat4(clip_from_world(camera, 16.0 / 9)) * glm::vec4(point, 1);
    return p.w > 0 && std::abs(p.x) < p.w && std::abs(p.y) < p.w && p.z > 0 && p.z < p.w;
}

TEST(Scenes, NamesAreFoundAndOthersAreListed) {
    for (const SceneEntry& entry : scenes()) {
        EXPECT_EQ(scene_named(std::string(entry.name)).name, entry.name);
        EXPECT_FALSE(entry.summary.empty());
    }
    for (const auto load : {scene_named, load_animated_scene}) {
        try {
            load("cathedral");
            ADD_FAILURE();
        } catch (const InputError& e) {
            for (const SceneEntry& entry : scenes()) {
                EXPECT_NE(std::string(e.what()).find(entry.name), std::string::npos) << e.what();
            }
        }
    }
}

TEST(Scenes, AreAsLargeAsTheySay) {
    EXPECT_GE(triangle_count(scene_named("city").scene), 1'000'000u);
    EXPECT_GE(triangle_count(scene_named("crane").scene), 3000u);
    size_t boxes = 0;
    for (const Mesh& mesh : scene_named("clutter").scene.meshes) {
        if (mesh.casts) boxes += mesh.indices.size() / 36;
    }
    EXPECT_EQ(boxes, 2000u);
    EXPECT_EQ(scene_named("cornell").state(Motion::still, 0).light.kind, Light::Kind::spot);
}

TEST(Scenes, AreWhole) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        const size_t movers = animated.state(Motion::still, 0).movers.size();
        size_t moving = 0;
        size_t receivers = 0;
        for (const Mesh& mesh : animated.scene.meshes) {
            EXPECT_FALSE(mesh.indices.empty());
            EXPECT_LT(mesh.material, animated.scene.materials.size());
            EXPECT_TRUE(!mesh.mover || *mesh.mover < movers);
            moving += mesh.mover.has_value();
            receivers += !mesh.casts;
            for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
        }
        EXPECT_GT(moving, 0u);
        EXPECT_GT(receivers, 0u);
        for (const Material& material : animated.scene.materials) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(material.base_colour, glm::vec3(0))));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(material.base_colour, glm::vec3(1))));
        }
    }
}

TEST(Scenes, CastersAreClosedWithOutwardNormals) {
    for (const SceneEntry& entry : scenes()) {
        SCOPED_TRACE(entry.name);
        for (const Mesh& mesh : scene_named(std::string(entry.name)).scene.meshes) {
            expect_unit_outward_normals(mesh);
            if (!mesh.casts) continue;
            EXPECT_GT(volume_of(mesh), 0);
            // The city's meshes are large, and of the same shapes.
            if (mesh.indices.size() < 300'000) {
                EXPECT_TRUE(is_watertight(mesh));
            }
        }
    }
}

TEST(Scenes, StandOnTheirGround) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        double ground = INFINITY;
        for (const Mesh& mesh : animated.scene.meshes) {
            for (const Vertex& vertex : mesh.vertices) {
                if (!mesh.casts) ground = std::min<double>(ground, vertex.position.y);
            }
        }
        for (const double t : {0.0, 0.3, 0.7, 1.0}) {
            const Bounds casters = caster_bounds(animated.scene, animated.state(Motion::caster, t));
            EXPECT_NEAR(casters.low.y, ground, 0.01 * casters.diagonal()) << t;
        }
    }
}

TEST(Scenes, TheSameSeedIsTheSameScene) {
    for (const char* name : {"city", "clutter"}) {
        const Scene first = scene_named(name).scene;
        const Scene second = scene_named(name).scene;
        ASSERT_EQ(first.meshes.size(), second.meshes.size());
        for (size_t i = 0; i < first.meshes.size(); ++i) {
            const Mesh& a = first.meshes[i];
            const Mesh& b = second.meshes[i];
            EXPECT_EQ(a.indices, b.indices);
            ASSERT_EQ(a.vertices.size(), b.vertices.size());
            EXPECT_EQ(std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)), 0);
        }
    }
}

TEST(Scenes, AllMotionsStartFromTheSameStateAndStillStays) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        const SceneState start = animated.state(Motion::still, 0);
        for (const Motion motion : kMotions) {
            EXPECT_EQ(largest_difference(animated.state(motion, 0), start), 0);
            EXPECT_EQ(animated.state(motion, 1).movers.size(), start.movers.size());
            if (motion != Motion::still) {
                EXPECT_GT(largest_difference(animated.state(motion, 0.4), start), 0.01);
            }
        }
        EXPECT_EQ(largest_difference(animated.state(Motion::still, 0.7), start), 0);
    }
}

// A motion moves what it names and nothing else.
TEST(Scenes, MotionsAreSeparate) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        const SceneState start = animated.state(Motion::still, 0);
        for (const Motion motion : kMotions) {
            SceneState state = animated.state(motion, 0.6);
            if (motion == Motion::camera) state.camera = start.camera;
            if (motion == Motion::light) state.light = start.light;
            if (motion == Motion::caster) state.movers = start.movers;
            EXPECT_EQ(largest_difference(state, start), 0);
        }
    }
}

// Halving a step halves the change, everywhere: no jumps, no corners.
TEST(Scenes, MotionsAreSmooth) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        const double scale = caster_bounds(animated.scene, animated.state(Motion::still, 0)).diagonal();
        for (const Motion motion : kMotions) {
            constexpr int kSteps = 200;
            SceneState before = animated.state(motion, 0);
            for (int i = 1; i <= kSteps; ++i) {
                const SceneState middle = animated.state(motion, (i - 0.5) / kSteps);
                const SceneState after = animated.state(motion, static_cast<double>(i) / kSteps);
                const double whole = largest_difference(before, after);
                EXPECT_LT(whole, 0.1 * scale) << i;
                EXPECT_NEAR(largest_difference(before, middle), whole / 2, 2e-3 * scale) << i;
                before = after;
            }
        }
    }
}

TEST(Scenes, MoversAreRigid) {
    for (const AnimatedScene& animated : all()) {
        for (int i = 0; i <= 20; ++i) {
            for (const glm::dmat4& mover : animated.state(Motion::caster, i / 20.0).movers) {
                EXPECT_TRUE(is_rigid(mover)) << animated.name;
            }
        }
    }
}

TEST(Scenes, CamerasAndLightsAreUsableAtAllTimes) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        for (const Motion motion : kMotions) {
            for (int i = 0; i <= 5; ++i) {
                const SceneState state = animated.state(motion, i / 5.0);
                EXPECT_TRUE(is_rigid(matrix_of(state.camera.basis, {})));
                EXPECT_TRUE(is_rigid(matrix_of(state.light.basis, {})));
                EXPECT_GT(state.camera.near, 0);
                EXPECT_LT(state.camera.near, state.camera.far);
                EXPECT_GT(state.light.half_side, 0);
                // Above the ground, so that shadows fall on it.
                EXPECT_GT(state.light.basis.back.y, 0.3);
                EXPECT_TRUE(is_seen(state.camera, caster_bounds(animated.scene, state).centre()));
            }
        }
    }
}

// The penumbra of what stands as high as the casters do is moderate, and so is the radius.
TEST(Scenes, RadiiAndPenumbrasAreModerate) {
    for (const AnimatedScene& animated : all()) {
        SCOPED_TRACE(animated.name);
        const SceneState state = animated.state(Motion::still, 0);
        const Bounds casters = caster_bounds(animated.scene, state);
        // The visible extent: the picture's height at the casters' middle.
        const double distance = glm::dot(state.camera.eye - casters.centre(), state.camera.basis.back);
        const double extent = pixel_footprint(state.camera, distance, 1);
        EXPECT_GE(animated.radius, 0.005 * extent);
        EXPECT_LE(animated.radius, 0.03 * extent);
        const double height = casters.high.y - casters.low.y;
        const double penumbra = state.light.kind == Light::Kind::spot
                                    ? state.light.half_side * height / (state.light.position.y - height)
                                    : state.light.half_tangent() * height / state.light.basis.back.y;
        EXPECT_GE(penumbra, 0.1 * animated.radius);
        EXPECT_LE(penumbra, 5 * animated.radius);
    }
}

TEST(Scenes, AModelAtRestIsWhereItsFileHasIt) {
    const AnimatedScene animated = load_animated_scene(kTruck);
    const ImportedScene imported = import_scene(kTruck);
    const Bounds moved = caster_bounds(animated.scene, animated.state(Motion::still, 0));
    const Bounds own = caster_bounds(imported.scene);
    EXPECT_NEAR(glm::length(moved.low - own.low) + glm::length(moved.high - own.high), 0, 1e-9);
    EXPECT_NEAR(animated.radius, 0.025 * own.diagonal(), 1e-12);
    EXPECT_EQ(triangle_count(animated.scene), triangle_count(imported.scene) + 2);
}

}  // namespace
}  // namespace stairstep
