#include "renderer/scene_archive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace stairstep {
namespace {

/// What scene_import.h promises of vertices.
constexpr float kLargestCoordinate = 1e12f;
constexpr float kLargest = 1e15f;

class Writer {
  public:
    static constexpr bool kReads = false;
    std::string bytes;

    void raw(const void* from, size_t count) { bytes.append(static_cast<const char*>(from), count); }
};

class Reader {
  public:
    static constexpr bool kReads = true;
    std::string_view bytes;

    void raw(void* to, size_t count) {
        if (count > bytes.size()) throw std::runtime_error("the archive is cut");
        if (count > 0) std::memcpy(to, bytes.data(), count);
        bytes.remove_prefix(count);
    }
};

// One walk through the scene serves both directions, so that they can't disagree.

template <typename Archive, typename T>
requires std::is_trivially_copyable_v<T>
void walk(Archive& archive, T& value) {
    archive.raw(&value, sizeof value);
}

/// Not every byte is a bool, and to read another as one is undefined.
template <typename Archive>
void walk(Archive& archive, bool& value) {
    uint8_t byte = value;
    walk(archive, byte);
    if (byte > 1) throw std::runtime_error("the archive has a flag that is none");
    if constexpr (Archive::kReads) value = byte == 1;
}

template <typename Archive>
void walk(Archive& archive, std::optional<size_t>& index) {
    bool is_there = index.has_value();
    walk(archive, is_there);
    if constexpr (Archive::kReads) index = is_there ? std::optional<size_t>(0) : std::nullopt;
    if (index) walk(archive, *index);
}

template <typename Archive>
void walk(Archive& archive, Material& material) {
    walk(archive, material.base_colour);
    walk(archive, material.texture);
}

template <typename Archive>
void walk(Archive& archive, Light& light) {
    bool is_spot = light.kind == Light::Kind::spot;
    walk(archive, is_spot);
    if constexpr (Archive::kReads) light.kind = is_spot ? Light::Kind::spot : Light::Kind::directional;
    walk(archive, light.basis);
    walk(archive, light.position);
    walk(archive, light.half_side);
    walk(archive, light.distance);
    walk(archive, light.cone_deg);
}

template <typename Archive>
void walk(Archive& archive, Image& image);
template <typename Archive>
void walk(Archive& archive, Mesh& mesh);

/// std::vector and std::string.
template <typename Archive, typename Container>
requires(!std::is_trivially_copyable_v<Container>) && requires(Container c) {
    c.resize(1);
}
void walk(Archive& archive, Container& values) {
    size_t count = values.size();
    walk(archive, count);
    using Value = typename Container::value_type;
    if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Vertex>) {
        if constexpr (Archive::kReads) {
            if (count > archive.bytes.size() / sizeof(Value)) throw std::runtime_error("the archive is cut");
            values.resize(count);
        }
        archive.raw(values.data(), count * sizeof(Value));
    } else {
        // Made one by one, so that no more are made than there are bytes for, whatever the count claims.
        for (size_t i = 0; i < count; ++i) {
            if constexpr (Archive::kReads) values.emplace_back();
            walk(archive, values[i]);
        }
    }
}

template <typename Archive>
void walk(Archive& archive, Image& image) {
    walk(archive, image.width);
    walk(archive, image.height);
    walk(archive, image.channels);
    walk(archive, image.pixels);
}

template <typename Archive>
void walk(Archive& archive, Mesh& mesh) {
    walk(archive, mesh.vertices);
    walk(archive, mesh.indices);
    walk(archive, mesh.material);
    walk(archive, mesh.casts);
    walk(archive, mesh.mover);
    walk(archive, mesh.fades);
}

template <typename Archive>
void walk_all(Archive& archive, ImportedScene& imported) {
    walk(archive, imported.scene.meshes);
    walk(archive, imported.scene.materials);
    walk(archive, imported.scene.textures);
    walk(archive, imported.cameras);
    walk(archive, imported.lights);
    walk(archive, imported.warnings);
}

/// Within the range of coordinates, with room for what is computed from them; false for NaN.
template <typename Vector>
bool usable(const Vector& v) {
    return glm::all(glm::lessThanEqual(glm::abs(v), Vector(kLargest)));
}

bool usable(const Basis& basis) {
    return usable(basis.right) && usable(basis.up) && usable(basis.back);
}

bool usable(const Vertex& vertex) {
    const bool uv_is_finite = std::isfinite(vertex.uv.x) && std::isfinite(vertex.uv.y);
    return glm::all(glm::lessThanEqual(glm::abs(vertex.position), glm::vec3(kLargestCoordinate))) &&
           usable(vertex.normal) && uv_is_finite;
}

bool usable(const Camera& camera) {
    return usable(camera.basis) && usable(camera.eye) && camera.vertical_fov_deg > 0 && camera.vertical_fov_deg < 180 &&
           camera.near > 0 && camera.near < camera.far && camera.far <= kLargest;
}

bool usable(const Light& light) {
    return usable(light.basis) && usable(light.position) && light.half_side >= 0 && light.half_side <= kLargest &&
           light.distance > 0 && light.distance <= kLargest && light.cone_deg > 0 && light.cone_deg <= 85;
}

bool usable(const Mesh& mesh, const Scene& scene) {
    const auto inside = [&](uint32_t index) { return index < mesh.vertices.size(); };
    return mesh.material < scene.materials.size() && !mesh.mover && mesh.indices.size() % 3 == 0 &&
           std::ranges::all_of(mesh.indices, inside) &&
           std::ranges::all_of(mesh.vertices, [](const Vertex& v) { return usable(v); });
}

bool usable(const Image& image) {
    return image.width > 0 && image.height > 0 && (image.channels == 1 || image.channels == 3) &&
           image.pixels.size() == static_cast<size_t>(image.width) * image.height * image.channels;
}

/// What a process wrote whose memory may have been overwritten.
void check(const ImportedScene& imported) {
    const Scene& scene = imported.scene;
    bool good = true;
    for (const Mesh& mesh : scene.meshes) good = good && usable(mesh, scene);
    for (const Material& material : scene.materials) {
        good = good && usable(material.base_colour) && (!material.texture || *material.texture < scene.textures.size());
    }
    for (const Image& image : scene.textures) good = good && usable(image);
    for (const Camera& camera : imported.cameras) good = good && usable(camera);
    for (const Light& light : imported.lights) good = good && usable(light);
    if (!good) throw std::runtime_error("the archive has indices that lead nowhere, or numbers that are none");
}

}  // namespace

std::string archive_of(const ImportedScene& imported) {
    Writer writer;
    // The walk changes nothing when it writes.
    walk_all(writer, const_cast<ImportedScene&>(imported));
    return std::move(writer.bytes);
}

ImportedScene scene_from_archive(std::string_view bytes) {
    Reader reader{bytes};
    ImportedScene imported;
    walk_all(reader, imported);
    if (!reader.bytes.empty()) throw std::runtime_error("the archive has an end too many");
    check(imported);
    return imported;
}

}  // namespace stairstep
