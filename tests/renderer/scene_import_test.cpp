// Models as they come: whole, broken, and malicious. None may crash or hang.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "renderer/scene_import.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"

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

TEST_F(SceneImport, EveryModelOfAssimpsTestsLoadsOrIsRefused) {
    ASSERT_TRUE(fs::is_directory(kModels)) << "install assimp-testmodels";
    int loaded = 0;
    int refused = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kModels)) {
        if (!entry.is_regular_file() || entry.file_size() > (20u << 20)) continue;
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
