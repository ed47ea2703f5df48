// The commands of stairstep-study, one file each. Each adds its flags to the program and runs in a callback; what it throws
// becomes the exit code in run_program.
#pragma once

namespace CLI {
class App;
}

namespace stairstep {

void add_bench_command(CLI::App& app);
void add_design_command(CLI::App& app);
void add_simulate_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_quest_command(CLI::App& app);
void add_status_command(CLI::App& app);

}  // namespace stairstep
