#include "renderer/scene_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <new>

#include "renderer/memory_limit.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostMemory = size_t{4} << 30;
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
        if (caster_bounds(result_.scene).diagonal() == 0) reject("has no extent", "use a model with a surface");
        return std::move(result_);
    }

  private:
    [[noreturn]] void reject(const std::string& problem, const std::string& remedy) const {
        throw InputError(path_.string(), problem, remedy);
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
        if (source_.GetEmbeddedTexture(file.c_str())) {
            result_.warnings.push_back("texture " + file + " lies inside the model, which isn't supported");
        } else {
            try {
                // Models made on Windows name their files with backslashes.
                std::string portable = file;
                for (char& c : portable) c = c == '\\' ? '/' : c;
                const fs::path image_path = path_.parent_path() / portable;
                // An empty name stands for the folder, which image readers may read without end.
                if (!fs::is_regular_file(image_path)) throw InputError(image_path.string(), "isn't a file", "add it");
                Image image = read_image(image_path);
                index = result_.scene.textures.size();
                result_.scene.textures.push_back(std::move(image));
            } catch (const InputError& e) {
                result_.warnings.push_back(std::string("texture ") + e.what());
            }
        }
        textures_[file] = index;
        return index;
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

ImportedScene import_scene(const fs::path& path) {
    if (!fs::is_regular_file(path)) throw InputError(path.string(), "isn't a file", "name a model, as truck.gltf");
    const MemoryLimit limit(kMostMemory);
    try {
        Assimp::Importer importer;
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        const aiScene* source = importer.ReadFile(
            path.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType |
                               aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs);
        if (!source) {
            throw InputError(path.string(), std::string("can't be read as a model (") + importer.GetErrorString() + ")",
                             "check the file, or convert it to glTF");
        }
        return Collector(*source, path).collect();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw InputError(path.string(), "wants over 4 GiB while it is read", "check the file, or use a smaller model");
    } catch (const std::exception& e) {
        // Assimp's importers are meant to return errors, but some throw.
        throw InputError(path.string(), std::string("can't be read as a model (") + e.what() + ")",
                         "check the file, or convert it to glTF");
    }
}

}  // namespace stairstep
