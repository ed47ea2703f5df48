#include "tests/support/command.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {

CommandResult run_command(const std::string& command_line) {
    const TemporaryFolder folder;
    const std::string output = (folder.path() / "output").string();
    const std::string errors = (folder.path() / "errors").string();
    const int status = std::system(("{ " + command_line + " ; } >" + output + " 2>" + errors + " </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(output), read_file(errors)};
}

std::string program(const std::string& name) {
    return std::string(STAIRSTEP_BIN_DIR) + "/" + name;
}

bool is_one_error_line(const std::string& errors) {
    return errors.starts_with("error: ") && errors.ends_with("\n") &&
           std::count(errors.begin(), errors.end(), '\n') == 1 && std::count(errors.begin(), errors.end(), ':') >= 3;
}

}  // namespace stairstep
