// Who may include whom. The table is the design; a file that includes anything else fails here.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "stimuli/io/output_file.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// Module of a file, the longest matching folder first, and what it may include besides itself.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"stimuli", {}},
    {"stimuli/io", {"stimuli"}},
    {"analysis/law", {"stimuli", "stimuli/io"}},
    {"renderer/gl", {"stimuli", "stimuli/io"}},
    {"renderer", {"stimuli", "stimuli/io", "analysis/law", "renderer/gl"}},
    {"study", {"stimuli", "stimuli/io"}},
    {"study/display", {"stimuli", "stimuli/io", "study", "renderer/gl"}},
    {"analysis", {"stimuli", "stimuli/io", "study", "analysis/law"}},
};

std::string module_of(const std::string& path) {
    std::string best;
    for (const auto& [module, allowed] : kMayInclude) {
        if (path.starts_with(module + "/") && module.size() > best.size()) best = module;
    }
    return best;
}

struct Include {
    std::string file;
    std::string included;
};

std::vector<Include> includes_of(const fs::path& root) {
    std::vector<Include> includes;
    const std::regex pattern(R"(^\s*#\s*include\s*"([^"]+)\")");
    for (const char* folder : {"stimuli", "study", "analysis", "renderer"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            std::istringstream text(read_file(entry.path()));
            for (std::string line; std::getline(text, line);) {
                std::smatch match;
                if (std::regex_search(line, match, pattern)) {
                    includes.push_back({fs::relative(entry.path(), root).string(), match[1]});
                }
            }
        }
    }
    return includes;
}

bool is_allowed(const Include& include) {
    if (include.file.ends_with("_main.cpp")) return true;        // where parts are put together
    if (include.included.starts_with("embedded/")) return true;  // generated from files of the module itself
    const std::string from = module_of(include.file);
    const std::string to = module_of(include.included);
    return from == to || kMayInclude.at(from).contains(to);
}

TEST(Includes, FollowTheTable) {
    const std::vector<Include> includes = includes_of(STAIRSTEP_SOURCE_DIR);
    ASSERT_GT(includes.size(), 100u);
    for (const Include& include : includes) {
        EXPECT_NE(module_of(include.included) + (include.included.starts_with("embedded/") ? "e" : ""), "")
            << include.file << " includes \"" << include.included << "\": write paths from the repository's root";
        EXPECT_TRUE(is_allowed(include)) << include.file << " may not include " << include.included;
    }
}

TEST(Includes, TheTableForbids) {
    EXPECT_FALSE(is_allowed({"stimuli/edge.h", "stimuli/io/csv.h"}));
    EXPECT_FALSE(is_allowed({"stimuli/edge.h", "study/engines/quest.h"}));
    EXPECT_FALSE(is_allowed({"analysis/law/law.h", "analysis/law_fit.h"}));
    EXPECT_FALSE(is_allowed({"renderer/frame.cpp", "analysis/law_fit.h"}));
    EXPECT_FALSE(is_allowed({"renderer/frame.cpp", "study/engines/quest.h"}));
    EXPECT_FALSE(is_allowed({"study/session.cpp", "renderer/gl/context.h"}));
    EXPECT_TRUE(is_allowed({"study/display/window.cpp", "renderer/gl/context.h"}));
    EXPECT_TRUE(is_allowed({"analysis/law_fit.cpp", "analysis/law/law.h"}));
}

TEST(Includes, CoreOfStimuliNeedsNoLibrary) {
    // No GL, no file I/O: nothing but the standard library, and of that no streams to files.
    for (const auto& entry : fs::directory_iterator(fs::path(STAIRSTEP_SOURCE_DIR) / "stimuli")) {
        if (!entry.is_regular_file() || entry.path().filename() == "stimuli_main.cpp" ||
            entry.path().filename() == "CMakeLists.txt") {
            continue;
        }
        const std::string text = read_file(entry.path());
        for (const char* header :
             {"<fstream>", "<filesystem>", "<cstdio>", "<GL/", "<OpenImageIO/", "<nlohmann/", "<CLI/"}) {
            EXPECT_EQ(text.find(std::string("#include ") + header), std::string::npos) << entry.path() << header;
        }
    }
}

TEST(Includes, OneFileEachSeesAContextsLibrary) {
    // They can drag in GL/gl.h, which clashes with glcorearb.h.
    for (const char* header : {"<GL/osmesa.h>", "<EGL/egl.h>", "<GLFW/glfw3.h>"}) {
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(STAIRSTEP_SOURCE_DIR) / "renderer")) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            files += read_file(entry.path()).find(std::string("#include ") + header) != std::string::npos;
        }
        EXPECT_EQ(files, 1) << header;
    }
}

}  // namespace
}  // namespace stairstep
