#include "renderer/truth/truth_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/stored_image.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 24;
constexpr int kHeight = 16;
constexpr int kSamples = 16;

Scene made_scene() {
    std::vector<Mesh> meshes = made::box({-0.2f, 0, -0.1f}, {0.2f, 0.3f, 0.1f});
    meshes[0].mover = 0;
    meshes.push_back(made::ground(0, 9));
    return made::scene_of(meshes);
}

SceneState made_state() {
    return {made::camera_at({0, 1, 1}, {0, 45}), directional_light({30, 55}, 0.1), {glm::dmat4(1)}};
}

std::vector<float> cached(const fs::path& folder) {
    return cached_area_light_visibility(made_scene(), made_state(), kWidth, kHeight, kSamples, folder);
}

fs::path file_in(const fs::path& folder) {
    return folder / ("truth-" + truth_key(made_scene(), made_state(), kWidth, kHeight, kSamples) + ".exr");
}

TEST(TruthCache, IsWrittenOnceAndReadAfterwards) {
    const TemporaryFolder temporary;
    const fs::path folder = temporary.path() / "a" / "b";
    const std::vector<float> traced = area_light_visibility(made_scene(), made_state(), kWidth, kHeight, kSamples);
    EXPECT_EQ(cached(folder), traced);
    ASSERT_TRUE(fs::exists(file_in(folder)));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "nothing else is left there";

    // What a second call returns is what the file holds.
    StoredImage image = read_stored_image(file_in(folder));
    EXPECT_EQ(image.values, traced);
    image.values[5] = 0.375f;
    write_stored_image(file_in(folder), image, *stored_description(file_in(folder)));
    EXPECT_EQ(cached(folder), image.values);
}

TEST(TruthCache, ADamagedOrForeignFileIsMadeAnew) {
    const TemporaryFolder temporary;
    const std::vector<float> traced = cached(temporary.path());
    const fs::path file = file_in(temporary.path());
    const std::string whole = read_file(file);
    const StoredImage image = read_stored_image(file);
    const std::string description = *stored_description(file);
    const auto store = [&](const std::function<void(StoredImage&)>& change, const std::string& says) {
        StoredImage changed = image;
        change(changed);
        write_stored_image(file, changed, says);
    };
    const std::vector<std::pair<const char*, std::function<void()>>> damages{
        {"empty", [&] { write_file(file, ""); }},
        {"text", [&] { write_file(file, "no image\n"); }},
        {"half", [&] { write_file(file, whole.substr(0, whole.size() / 2)); }},
        {"all but the end", [&] { write_file(file, whole.substr(0, whole.size() - 7)); }},
        {"another size", [&] { store([](StoredImage& i) { std::swap(i.width_px, i.height_px); }, description); }},
        {"not a visibility", [&] { store([](StoredImage& i) { i.values[0] = 1.5f; }, description); }},
        {"not a number", [&] { store([](StoredImage& i) { i.values[0] = NAN; }, description); }},
        {"another's name", [&] { store([](StoredImage& i) { i.values[0] = 0.5f; }, description + "0"); }},
        {"no description", [&] { store([](StoredImage& i) { i.values[0] = 0.5f; }, ""); }}};
    for (const auto& [name, damage] : damages) {
        damage();
        testing::internal::CaptureStderr();
        EXPECT_EQ(cached(temporary.path()), traced) << name;
        EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("warning: ")) << name;
        EXPECT_EQ(read_file(file), whole) << name;
    }
}

TEST(TruthCache, AFolderThatCannotBeIsAWarning) {
    const TemporaryFolder temporary;
    write_file(temporary.path() / "file", "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(cached(temporary.path() / "file" / "below").size(), size_t{kWidth * kHeight});
    EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("warning: "));
}

