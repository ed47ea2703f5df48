// stairstep-study: runs a study and looks after its trials.
#include <CLI/CLI.hpp>

#include "stimuli/io/program.h"
#include "study/commands/commands.h"

int main(int argc, char** argv) {
    using namespace stairstep;
    CLI::App app("Runs a study of how much filtering hides shadow-map texels.", "stairstep-study");
    app.require_subcommand(1);
    add_design_command(app);
    add_simulate_command(app);
    add_check_command(app);
    add_export_command(app);
    add_status_command(app);
    add_quest_command(app);
    add_bench_command(app);
    return run_program(app, argc, argv);
}
