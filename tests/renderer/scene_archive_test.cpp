#include "renderer/scene_archive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace stairstep {
namespace {

ImportedScene small_scene() {
    ImportedScene imported;
    Mesh mesh;
    mesh.vertices = {{{1, 2, 3}, {0, 1, 0}, {0.5f, 0.25f}}, {{4, 5, 6}, {1, 0, 0}, {}}, {{7, 8, 9}, {0, 0, 1}, {}}};
    mesh.indices = {2, 0, 1};
    mesh.material = 1;
    mesh.casts = false;
    mesh.fades = true;
    imported.scene.meshes = {mesh, mesh};
    imported.scene.materials = {{}, {glm::vec3(0.1f, 0.2f, 0.3f), 0}};
    Image image(2, 1, 3);
    image.pixels = {1, 2, 3, 4, 5, 6};
    imported.scene.textures = {image};
    imported.cameras = {camera_looking_at({1, 2, 3}, {0, 0, 0}, 50, 0.5, 70)};
    imported.lights = {spot_light({0, 5, 1}, {0, 0, 0}, 0.3, 40)};
    imported.warnings = {"one", ""};
    return imported;
}

TEST(SceneArchive, ComesBackAsItWent) {
    const ImportedScene before = small_scene();
    const ImportedScene after = scene_from_archive(archive_of(before));
    ASSERT_EQ(after.scene.meshes.size(), 2u);
    const Mesh& mesh = after.scene.meshes[1];
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.vertices[1].normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.indices, before.scene.meshes[1].indices);
    EXPECT_EQ(mesh.material, 1u);
    EXPECT_FALSE(mesh.casts);
    EXPECT_TRUE(mesh.fades);
    EXPECT_FALSE(mesh.mover);
    ASSERT_EQ(after.scene.materials.size(), 2u);
    EXPECT_EQ(after.scene.materials[1].texture, std::optional<size_t>(0));
    EXPECT_EQ(after.scene.textures.at(0).pixels, before.scene.textures[0].pixels);
    EXPECT_EQ(after.cameras.at(0).eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(after.cameras.at(0).far, 70);
    EXPECT_EQ(after.lights.at(0).kind, Light::Kind::spot);
    EXPECT_EQ(after.lights.at(0).cone_deg, 40);
    EXPECT_EQ(after.warnings, before.warnings);
}

TEST(SceneArchive, NoCutIsTaken) {
    const std::string whole = archive_of(small_scene());
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_THROW(scene_from_archive(std::string_view(whole).substr(0, size)), std::runtime_error) << size;
    }
    EXPECT_THROW(scene_from_archive(whole + '\0'), std::runtime_error);
}

TEST(SceneArchive, IndicesThatLeadNowhereAreRefused) {
    ImportedScene bad = small_scene();
    bad.scene.meshes[0].indices[1] = 3;
    EXPECT_THROW(scene_from_archive(archive_of(bad)), std::runtime_error);
    bad = small_scene();
    bad.scene.meshes[0].material = 2;
    EXPECT_THROW(scene_from_archive(archive_of(bad)), std::runtime_error);
    bad = small_scene();
    bad.scene.materials[0].texture = 1;
    EXPECT_THROW(scene_from_archive(archive_of(bad)), std::runtime_error);
    bad = small_scene();
    bad.scene.textures[0].width = 3;
    EXPECT_THROW(scene_from_archive(archive_of(bad)), std::runtime_error);
}

TEST(SceneArchive, NumbersThatAreNoneAreRefused) {
    const auto refused = [](const auto& spoil) {
        ImportedScene bad = small_scene();
        spoil(bad);
        EXPECT_THROW(scene_from_archive(archive_of(bad)), std::runtime_error);
    };
    refused([](ImportedScene& s) { s.scene.meshes[0].vertices[2].position.y = NAN; });
    refused([](ImportedScene& s) { s.scene.meshes[1].vertices[0].position.x = 2e12f; });
    refused([](ImportedScene& s) { s.scene.meshes[1].vertices[0].normal.z = INFINITY; });
    refused([](ImportedScene& s) { s.scene.materials[0].base_colour.x = NAN; });
    refused([](ImportedScene& s) { s.cameras[0].near = 0; });
    refused([](ImportedScene& s) { s.cameras[0].far = INFINITY; });
    refused([](ImportedScene& s) { s.cameras[0].vertical_fov_deg = 1e300; });
    refused([](ImportedScene& s) { s.lights[0].basis.up.x = NAN; });
    refused([](ImportedScene& s) { s.lights[0].cone_deg = 0; });
}

TEST(SceneArchive, NoByteGivesAnotherScene) {
    // Whatever a byte is set to, the archive is refused, or holds a scene whose archive it is: a flag of 2 would read as 1.
    const std::string whole = archive_of(small_scene());
    int taken = 0;
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string spoilt = whole;
        spoilt[at] = static_cast<char>(spoilt[at] + 2);
        try {
            EXPECT_EQ(archive_of(scene_from_archive(spoilt)), spoilt) << at;
            ++taken;
        } catch (const std::runtime_error&) {
        }
    }
    EXPECT_GT(taken, 50);
}

}  // namespace
}  // namespace stairstep
