// Models as they come: whole, broken, and malicious. None may crash or hang.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "renderer/scene_import.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";
const fs::path kTruck = kModels / "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";

class SceneImport : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const std::string& name, const std::string& content) const {
        write_file(folder_ / name, content);
        return folder_ / name;
    }

    /// Expects an InputError whose text names the file and contains `part`.
    static void expect_rejected(const fs::path& path, const std::string& part = "") {
        try {
            import_scene(path);
            ADD_FAILURE() << path << " was accepted";
        } catch (const InputError& e) {
            const std::string message = e.what();
            EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
            EXPECT_NE(message.find(part), std::string::npos) << message;
        }
    }

    fs::path folder_ = fs::temp_directory_path() / ("stairstep-import-" + std::to_string(getpid()));
};

TEST_F(SceneImport, TheTruck) {
    const ImportedScene imported = import_scene(kTruck);
    EXPECT_TRUE(imported.warnings.empty()) << imported.warnings.front();
    EXPECT_EQ(triangle_count(imported.scene), 3624u);
    ASSERT_EQ(imported.scene.textures.size(), 1u);
    const Bounds bounds = caster_bounds(imported.scene);
    EXPECT_GT(bounds.diagonal(), 1);
    EXPECT_LT(bounds.diagonal(), 100);
    for (const Mesh& mesh : imported.scene.meshes) {
        EXPECT_LT(mesh.material, imported.scene.materials.size());
        for (const Vertex& vertex : mesh.vertices) ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4);
    }
}

TEST_F(SceneImport, NormalsAreMadeWhereThereAreNone) {
    const Scene scene = import_scene(file("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n")).scene;
    ASSERT_EQ(triangle_count(scene), 1u);
    for (const Vertex& vertex : scene.meshes[0].vertices) EXPECT_NEAR(vertex.normal.y, 1, 1e-6);
}

TEST_F(SceneImport, AMissingTextureIsAWarning) {
    file("m.mtl", "newmtl red\nKd 1 0.25 0\nmap_Kd nowhere.png\n");
    const ImportedScene imported =
        import_scene(file("m.obj", "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n"));
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_NE(imported.warnings[0].find("nowhere.png"), std::string::npos);
    const Material& material = imported.scene.materials[imported.scene.meshes[0].material];
    EXPECT_FALSE(material.texture);
    EXPECT_FLOAT_EQ(material.base_colour.g, 0.25f);
}

// Importers hand on what they find: a material may name its texture "" or its own folder.
TEST_F(SceneImport, AFolderForATextureIsAWarning) {
    file("m.mtl", "newmtl red\nmap_Kd ./\n");
    const ImportedScene imported =
        import_scene(file("m.obj", "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n"));
    EXPECT_EQ(imported.warnings.size(), 1u);
}

TEST_F(SceneImport, TheGroundLiesUnderTheCastersAndCastsNothing) {
    Scene scene = import_scene(kTruck).scene;
    const Bounds before = caster_bounds(scene);
    add_ground(scene, 8);
    EXPECT_EQ(caster_bounds(scene).low, before.low);
    EXPECT_EQ(scene.meshes.back().vertices[0].position.y, static_cast<float>(before.low.y));
    EXPECT_FALSE(scene.meshes.back().casts);
}

TEST_F(SceneImport, WhatIsNoModelIsAnInputError) {
    expect_rejected(folder_ / "missing.gltf", "isn't a file");
    expect_rejected(folder_);
    expect_rejected(file("empty.obj", ""));
    expect_rejected(file("noise.gltf", std::string(5000, '\x07')));
    expect_rejected(file("noise.glb", "glTF" + std::string(500, '\xff')));
    expect_rejected(file("unknown.xyzzy", "v 0 0 0\n"));
    expect_rejected(file("points.obj", "v 0 0 0\nv 1 0 0\n"));
}

TEST_F(SceneImport, NumbersThatAreNoneAreInputErrors) {
    expect_rejected(file("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"));
    expect_rejected(file("inf.obj", "v inf 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"));
    expect_rejected(file("huge.obj", "v 1e30 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"), "beyond 1e12");
    expect_rejected(file("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"));
    expect_rejected(file("index.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 4000000000\n"));
}

TEST_F(SceneImport, ATruncatedTruckNeverCrashes) {
    for (const char* part : {"CesiumMilkTruck.bin", "CesiumMilkTruck.png"}) {
        fs::copy_file(kTruck.parent_path() / part, folder_ / part);
    }
    const std::string whole = read_file(kTruck);
    for (int i = 0; i < 24; ++i) {
        expect_rejected(file("cut.gltf", whole.substr(0, whole.size() * i / 24)));
    }
    // The text whole, its vertices cut.
    const std::string vertices = read_file(folder_ / "CesiumMilkTruck.bin");
    file("CesiumMilkTruck.bin", vertices.substr(0, vertices.size() / 2));
    expect_rejected(file("cut.gltf", whole));
}

