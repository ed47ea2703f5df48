#include <cmath>

#include "stimuli/io/csv.h"
#include "stimuli/io/stimulus_table.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

std::string table_of(const std::vector<Stimulus>& stimuli) {
    CsvWriter csv;
    std::vector<std::string> names;
    for (const auto& [name, value] : fields_of(Stimulus{})) names.push_back(name);
    csv.row(names);
    for (const Stimulus& stimulus : stimuli) {
        std::vector<std::string> row;
        for (const auto& [name, value] : fields_of(stimulus)) row.push_back(value);
        csv.row(row);
    }
    return csv.text();
}

}  // namespace

void run_grid(std::string_view input) {
    std::vector<Stimulus> stimuli;
    if (!accepted([&] { stimuli = read_grid(InputFile(input).path(), Stimulus{}); })) return;
    require(!stimuli.empty() && stimuli.size() <= input.size(), "there are stimuli, and no more than bytes");
    for (const Stimulus& stimulus : stimuli) {
        require_valid(stimulus);
        edge_of(stimulus);
        const std::string stem = file_stem(stimulus);
        require(stem.size() < 200 && stem.find('/') == std::string::npos, "a stimulus's name is that of a file");
    }
    const std::string written = table_of(stimuli);
    require(table_of(read_grid(InputFile(written).path(), Stimulus{})) == written,
            "a grid reads back as it was written");
}

}  // namespace stairstep::fuzz
