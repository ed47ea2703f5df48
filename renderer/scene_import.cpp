#include "renderer/scene_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <new>

#include "renderer/child_process.h"
#include "renderer/scene_archive.h"
#include "renderer/scene_conversion.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostMemory = size_t{4} << 30;

/// Reads the model here and now. Throws SceneRejection.
ImportedScene import_unguarded(const fs::path& path) {
    try {
        Assimp::Importer importer;
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        const aiScene* source = importer.ReadFile(
            path.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType |
                               aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs);
        if (!source) {
            throw SceneRejection{std::string("can't be read as a model (") + importer.GetErrorString() + ")",
                                 "check the file, or convert it to glTF"};
        }
        return scene_of(*source, path);
    } catch (const std::bad_alloc&) {
        throw SceneRejection{"wants over 4 GiB while it is read", "check the file, or use a smaller model"};
    } catch (const std::exception& e) {
        // Assimp's importers are meant to return errors, but some throw.
        throw SceneRejection{std::string("can't be read as a model (") + e.what() + ")",
                             "check the file, or convert it to glTF"};
    }
}

/// What the child hands back starts with one of these; a rejection's two parts are kept apart by a zero.
constexpr char kScene = 's';
constexpr char kRejection = 'r';

std::string import_to_bytes(const fs::path& path) {
    try {
        return kScene + archive_of(import_unguarded(path));
    } catch (const SceneRejection& rejection) {
        return kRejection + rejection.problem + '\0' + rejection.remedy;
    }
}

/// Processor time for a file of this size: what is sound takes a hundredth of it.
int time_limit_s(uintmax_t bytes) {
    return 5 + static_cast<int>(std::min<uintmax_t>(bytes >> 20, 60) * 5);
}

}  // namespace

ImportedScene import_scene(const fs::path& path) {
    if (!fs::is_regular_file(path)) throw InputError(path.string(), "isn't a file", "name a model, as truck.gltf");
    const int cpu_s = time_limit_s(fs::file_size(path));
    const ChildOutcome outcome = run_in_child([&] { return import_to_bytes(path); }, {kMostMemory, cpu_s});
    const std::string remedy = "check the file, or convert it to glTF";
    if (outcome.end == ChildOutcome::End::out_of_time) {
        throw InputError(path.string(), "takes over " + std::to_string(cpu_s) + " s to read", remedy);
    }
    if (outcome.end == ChildOutcome::End::crashed || outcome.output.empty()) {
        throw InputError(path.string(), "is damaged so that its importer crashes", remedy);
    }
    const std::string_view rest = std::string_view(outcome.output).substr(1);
    if (outcome.output[0] == kRejection) {
        const size_t end = std::min(rest.find('\0'), rest.size());
        throw InputError(path.string(), std::string(rest.substr(0, end)),
                         std::string(rest.substr(std::min(end + 1, rest.size()))));
    }
    try {
        return scene_from_archive(rest);
    } catch (const std::exception& e) {
        throw InputError(path.string(),
                         std::string("is damaged so that its importer returns nonsense (") + e.what() + ")", remedy);
    }
}

}  // namespace stairstep
