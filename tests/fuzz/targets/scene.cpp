// Assimp's importers are not ours to fuzz: their crashes are why import_scene reads in a child process. What they hand over is:
// this target makes such a scene of its bytes, as broken as bytes allow but for what Assimp's data types promise (arrays as long
// as their counts), and converts it.
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "renderer/scene_archive.h"
#include "renderer/scene_conversion.h"
#include "tests/fuzz/sound_scene.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

/// Takes values off the front; zeros once there is nothing left.
class Bytes {
  public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

    unsigned byte() {
        if (bytes_.empty()) return 0;
        const auto value = static_cast<unsigned char>(bytes_.front());
        bytes_.remove_prefix(1);
        return value;
    }

    /// 0 … most.
    unsigned count(unsigned most) { return byte() % (most + 1); }

    /// Mostly a number of everyday size, or else any float at all.
    float number() {
        const unsigned first = byte();
        if (first != 255) return (static_cast<int>(first) - 100) / 16.0f;
        unsigned bits = 0;
        for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

    aiVector3D vector() {
        const float x = number(), y = number(), z = number();
        return {x, y, z};
    }

  private:
    std::string_view bytes_;
};

aiString text(const char* letters) {
    return aiString(letters);
}

/// Of nodes, cameras and lights, which are found by it.
aiString short_name(Bytes& bytes) {
    constexpr const char* kNames[] = {"", "a", "b", "c"};
    return text(kNames[bytes.count(3)]);
}

aiMatrix4x4 matrix(Bytes& bytes) {
    aiMatrix4x4 m;
    if (bytes.count(3) == 0) return m;
    for (unsigned row = 0; row < 3; ++row) {
        for (unsigned column = 0; column < 4; ++column) m[row][column] = bytes.number();
    }
    return m;
}

template <typename T, typename Make>
T** array_of(unsigned count, const Make& make) {
    if (count == 0) return nullptr;
    T** array = new T* [count] {};
    for (unsigned i = 0; i < count; ++i) array[i] = make();
    return array;
}

aiMesh* mesh(Bytes& bytes) {
    auto* made = new aiMesh;
    made->mPrimitiveTypes = bytes.count(15);
    made->mMaterialIndex = bytes.count(3);
    made->mNumVertices = bytes.count(8);
    made->mVertices = new aiVector3D[made->mNumVertices];
    const unsigned has = bytes.count(3);
    if (has & 1) made->mNormals = new aiVector3D[made->mNumVertices];
    if (has & 2) made->mTextureCoords[0] = new aiVector3D[made->mNumVertices];
    for (unsigned i = 0; i < made->mNumVertices; ++i) {
        made->mVertices[i] = bytes.vector();
        if (has & 1) made->mNormals[i] = bytes.vector();
        if (has & 2) made->mTextureCoords[0][i] = bytes.vector();
    }
    made->mNumFaces = bytes.count(8);
    made->mFaces = new aiFace[made->mNumFaces];
    for (unsigned i = 0; i < made->mNumFaces; ++i) {
        // Mostly triangles.
        const unsigned kind = bytes.count(7);
        aiFace& face = made->mFaces[i];
        face.mNumIndices = kind < 4 ? kind : 3;
        face.mIndices = new unsigned[face.mNumIndices];
        for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
            const unsigned index = bytes.byte();
            face.mIndices[corner] = index == 255 ? ~0u : index % 9;
        }
    }
    return made;
}

aiMaterial* material(Bytes& bytes) {
    auto* made = new aiMaterial;
    const unsigned has = bytes.count(7);
    const aiColor4D colour(bytes.number(), bytes.number(), bytes.number(), 1);
    if (has & 1) made->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
    if (has & 2) made->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
    if (has & 4) {
        // Textures of the model by number and by name, and files that are not there: which files lie about is no input.
        constexpr const char* kFiles[] = {"*0", "*1", "*9", "*-1", "*", "", "a", "nowhere\\b.png", "."};
        const aiString file = text(kFiles[bytes.count(8)]);
        made->AddProperty(&file, AI_MATKEY_TEXTURE(aiTextureType_DIFFUSE, 0));
    }
    return made;
}

/// Pixels, or nothing: files inside a model go to OpenImageIO's decoders, which aren't ours.
aiTexture* texture(Bytes& bytes) {
    auto* made = new aiTexture;
    made->mFilename = short_name(bytes);
    made->mWidth = bytes.count(3);
    made->mHeight = made->mWidth == 0 ? bytes.count(3) : 1 + bytes.count(2);
    const unsigned pixels = made->mWidth * made->mHeight;
    if (pixels == 0) return made;
    made->pcData = new aiTexel[pixels];
    for (unsigned i = 0; i < pixels; ++i) made->pcData[i].r = static_cast<unsigned char>(bytes.byte());
    return made;
}

