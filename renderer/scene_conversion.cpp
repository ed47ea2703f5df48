#include "renderer/scene_conversion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "renderer/imported_views.h"
#include "stimuli/error.h"
#include "stimuli/stimulus.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// Squares of coordinates must stay finite in float, on the GPU as here.
constexpr float kLargestCoordinate = 1e12f;
/// A model may place one mesh many times; indices are 32 bits.
constexpr size_t kMostVertices = size_t{1} << 27;

/// Walks Assimp's tree and collects the scene.
class Collector {
  public:
    Collector(const aiScene& source, const fs::path& path) : source_(source), path_(path) {}

    ImportedScene collect() {
        for (unsigned i = 0; i < source_.mNumMaterials; ++i) add_material(*source_.mMaterials[i]);
        if (result_.scene.materials.empty()) result_.scene.materials.emplace_back();
        if (source_.mRootNode) add_node(*source_.mRootNode, aiMatrix4x4(), 0);
        if (result_.scene.meshes.empty()) reject("has no triangles", "use a model with a surface");
        const Bounds bounds = caster_bounds(result_.scene);
        if (bounds.diagonal() == 0) reject("has no extent", "use a model with a surface");
        result_.cameras = imported_cameras(source_, bounds, result_.warnings);
        result_.lights = imported_lights(source_, bounds, result_.warnings);
        return std::move(result_);
    }

  private:
    [[noreturn]] static void reject(const std::string& problem, const std::string& remedy) {
        throw SceneRejection{problem, remedy};
    }

    void add_material(const aiMaterial& source) {
        Material material;
        aiColor4D colour;
        if (source.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS ||
            source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
            const glm::vec3 base(colour.r, colour.g, colour.b);
            // NaN fails the comparison as well.
            if (glm::all(glm::greaterThanEqual(base, glm::vec3(0)))) material.base_colour = glm::min(base, 1.0f);
        }
        aiString file;
        if (source.GetTexture(aiTextureType_BASE_COLOR, 0, &file) == AI_SUCCESS ||
            source.GetTexture(aiTextureType_DIFFUSE, 0, &file) == AI_SUCCESS) {
            material.texture = texture_at(file.C_Str());
        }
        result_.scene.materials.push_back(material);
    }

    /// The texture's index; a file that can't be read costs a warning, once.
    std::optional<size_t> texture_at(const std::string& file) {
        const auto known = textures_.find(file);
        if (known != textures_.end()) return known->second;
        std::optional<size_t> index;
        try {
            const aiTexture* embedded = source_.GetEmbeddedTexture(file.c_str());
            Image image = embedded ? embedded_image(*embedded, file) : image_beside(file);
            index = result_.scene.textures.size();
            result_.scene.textures.push_back(std::move(image));
        } catch (const InputError& e) {
            result_.warnings.push_back(std::string("texture ") + e.what());
        }
        textures_[file] = index;
        return index;
    }

    Image image_beside(const std::string& file) const {
        // Models made on Windows name their files with backslashes.
        std::string portable = file;
        for (char& c : portable) c = c == '\\' ? '/' : c;
        const fs::path image_path = path_.parent_path() / portable;
        // An empty name stands for the folder, which image readers may read without end.
        if (!fs::is_regular_file(image_path)) throw InputError(image_path.string(), "isn't a file", "add it");
        return read_image(image_path);
    }

    /// An image inside the model: a whole file where the height is 0, the width being its bytes; else pixels.
    static Image embedded_image(const aiTexture& source, const std::string& name) {
        if (!source.pcData || source.mWidth == 0) throw InputError(name, "is empty", "export the model again");
        if (source.mHeight == 0) {
            return decode_image({reinterpret_cast<const uint8_t*>(source.pcData), source.mWidth}, name);
        }
        if (source.mWidth > kLargestSide || source.mHeight > kLargestSide) {
            throw InputError(name, "is larger than 16384 px", "use a smaller one");
        }
        Image image(static_cast<int>(source.mWidth), static_cast<int>(source.mHeight), 3);
        for (size_t i = 0; i < static_cast<size_t>(source.mWidth) * source.mHeight; ++i) {
            const aiTexel& texel = source.pcData[i];
            image.pixels[3 * i] = texel.r;
            image.pixels[3 * i + 1] = texel.g;
            image.pixels[3 * i + 2] = texel.b;
        }
        return image;
    }

    void add_node(const aiNode& node, const aiMatrix4x4& world_from_parent, int depth) {
        // A file may nest nodes deeper than the stack is.
        if (depth > 1000) reject("nests its nodes over 1000 deep", "flatten its hierarchy");
        const aiMatrix4x4 world_from_node = world_from_parent * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= source_.mNumMeshes) reject("refers to a mesh it doesn't have", "export it again");
            add_mesh(*source_.mMeshes[node.mMeshes[i]], world_from_node);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], world_from_node, depth + 1);
    }

    void add_mesh(const aiMesh& source, const aiMatrix4x4& world_from_mesh) {
        if (!(source.mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) return;
        vertex_count_ += source.mNumVertices;
        if (vertex_count_ > kMostVertices) reject("has over 134 million vertices", "use a smaller model");

        const aiMatrix3x3 normal_from_mesh = aiMatrix3x3(world_from_mesh).Inverse().Transpose();
        Mesh mesh;
        mesh.material = source.mMaterialIndex < source_.mNumMaterials ? source.mMaterialIndex : 0;
        mesh.vertices.reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            Vertex vertex;
            const aiVector3D position = world_from_mesh * source.mVertices[i];
            vertex.position = {position.x, position.y, position.z};
            for (int axis = 0; axis < 3; ++axis) {
                // Written so that NaN fails.
                if (!(std::abs(vertex.position[axis]) <= kLargestCoordinate)) {
                    reject("vertex " + std::to_string(i) + " of mesh \"" + source.mName.C_Str() +
                               "\" is not finite or beyond 1e12",
                           "export it again");
                }
            }
            if (source.HasNormals()) {
                const aiVector3D direction = normal_from_mesh * source.mNormals[i];
                const glm::vec3 normal(direction.x, direction.y, direction.z);
                const float length = glm::length(normal);
                // Degenerate triangles leave NaN or nothing; any direction will do for what has no area.
                if (length > 0 && std::isfinite(length)) vertex.normal = normal / length;
            }
            if (source.HasTextureCoords(0)) {
                const aiVector3D& uv = source.mTextureCoords[0][i];
                if (std::isfinite(uv.x) && std::isfinite(uv.y)) vertex.uv = {uv.x, uv.y};
            }
            mesh.vertices.push_back(vertex);
        }
        for (unsigned i = 0; i < source.mNumFaces; ++i) {
            const aiFace& face = source.mFaces[i];
            if (face.mNumIndices != 3) continue;
            for (unsigned corner = 0; corner < 3; ++corner) {
                if (face.mIndices[corner] >= source.mNumVertices) {
                    reject("refers to a vertex it doesn't have", "export it again");
                }
                mesh.indices.push_back(face.mIndices[corner]);
            }
        }
        if (!mesh.indices.empty()) result_.scene.meshes.push_back(std::move(mesh));
    }

    const aiScene& source_;
    const fs::path& path_;
    ImportedScene result_;
    std::map<std::string, std::optional<size_t>> textures_;
    size_t vertex_count_ = 0;
};

}  // namespace

ImportedScene scene_of(const aiScene& source, const fs::path& path) {
    return Collector(source, path).collect();
}

}  // namespace stairstep
