// A folder that goes away with the value.
#pragma once

#include <filesystem>

namespace stairstep {

class TemporaryFolder {
  public:
    /// A new, empty folder under the system's temporary one. Throws FailureError.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace stairstep
