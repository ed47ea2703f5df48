#include <sys/mman.h>
#include <unistd.h>

#include "tests/fuzz/target.h"

namespace stairstep::fuzz {

InputFile::InputFile(std::string_view bytes) : file_(memfd_create("input", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
        throw std::runtime_error("no file in memory");
    }
    path_ = "/proc/self/fd/" + std::to_string(file_);
}

InputFile::~InputFile() {
    close(file_);
}

}  // namespace stairstep::fuzz