aiNode* node(Bytes& bytes, unsigned mesh_count, int depth) {
    auto* made = new aiNode;
    made->mName = short_name(bytes);
    made->mTransformation = matrix(bytes);
    made->mNumMeshes = bytes.count(2);
    made->mMeshes = made->mNumMeshes > 0 ? new unsigned[made->mNumMeshes] : nullptr;
    for (unsigned i = 0; i < made->mNumMeshes; ++i) made->mMeshes[i] = bytes.count(mesh_count);
    const unsigned children = depth < 6 ? bytes.count(2) : 0;
    made->mChildren = array_of<aiNode>(children, [&] { return node(bytes, mesh_count, depth + 1); });
    made->mNumChildren = children;
    for (unsigned i = 0; i < children; ++i) made->mChildren[i]->mParent = made;
    return made;
}

/// A chain of nodes, deeper than scenes may be.
aiNode* deep_nodes(unsigned depth) {
    auto* root = new aiNode;
    for (aiNode* last = root; depth > 0; --depth) {
        auto* child = new aiNode;
        child->mParent = last;
        last->mNumChildren = 1;
        last->mChildren = new aiNode* [1] { child };
        last = child;
    }
    return root;
}

aiCamera* camera(Bytes& bytes) {
    auto* made = new aiCamera;
    made->mName = short_name(bytes);
    made->mPosition = bytes.vector();
    made->mUp = bytes.vector();
    made->mLookAt = bytes.vector();
    made->mHorizontalFOV = bytes.number();
    made->mClipPlaneNear = bytes.number();
    made->mClipPlaneFar = bytes.number();
    made->mAspect = bytes.number();
    made->mOrthographicWidth = bytes.count(3) == 0 ? bytes.number() : 0;
    return made;
}

aiLight* light(Bytes& bytes) {
    auto* made = new aiLight;
    made->mName = short_name(bytes);
    made->mType = static_cast<aiLightSourceType>(bytes.count(6));
    made->mPosition = bytes.vector();
    made->mDirection = bytes.vector();
    made->mUp = bytes.vector();
    made->mAngleInnerCone = bytes.number();
    made->mAngleOuterCone = bytes.number();
    made->mSize.x = bytes.number();
    made->mSize.y = bytes.number();
    return made;
}

std::unique_ptr<aiScene> scene(Bytes bytes) {
    auto made = std::make_unique<aiScene>();
    const unsigned flags = bytes.byte();
    made->mNumMeshes = bytes.count(3);
    made->mMeshes = array_of<aiMesh>(made->mNumMeshes, [&] { return mesh(bytes); });
    if (flags & 1) {
        made->mRootNode = flags & 2 ? deep_nodes(990 + bytes.count(20)) : node(bytes, made->mNumMeshes, 0);
    }
    made->mNumMaterials = bytes.count(2);
    made->mMaterials = array_of<aiMaterial>(made->mNumMaterials, [&] { return material(bytes); });
    made->mNumTextures = bytes.count(2);
    made->mTextures = array_of<aiTexture>(made->mNumTextures, [&] { return texture(bytes); });
    made->mNumCameras = bytes.count(2);
    made->mCameras = array_of<aiCamera>(made->mNumCameras, [&] { return camera(bytes); });
    made->mNumLights = bytes.count(2);
    made->mLights = array_of<aiLight>(made->mNumLights, [&] { return light(bytes); });
    if (flags & 4) {
        made->mMetaData = aiMetadata::Alloc(1);
        made->mMetaData->Set(0, AI_METADATA_SOURCE_FORMAT, text("glTF2 Importer"));
    }
    return made;
}

}  // namespace

void run_scene(std::string_view input) {
    const std::unique_ptr<aiScene> source = scene(Bytes(input));
    ImportedScene imported;
    try {
        imported = scene_of(*source, "/nowhere/model.gltf");
    } catch (const SceneRejection& rejection) {
        require(!rejection.problem.empty() && !rejection.remedy.empty(), "a rejection says what is wrong and would do");
        return;
    }
    require_sound(imported);
    require(caster_bounds(imported.scene).diagonal() > 0, "a scene has an extent");
    for (const Mesh& mesh : imported.scene.meshes) {
        require(!mesh.indices.empty(), "a mesh has triangles");
        for (const Vertex& vertex : mesh.vertices) {
            require(std::abs(glm::length(vertex.normal) - 1) < 1e-4, "a normal's length is 1");
        }
    }
    const std::string archive = archive_of(imported);
    require(archive_of(scene_from_archive(archive)) == archive, "a scene comes back from its archive");
}

}  // namespace stairstep::fuzz
