#include "stimuli/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "stimuli/error.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

constexpr uintmax_t kLargestFile = uintmax_t{1} << 30;
constexpr const char* kPartialMark = ".partial-";

/// A new, empty file that nobody but its owner can open.
void create_for_owner(const fs::path& path, const fs::path& final_path) {
    unlink(path.c_str());  // of a process with the same number that was killed
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL, S_IRUSR | S_IWUSR);
    if (file < 0) throw FailureError(final_path.string(), std::strerror(errno), "check the folder and the disk");
    close(file);
}

/// As fs::create_directories, each new one for its owner alone.
void create_folders_for_owner(const fs::path& folder, std::error_code& error) {
    if (folder.empty() || fs::is_directory(folder, error)) {
        error.clear();
        return;
    }
    create_folders_for_owner(folder.parent_path(), error);
    if (error) return;
    // "a/b/" ends in an empty name, and "a/b" was made a moment ago.
    const int problem = mkdir(folder.c_str(), S_IRWXU) == 0 ? 0 : errno;
    const bool is_there = fs::is_directory(folder, error);
    error.clear();
    if (!is_there) error.assign(problem, std::generic_category());
}

}  // namespace

OutputFile::OutputFile(fs::path final_path, Access access) : final_path_(std::move(final_path)) {
    fs::path folder = final_path_.parent_path();
    if (folder.empty()) folder = ".";
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        throw FailureError(final_path_.string(), "its folder doesn't exist", "create " + folder.string());
    }
    if (fs::is_directory(final_path_, error)) {
        throw FailureError(final_path_.string(), "is a folder", "name a file");
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        throw FailureError(final_path_.string(), "its folder can't be written",
                           "choose another or change its permissions");
    }
    partial_path_ = folder / ("." + final_path_.stem().string() + kPartialMark + std::to_string(getpid()) +
                              final_path_.extension().string());
    if (access == Access::owner_only) create_for_owner(partial_path_, final_path_);
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!committed_) fs::remove(partial_path_, ignored);
}

void OutputFile::commit() {
    const int file = open(partial_path_.c_str(), O_RDONLY);
    const bool synced = file >= 0 && fsync(file) == 0;
    const int sync_error = errno;
    if (file >= 0) close(file);
    if (!synced) throw FailureError(final_path_.string(), std::strerror(sync_error), "check the disk");
    std::error_code error;
    fs::rename(partial_path_, final_path_, error);
    if (error) throw FailureError(final_path_.string(), error.message(), "check the folder's permissions");
    committed_ = true;
}

std::optional<std::string> partial_file_stem(const std::string& file_name) {
    const size_t mark = file_name.rfind(kPartialMark);
    if (!file_name.starts_with('.') || mark == std::string::npos || mark == 0) return std::nullopt;
    return file_name.substr(1, mark - 1);
}

void write_file(const fs::path& path, std::string_view text, Access access) {
    OutputFile output(path, access);
    {
        std::ofstream file(output.path(), std::ios::binary);
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
        file.flush();
        if (!file) throw FailureError(path.string(), "can't be written", "check the disk's free space");
    }
    output.commit();
}

void make_output_folder(const fs::path& folder, Access access) {
    std::error_code error;
    if (access == Access::owner_only) {
        create_folders_for_owner(folder, error);
    } else {
        fs::create_directories(folder, error);
    }
    if (error || !fs::is_directory(folder)) {
        const std::string reason = error ? error.message() : "is not a folder";
        throw FailureError(folder.string(), "can't create this output folder: " + reason, "choose another --out");
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        throw FailureError(folder.string(), "this output folder can't be written", "choose another --out");
    }
}

std::string read_file(const fs::path& path) {
    std::error_code error;
    const auto status = fs::status(path, error);
    if (!fs::exists(status)) throw InputError(path.string(), "doesn't exist", "check the path");
    if (fs::is_directory(status)) throw InputError(path.string(), "is a folder", "name a file");
    const uintmax_t size = fs::is_regular_file(status) ? fs::file_size(path, error) : 0;
    if (size > kLargestFile) throw InputError(path.string(), "is larger than 1 GiB", "split it");
    std::ifstream file(path, std::ios::binary);
    std::string text(size, '\0');
    if (size > 0) {
        file.read(text.data(), static_cast<std::streamsize>(size));
        text.resize(static_cast<size_t>(file.gcount()));
    } else {
        text.assign(std::istreambuf_iterator<char>(file), {});
    }
    if (!file.good() && !file.eof()) {
        throw InputError(path.string(), "can't be read", "check its permissions");
    }
    return text;
}

}  // namespace stairstep
