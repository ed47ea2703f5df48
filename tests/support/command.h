// Runs a program as a user would and keeps what it printed.
#pragma once

#include <string>

namespace stairstep {

struct CommandResult {
    int exit_code = 0;
    std::string output;
    std::string errors;
};

/// Runs a shell command line. A program killed by a signal has the exit code 128 + signal.
CommandResult run_command(const std::string& command_line);

/// The full path of one of our programs.
std::string program(const std::string& name);

/// Whether the errors are one line `error: subject: problem: remedy`.
bool is_one_error_line(const std::string& errors);

}  // namespace stairstep
