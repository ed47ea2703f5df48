// How every program ends: exit code 0 done · 1 it could not · 2 wrong usage or bad input, and one line on stderr.
#pragma once

namespace CLI {
class App;
}

namespace stairstep {

/// Parses the command line, which runs the app's or its subcommands' callbacks, and turns what they throw into
/// the exit code and `error: <what was read>: <what is wrong>: <what would do>`.
int run_program(CLI::App& app, int argc, char** argv);

/// Prints a note for the user on stderr: `warning: …`.
void warn(const char* subject, const char* message);

}  // namespace stairstep
