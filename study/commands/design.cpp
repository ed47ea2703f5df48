#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "study/commands/commands.h"
#include "study/design_json.h"

namespace stairstep {

void add_design_command(CLI::App& app) {
    auto* command = app.add_subcommand("design", "Print a design with all its settings, as JSON to edit.");
    const auto file = std::make_shared<std::string>();
    command->add_option("file", *file, "the design to complete and check; without one, the thesis's");
    command->callback([file] {
        const Design design = file->empty() ? Design{} : read_design(*file);
        std::cout << to_json(design).dump(2) << "\n";
    });
}

}  // namespace stairstep