TEST(TruthCache, TheKeyKnowsAllThatMatters) {
    const Scene scene = made_scene();
    const SceneState state = made_state();
    std::set<std::string> keys{truth_key(scene, state, kWidth, kHeight, kSamples)};
    size_t count = 1;
    const auto expect_new = [&](const std::string& key, const std::string& what) {
        EXPECT_EQ(key.size(), 32u);
        EXPECT_TRUE(keys.insert(key).second) << what;
        ++count;
    };
    expect_new(truth_key(scene, state, kHeight, kWidth, kSamples), "size");
    expect_new(truth_key(scene, state, kWidth, kHeight, 25), "samples");

    using ChangeScene = std::function<void(Scene&)>;
    const std::vector<ChangeScene> scene_changes{
        [](Scene& s) { s.meshes[1].vertices[2].position.z += 1e-6f; },
        [](Scene& s) { std::swap(s.meshes[1].indices[0], s.meshes[1].indices[1]); },
        [](Scene& s) { s.meshes[1].casts = false; },
        [](Scene& s) { s.meshes[0].mover.reset(); },
        [](Scene& s) { s.meshes[1].mover = 0; },
        [](Scene& s) { s.meshes.pop_back(); },
        [](Scene& s) { s.meshes[1].indices.resize(3); }};
    for (size_t i = 0; i < scene_changes.size(); ++i) {
        Scene changed = scene;
        scene_changes[i](changed);
        expect_new(truth_key(changed, state, kWidth, kHeight, kSamples), "scene change " + std::to_string(i));
    }

    using ChangeState = std::function<void(SceneState&)>;
    const std::vector<ChangeState> state_changes{[](SceneState& s) { s.camera.eye.x += 1e-9; },
                                                 [](SceneState& s) {
                                                     s.camera.basis = basis_towards({1, 45});
                                                 },
                                                 [](SceneState& s) { s.camera.vertical_fov_deg = 61; },
                                                 [](SceneState& s) { s.camera.near *= 2; },
                                                 [](SceneState& s) { s.camera.far *= 2; },
                                                 [](SceneState& s) { s.light.kind = Light::Kind::spot; },
                                                 [](SceneState& s) {
                                                     s.light.basis = basis_towards({31, 55});
                                                 },
                                                 [](SceneState& s) { s.light.position.y = 3; },
                                                 [](SceneState& s) { s.light.half_side = 0.2; },
                                                 [](SceneState& s) { s.light.distance = 2; },
                                                 [](SceneState& s) { s.light.cone_deg = 30; },
                                                 [](SceneState& s) { s.movers[0][3].x = 0.5; }};
    for (size_t i = 0; i < state_changes.size(); ++i) {
        SceneState changed = state;
        state_changes[i](changed);
        expect_new(truth_key(scene, changed, kWidth, kHeight, kSamples), "state change " + std::to_string(i));
    }
    EXPECT_EQ(keys.size(), count);
}

TEST(TruthCache, TheKeyKnowsNoColours) {
    Scene painted = made_scene();
    painted.materials[0].base_colour = {1, 0, 0};
    painted.meshes[1].vertices[0].normal = {1, 0, 0};
    painted.meshes[1].vertices[0].uv = {0.5f, 0.5f};
    painted.meshes[1].fades = true;
    EXPECT_EQ(truth_key(painted, made_state(), kWidth, kHeight, kSamples),
              truth_key(made_scene(), made_state(), kWidth, kHeight, kSamples));
}

/// Sets a variable of the environment, or unsets it, as long as the value lives.
class Environment {
  public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~Environment() { set(before_ ? before_->c_str() : nullptr); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    void set(const char* value) {
        if (value) {
            setenv(name_, value, 1);
        } else {
            unsetenv(name_);
        }
    }

    const char* name_;
    std::optional<std::string> before_;
};

TEST(TruthCache, LiesWhereXdgSays) {
    const Environment home("HOME", "/home/someone");
    {
        const Environment cache("XDG_CACHE_HOME", "/var/fast");
        EXPECT_EQ(default_cache_folder(), "/var/fast/stairstep");
    }
    for (const char* none : {static_cast<const char*>(nullptr), "", "relative/path"}) {
        const Environment cache("XDG_CACHE_HOME", none);
        EXPECT_EQ(default_cache_folder(), "/home/someone/.cache/stairstep");
    }
    const Environment cache("XDG_CACHE_HOME", nullptr);
    const Environment homeless("HOME", nullptr);
    EXPECT_THROW(default_cache_folder(), InputError);
}

}  // namespace
}  // namespace stairstep
