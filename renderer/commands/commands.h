// The commands of stairstep-render that fill a file of their own. Each adds its flags to the program and runs in a callback; what
// it throws becomes the exit code in run_program.
#pragma once

namespace CLI {
class App;
}

namespace stairstep {

void add_bench_command(CLI::App& app);
void add_scaling_command(CLI::App& app);
void add_stress_command(CLI::App& app);

}  // namespace stairstep
