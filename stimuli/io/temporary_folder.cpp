#include "stimuli/io/temporary_folder.h"

#include <cstdlib>
#include <string>

#include "stimuli/error.h"

namespace stairstep {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "stairstep-XXXXXX").string();
    if (error || !mkdtemp(pattern.data())) throw FailureError(pattern, "can't be created", "check TMPDIR");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace stairstep
