#include "renderer/scene_archive.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace stairstep {
namespace {

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
    if constexpr (Archive::kReads) {
        // Each takes a byte at least.
        if (count > archive.bytes.size()) throw std::runtime_error("the archive is cut");
        values.resize(count);
    }
    if constexpr (std::is_trivially_copyable_v<typename Container::value_type>) {
        archive.raw(values.data(), count * sizeof(typename Container::value_type));
    } else {
        for (auto& value : values) walk(archive, value);
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

/// What a process wrote whose memory may have been overwritten.
void check(const Scene& scene) {
    bool good = true;
    for (const Mesh& mesh : scene.meshes) {
        const auto inside = [&](uint32_t index) { return index < mesh.vertices.size(); };
        good = good && mesh.material < scene.materials.size() && !mesh.mover && mesh.indices.size() % 3 == 0 &&
               std::ranges::all_of(mesh.indices, inside);
    }
    for (const Material& material : scene.materials) {
        good = good && (!material.texture || *material.texture < scene.textures.size());
    }
    for (const Image& image : scene.textures) {
        good = good && image.width > 0 && image.height > 0 && (image.channels == 1 || image.channels == 3) &&
               image.pixels.size() == static_cast<size_t>(image.width) * image.height * image.channels;
    }
    if (!good) throw std::runtime_error("the archive's indices lead nowhere");
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
    check(imported.scene);
    return imported;
}

}  // namespace stairstep
