// The commands of stairstep-analyze that simulate studies, one file each. Each adds its flags to the program and runs in a
// callback; what it throws becomes the exit code in run_program.
#pragma once

namespace CLI {
class App;
}

namespace stairstep {

void add_coverage_command(CLI::App& app);
void add_power_command(CLI::App& app);

}  // namespace stairstep
