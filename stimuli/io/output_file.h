// Output that is there whole or not at all: written beside its final name, then renamed onto it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stairstep {

/// Who may read what is written: whoever the process's umask lets, or its owner alone (files 0600, created folders 0700),
/// from the moment it exists.
enum class Access { as_umask, owner_only };

/// A file in the making. Write to `path()`, then `commit()`; without it the destructor removes what was written.
class OutputFile {
  public:
    /// Throws FailureError where the folder doesn't exist or can't be written. With `owner_only`, `path()` is there already,
    /// empty: who writes to it must open it, not put another file in its place.
    explicit OutputFile(std::filesystem::path final_path, Access access = Access::as_umask);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// The name to write to; it keeps the final name's extension, by which image writers choose their format.
    const std::filesystem::path& path() const { return partial_path_; }

    /// Syncs the content to disk and renames it onto the final name. Throws FailureError.
    void commit();

  private:
    std::filesystem::path final_path_;
    std::filesystem::path partial_path_;
    bool committed_ = false;
};

/// Whose partial file a file name is: the stem of the final name, as a process leaves it that was killed before it
/// could commit. nullopt for any other name.
std::optional<std::string> partial_file_stem(const std::string& file_name);

/// Writes text as a whole file. Throws FailureError.
void write_file(const std::filesystem::path& path, std::string_view text, Access access = Access::as_umask);

/// Creates a folder and its parents and checks that it can be written to. Those that are there already keep their
/// permissions. Throws FailureError.
void make_output_folder(const std::filesystem::path& folder, Access access = Access::as_umask);

/// The whole of a file. Throws InputError if it is missing, unreadable or larger than 1 GiB.
std::string read_file(const std::filesystem::path& path);

}  // namespace stairstep
