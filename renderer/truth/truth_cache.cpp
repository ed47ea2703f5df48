#include "renderer/truth/truth_cache.h"

#include <OpenImageIO/hash.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <type_traits>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/io/stored_image.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

/// The bytes of numbers one after another, without the padding that structures have.
class ByteRow {
  public:
    template <typename T>
    void add(T value) {
        static_assert(std::is_arithmetic_v<T>);
        const auto* bytes = reinterpret_cast<const char*>(&value);
        bytes_.append(bytes, sizeof(T));
    }
    void add(const glm::vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const glm::dvec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const Basis& basis) {
        add(basis.right);
        add(basis.up);
        add(basis.back);
    }

    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

void add(ByteRow& row, const Mesh& mesh) {
    row.add(mesh.casts);
    row.add(mesh.mover.has_value());
    row.add(static_cast<uint64_t>(mesh.mover.value_or(0)));
    row.add(static_cast<uint64_t>(mesh.vertices.size()));
    for (const Vertex& vertex : mesh.vertices) row.add(vertex.position);
    row.add(static_cast<uint64_t>(mesh.indices.size()));
    for (const uint32_t index : mesh.indices) row.add(index);
}

void add(ByteRow& row, const SceneState& state) {
    const Camera& camera = state.camera;
    row.add(camera.basis);
    row.add(camera.eye);
    row.add(camera.vertical_fov_deg);
    row.add(camera.near);
    row.add(camera.far);
    const Light& light = state.light;
    row.add(static_cast<int>(light.kind));
    row.add(light.basis);
    row.add(light.position);
    row.add(light.half_side);
    row.add(light.distance);
    row.add(light.cone_deg);
    row.add(static_cast<uint64_t>(state.movers.size()));
    for (const glm::dmat4& mover : state.movers) {
        for (int column = 0; column < 4; ++column) {
            for (int i = 0; i < 4; ++i) row.add(mover[column][i]);
        }
    }
}

/// What a file must say of itself: a key that another name was given doesn't fit.
std::string description_of(const std::string& key) {
    return "stairstep-truth/" + std::to_string(kAreaLightTruthVersion) + " " + key;
}

/// The values of a file that is there. Throws InputError if they aren't what the description says.
std::vector<float> read_truth(const fs::path& path, const std::string& description, int width, int height) {
    StoredImage image = read_stored_image(path);
    const bool is_visibility =
        std::all_of(image.values.begin(), image.values.end(), [](float value) { return value >= 0 && value <= 1; });
    if (image.width_px != width || image.height_px != height || image.bits != 32 || !is_visibility ||
        stored_description(path) != description) {
        throw InputError(path.string(), "is no ground truth for this picture", "remove it");
    }
    return std::move(image.values);
}

std::optional<std::vector<float>> truth_on_disk(const fs::path& path, const std::string& description, int width,
                                                int height) {
    std::error_code error;
    if (!fs::exists(path, error)) return std::nullopt;
    try {
        return read_truth(path, description, width, height);
    } catch (const InputError& e) {
        warn("cached ground truth", (std::string(e.what()) + "; it is made anew").c_str());
        return std::nullopt;
    }
}

void store_truth(const fs::path& path, const StoredImage& image, const std::string& description) {
    try {
        make_output_folder(path.parent_path());
        write_stored_image(path, image, description);
    } catch (const Error& e) {
        warn("ground truth", (std::string(e.what()) + "; it isn't kept").c_str());
    }
}

}  // namespace

fs::path default_cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "stairstep";
    const char* home = std::getenv("HOME");
    if (home && *home) return fs::path(home) / ".cache" / "stairstep";
    throw InputError("HOME", "isn't set, so there is no folder to keep ground truth in", "set it or XDG_CACHE_HOME");
}

std::vector<float> cached_visibility(const fs::path& path, const std::string& description, int width, int height,
                                     const std::function<std::vector<float>()>& make) {
    if (auto known = truth_on_disk(path, description, width, height)) return std::move(*known);
    StoredImage image{width, height, 32, make()};
    store_truth(path, image, description);
    return std::move(image.values);
}

std::string truth_key(const Scene& scene, const SceneState& state, int width, int height, int samples) {
    ByteRow row;
    for (const int number : {kAreaLightTruthVersion, width, height, samples}) row.add(number);
    row.add(static_cast<uint64_t>(scene.meshes.size()));
    for (const Mesh& mesh : scene.meshes) add(row, mesh);
    add(row, state);
    const auto fingerprint = OIIO::farmhash::Fingerprint128(row.bytes().data(), row.bytes().size());
    char key[33];
    std::snprintf(key, sizeof key, "%016llx%016llx",
                  static_cast<unsigned long long>(OIIO::farmhash::Uint128High64(fingerprint)),
                  static_cast<unsigned long long>(OIIO::farmhash::Uint128Low64(fingerprint)));
    return key;
}

std::vector<float> cached_area_light_visibility(const Scene& scene, const SceneState& state, int width, int height,
                                                int samples, const fs::path& folder, int jobs) {
    const std::string key = truth_key(scene, state, width, height, samples);
    return cached_visibility(folder / ("truth-" + key + ".exr"), description_of(key), width, height,
                             [&] { return area_light_visibility(scene, state, width, height, samples, jobs); });
}

}  // namespace stairstep