/// A triangle as glTF, with what else the file shall hold.
std::string gltf_triangle(const std::string& nodes, const std::string& more, const std::string& count = "3") {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}], "nodes": [{"mesh": 0}, )" +
           nodes + R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": )" +
           count + R"(, "type": "VEC3"}],
               "bufferViews": [{"buffer": 0, "byteLength": 36}],
               "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
           // (0, 0, 0), (1, 0, 0), (0, 1, 0) as floats.
           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" + more + "}";
}

const std::string kThreeNodes = R"({"name": "a"}, {"name": "b"}, {"name": "c"})";

// Cameras.gltf says: at (0.5, 0.5, 3), looking along -z, yfov 0.7 rad; its second camera is orthographic.
TEST_F(SceneImport, APerspectiveCameraAndAnOrthographicOne) {
    const ImportedScene imported = import_scene(kModels / "glTF2/cameras/Cameras.gltf");
    ASSERT_EQ(imported.cameras.size(), 1u);
    const Camera& camera = imported.cameras[0];
    EXPECT_NEAR(glm::length(camera.eye - glm::dvec3(0.5, 0.5, 3)), 0, 1e-6);
    EXPECT_NEAR(glm::length(camera.basis.back - glm::dvec3(0, 0, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::length(camera.basis.up - glm::dvec3(0, 1, 0)), 0, 1e-6);
    EXPECT_NEAR(camera.vertical_fov_deg, 0.7 * 180 / std::numbers::pi, 1e-4);
    EXPECT_NEAR(camera.near, 0.01, 1e-6);
    EXPECT_NEAR(camera.far, 100, 1e-3);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_NE(imported.warnings[0].find("orthographic"), std::string::npos);
}

// Blender's default camera has a horizontal field of 49.134 degrees at 16:9, so 28.842 vertically.
TEST_F(SceneImport, AColladaCamerasFieldOfViewIsHorizontal) {
    const ImportedScene imported = import_scene(kModels / "Collada/cameras.dae");
    ASSERT_EQ(imported.cameras.size(), 3u);
    EXPECT_NEAR(imported.cameras[0].vertical_fov_deg, 28.842, 1e-3);
    EXPECT_NEAR(glm::length(imported.cameras[0].eye - glm::dvec3(10, 0, 0)), 0, 1e-4);
    EXPECT_NEAR(imported.cameras[0].basis.back.x, 1, 1e-4) << "looks at the origin";
}

TEST_F(SceneImport, LightsOfAllKinds) {
    // The first node is turned 90 degrees about y: -z becomes -x. The second looks straight down.
    const ImportedScene imported = import_scene(file(
        "lights.gltf",
        gltf_triangle(R"({"rotation": [0, 0.70710678, 0, 0.70710678], "scale": [2, 2, 2],
                          "extensions": {"KHR_lights_punctual": {"light": 0}}},
                         {"translation": [1, 5, 2], "rotation": [-0.70710678, 0, 0, 0.70710678],
                          "extensions": {"KHR_lights_punctual": {"light": 1}}},
                         {"translation": [0.5, 0.5, 4], "extensions": {"KHR_lights_punctual": {"light": 2}}})",
                      R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [
                         {"type": "directional"}, {"type": "spot", "spot": {"outerConeAngle": 0.5}},
                         {"type": "point"}]}})")));
    ASSERT_EQ(imported.lights.size(), 3u);
    EXPECT_EQ(imported.lights[0].kind, Light::Kind::directional);
    EXPECT_NEAR(glm::length(imported.lights[0].basis.back - glm::dvec3(1, 0, 0)), 0, 1e-5);
    const Light& spot = imported.lights[1];
    EXPECT_EQ(spot.kind, Light::Kind::spot);
    EXPECT_NEAR(glm::length(spot.position - glm::dvec3(1, 5, 2)), 0, 1e-5);
    EXPECT_NEAR(glm::length(spot.basis.back - glm::dvec3(0, 1, 0)), 0, 1e-5);
    EXPECT_NEAR(spot.cone_deg, 0.5 * 180 / std::numbers::pi, 1e-4);
    // Towards the triangle's bounds' middle, (0.5, 0.5, 0), and around all of their corners.
    const Light& point = imported.lights[2];
    EXPECT_EQ(point.kind, Light::Kind::spot);
    EXPECT_NEAR(glm::length(point.basis.back - glm::dvec3(0, 0, 1)), 0, 1e-5);
    const double to_corner_deg = std::atan(std::sqrt(0.5) / 4) * 180 / std::numbers::pi;
    EXPECT_GE(point.cone_deg, to_corner_deg);
    EXPECT_LE(point.cone_deg, to_corner_deg + 2);
    ASSERT_EQ(imported.warnings.size(), 1u);
    for (const Light& light : imported.lights) {
        EXPECT_NEAR(glm::length(glm::cross(light.basis.right, light.basis.up) - light.basis.back), 0, 1e-6);
        EXPECT_EQ(light.half_side, 0);
    }
}

