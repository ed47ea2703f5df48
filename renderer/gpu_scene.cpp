#include "renderer/gpu_scene.h"

#include <atomic>
#include <bit>
#include <cstddef>
#include <utility>

namespace stairstep {
namespace {

gl::Texture upload_texture(const Image& image) {
    // Four channels, whose rows need no padding.
    std::vector<uint8_t> rgba;
    rgba.reserve(image.pixels.size() / image.channels * 4);
    for (size_t i = 0; i + image.channels <= image.pixels.size(); i += image.channels) {
        for (int channel = 0; channel < 3; ++channel) {
            rgba.push_back(image.pixels[i + (image.channels == 3 ? channel : 0)]);
        }
        rgba.push_back(255);
    }
    const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
    gl::Texture texture = gl::make_texture(GL_SRGB8_ALPHA8, image.width, image.height, levels);
    gl::TextureSubImage2D(texture.id(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    gl::GenerateTextureMipmap(texture.id());
    gl::TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl::TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

void set_attribute(const gl::VertexArray& array, GLuint index, GLint components, size_t offset) {
    gl::EnableVertexArrayAttrib(array.id(), index);
    gl::VertexArrayAttribFormat(array.id(), index, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl::VertexArrayAttribBinding(array.id(), index, 0);
}

std::vector<uint32_t> indices_of(const std::vector<uint32_t>& all, const Solids& solids, bool of_solids) {
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < all.size(); ++i) {
        if (solids.has_triangle[i / 3] == of_solids) indices.push_back(all[i]);
    }
    return indices;
}

}  // namespace

glm::dmat4 world_from_model(const GpuScene::Draw& draw, const SceneState& state) {
    return state.placement(draw.mover);
}

GpuScene upload(const Scene& scene) {
    static std::atomic<uint64_t> uploads = 0;
    GpuScene gpu;
    gpu.serial = ++uploads;
    std::vector<FacetVertex> vertices;
    std::vector<uint32_t> indices;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.indices.empty()) continue;
        FacetMesh facets = facet_mesh(mesh);
        if (facets.indices.empty()) continue;
        const auto base = static_cast<uint32_t>(vertices.size());
        Solids solids = find_solids(facets);
        const std::vector<uint32_t> all = std::exchange(facets.indices, {});
        for (const bool of_solids : {true, false}) {
            facets.indices = indices_of(all, solids, of_solids);
            if (facets.indices.empty()) continue;
            std::vector<Cluster> clusters = make_clusters(facets);
            gpu.draws.push_back({indices.size(), std::move(clusters),
                                 of_solids ? std::move(solids.bounds) : std::vector<Bounds>{},
                                 scene.materials[mesh.material], mesh.casts, mesh.fades, mesh.mover});
            for (const uint32_t index : facets.indices) indices.push_back(base + index);
        }
        vertices.insert(vertices.end(), facets.vertices.begin(), facets.vertices.end());
    }
    if (indices.empty()) {
        // Buffers can't be empty; nothing is drawn from these.
        vertices.emplace_back();
        indices.push_back(0);
    }
    gpu.vertices = gl::make_buffer(std::as_bytes(std::span(vertices)));
    gpu.indices = gl::make_buffer(std::as_bytes(std::span(indices)));
    gpu.vertex_array = gl::make_vertex_array();
    gl::VertexArrayVertexBuffer(gpu.vertex_array.id(), 0, gpu.vertices.id(), 0, sizeof(FacetVertex));
    gl::VertexArrayElementBuffer(gpu.vertex_array.id(), gpu.indices.id());
    constexpr size_t vertex = offsetof(FacetVertex, vertex);
    set_attribute(gpu.vertex_array, 0, 3, vertex + offsetof(Vertex, position));
    set_attribute(gpu.vertex_array, 1, 3, vertex + offsetof(Vertex, normal));
    set_attribute(gpu.vertex_array, 2, 2, vertex + offsetof(Vertex, uv));
    set_attribute(gpu.vertex_array, 3, 3, offsetof(FacetVertex, facet));
    for (const Image& image : scene.textures) gpu.textures.push_back(upload_texture(image));
    gpu.extents = extents_of(scene);
    const Bounds casters = caster_bounds(scene);
    if (!casters.empty()) {
        gpu.middle = casters.centre();
        gpu.diagonal = casters.diagonal();
    }
    gl::throw_on_error("uploading the scene");
    return gpu;
}

}  // namespace stairstep