TEST_F(SceneImport, BrokenCamerasAndLightsAreLeftOutWithAWarning) {
    const ImportedScene imported =
        import_scene(file("broken.gltf", gltf_triangle(R"({"scale": [0, 0, 0], "camera": 0}, {"camera": 1},
                                        {"scale": [0, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}})",
                                                       R"(, "cameras": [
                                        {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 1, "zfar": 9}},
                                        {"type": "perspective", "perspective": {"yfov": 7, "znear": 1, "zfar": 9}}],
                                        "extensionsUsed": ["KHR_lights_punctual"],
                                        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}})")));
    EXPECT_TRUE(imported.cameras.empty());
    EXPECT_TRUE(imported.lights.empty());
    EXPECT_EQ(imported.warnings.size(), 3u);
}

TEST_F(SceneImport, TexturesInsideTheModel) {
    for (const char* name :
         {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
        const ImportedScene imported = import_scene(kModels / name);
        EXPECT_TRUE(imported.warnings.empty()) << imported.warnings.front();
        ASSERT_EQ(imported.scene.textures.size(), 1u) << name;
        // The same picture lies beside another of the models.
        const Image beside = read_image(kModels / "glTF2/BoxTextured-glTF/CesiumLogoFlat.png");
        EXPECT_EQ(imported.scene.textures[0].width, beside.width);
        EXPECT_EQ(imported.scene.textures[0].pixels, beside.pixels);
        EXPECT_TRUE(imported.scene.materials[imported.scene.meshes[0].material].texture);
    }
}

TEST_F(SceneImport, ADamagedTextureInsideTheModelIsAWarning) {
    std::string model = read_file(kModels / "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb");
    const size_t png = model.find("\x89PNG");
    ASSERT_NE(png, std::string::npos);
    for (size_t i = 0; i < 200; ++i) model[png + 8 + i] = static_cast<char>(i);
    for (const char* magic : {"\x89PNG", "II*\n", "GIF8", "none"}) {
        const ImportedScene imported = import_scene(file("box.glb", model.replace(png, 4, magic)));
        EXPECT_EQ(imported.warnings.size(), 1u) << magic;
        EXPECT_TRUE(imported.scene.textures.empty()) << magic;
    }
}

TEST_F(SceneImport, CountsThatTheFileDoesNotHoldAreInputErrors) {
    EXPECT_EQ(triangle_count(import_scene(file("good.gltf", gltf_triangle(kThreeNodes, ""))).scene), 1u);
    expect_rejected(file("bad.gltf", gltf_triangle(kThreeNodes, "", "4000000000")));
    expect_rejected(file("bad.gltf", gltf_triangle(kThreeNodes, "", "-1")));
    expect_rejected(file("bad.ply",
                         "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                         "property float x\nproperty float y\nproperty float z\n"
                         "element face 1\nproperty list uchar int vertex_index\nend_header\n"));
}

// Importers crash on some of these, each in its own way.
TEST_F(SceneImport, FlippedBitsLoadOrAreRefused) {
    const Random random(1);
    uint64_t part = 0;
    for (const char* name : {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", "glTF2/cameras/Cameras.gltf",
                             "Collada/cube_with_2UVs.DAE", "COB/molecule.cob", "LWO/LWO2/boxuv.lwo", "OBJ/box.obj",
                             "3DS/cube_with_diffuse_texture.3DS", "STL/Spider_binary.stl", "FBX/phong_cube.fbx"}) {
        const std::string whole = read_file(kModels / name);
        for (int variant = 0; variant < 6; ++variant) {
            Random stream = random.stream(part++);
            std::string damaged = whole;
            for (int flip = 0; flip < (variant % 2 ? 1 : 12); ++flip) {
                damaged[stream.below(damaged.size())] ^= static_cast<char>(1 << stream.below(8));
            }
            const fs::path path = file("damaged" + fs::path(name).extension().string(), damaged);
            try {
                for (const Mesh& mesh : import_scene(path).scene.meshes) {
                    for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size()) << name;
                }
            } catch (const InputError& e) {
                EXPECT_NE(std::string(e.what()).find("damaged"), std::string::npos) << e.what();
            }
        }
    }
}

TEST_F(SceneImport, EveryModelOfAssimpsTestsLoadsOrIsRefused) {
    ASSERT_TRUE(fs::is_directory(kModels)) << "install assimp-testmodels";
    int loaded = 0;
    int refused = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kModels)) {
        if (!entry.is_regular_file() || entry.file_size() > (20u << 20)) continue;
        const std::set<std::string> images{".png", ".jpg", ".jpeg", ".JPG", ".tga", ".bmp", ".BMP", ".gif", ".dds"};
        if (images.contains(entry.path().extension().string())) continue;
#ifdef __SANITIZE_ADDRESS__
        // The sanitizer leaves no room for MemoryLimit, and this one asks for 16 GB.
        if (entry.path().filename() == "OutOfMemory.off") continue;
#endif
        try {
            const Scene scene = import_scene(entry.path()).scene;
            const Bounds bounds = caster_bounds(scene);
            EXPECT_GT(triangle_count(scene), 0u) << entry.path();
            EXPECT_TRUE(std::isfinite(bounds.diagonal())) << entry.path();
            ++loaded;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(entry.path().string()), std::string::npos) << e.what();
            ++refused;
        }
    }
    EXPECT_GT(loaded, 200);
    EXPECT_GT(refused, 100) << "the folder holds broken models and texts too";
}

}  // namespace
}  // namespace stairstep
