#include "stimuli/io/stimulus_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// One field of a table, with the place for errors.
struct Cell {
    const CsvTable& table;
    size_t row;
    size_t column;

    const std::string& text() const { return table.text(row, column); }
    double number() const { return table.number(row, column); }

    int whole(int least, int most) const {
        const double value = number();
        if (value < least || value > most || value != std::floor(value)) {
            table.reject(row, column, "\"" + text() + "\" is out of range",
                         "write a whole number from " + std::to_string(least) + " to " + std::to_string(most));
        }
        return static_cast<int>(value);
    }

    /// The one of `choices` that is called so.
    template <typename T>
    T choice(std::initializer_list<T> choices) const {
        std::string names;
        for (const T value : choices) {
            if (name(value) == text()) return value;
            names += (names.empty() ? "" : ", ") + std::string(name(value));
        }
        table.reject(row, column, "\"" + text() + "\" is unknown", "write one of " + names);
    }
};

struct Column {
    const char* name;
    bool required;
    std::string (*text)(const Stimulus&);
    void (*read)(Stimulus&, const Cell&);
};

const Column kColumns[] = {
    {"pattern", true, [](const Stimulus& s) { return std::string(name(s.pattern)); },
     [](Stimulus& s, const Cell& cell) {
         s.pattern = cell.choice({Pattern::step, Pattern::stair, Pattern::slope, Pattern::line});
         s.silhouette = s.pattern;
     }},
    {"kernel", true, [](const Stimulus& s) { return std::string(name(s.kernel.shape)); },
     [](Stimulus& s, const Cell& cell) {
         s.kernel.shape =
             cell.choice({KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson});
     }},
    {"contrast", true, [](const Stimulus& s) { return format_number(s.contrast); },
     [](Stimulus& s, const Cell& cell) { s.contrast = cell.number(); }},
    {"texel_px", true, [](const Stimulus& s) { return format_number(s.texel_px); },
     [](Stimulus& s, const Cell& cell) { s.texel_px = cell.number(); }},
    {"radius_px", true, [](const Stimulus& s) { return format_number(s.kernel.radius_px); },
     [](Stimulus& s, const Cell& cell) { s.kernel.radius_px = cell.number(); }},
    {"width_px", false, [](const Stimulus& s) { return std::to_string(s.width_px); },
     [](Stimulus& s, const Cell& cell) { s.width_px = cell.whole(1, kLargestSide); }},
    {"height_px", false, [](const Stimulus& s) { return std::to_string(s.height_px); },
     [](Stimulus& s, const Cell& cell) { s.height_px = cell.whole(1, kLargestSide); }},
    {"silhouette", false, [](const Stimulus& s) { return std::string(name(s.silhouette)); },
     [](Stimulus& s, const Cell& cell) {
         s.silhouette = cell.choice({Pattern::step, Pattern::stair, Pattern::slope});
         if (s.pattern != Pattern::line && s.silhouette != s.pattern) {
             cell.table.reject(cell.row, cell.column, "an artifact is its own silhouette",
                               "write " + std::string(name(s.pattern)));
         }
     }},
    {"step_reference", false, [](const Stimulus& s) { return std::string(name(s.step_reference)); },
     [](Stimulus& s, const Cell& cell) {
         s.step_reference = cell.choice({StepReference::sloped, StepReference::horizontal});
     }},
    {"slope", false, [](const Stimulus& s) { return format_number(s.slope); },
     [](Stimulus& s, const Cell& cell) { s.slope = cell.number(); }},
    {"phase_x", false, [](const Stimulus& s) { return format_number(s.phase.x); },
     [](Stimulus& s, const Cell& cell) { s.phase.x = cell.number(); }},
    {"phase_y", false, [](const Stimulus& s) { return format_number(s.phase.y); },
     [](Stimulus& s, const Cell& cell) { s.phase.y = cell.number(); }},
    {"taps", false, [](const Stimulus& s) { return std::to_string(s.kernel.taps); },
     [](Stimulus& s, const Cell& cell) { s.kernel.taps = cell.whole(1, kMostTaps); }},
    {"rotated", false, [](const Stimulus& s) { return std::string(s.kernel.rotated ? "1" : "0"); },
     [](Stimulus& s, const Cell& cell) { s.kernel.rotated = cell.whole(0, 1) != 0; }},
    {"seed", false, [](const Stimulus& s) { return std::to_string(s.kernel.seed); },
     [](Stimulus& s, const Cell& cell) { s.kernel.seed = static_cast<uint64_t>(cell.whole(0, 2'000'000'000)); }},
};

void require_known_columns(const CsvTable& table, const std::filesystem::path& path) {
    for (const std::string& header : table.header()) {
        if (std::any_of(std::begin(kColumns), std::end(kColumns),
                        [&](auto& column) { return column.name == header; })) {
            continue;
        }
        std::string names;
        for (const Column& column : kColumns) names += (names.empty() ? "" : ", ") + std::string(column.name);
        throw InputError(path.string(), "has an unknown column \"" + header + "\"", "known are " + names);
    }
}

}  // namespace

std::vector<Field> fields_of(const Stimulus& stimulus) {
    std::vector<Field> fields;
    for (const Column& column : kColumns) fields.emplace_back(column.name, column.text(stimulus));
    return fields;
}

Stimulus stimulus_at(const CsvTable& table, size_t row, const Stimulus& defaults) {
    Stimulus stimulus = defaults;
    for (const Column& column : kColumns) {
        const auto found = column.required ? table.column(column.name) : table.find_column(column.name);
        if (found) column.read(stimulus, {table, row, *found});
    }
    try {
        require_valid(stimulus);
    } catch (const InputError& error) {
        throw InputError(table.place(row), error.what(), "mend that row");
    }
    return stimulus;
}

std::vector<Stimulus> read_grid(const std::filesystem::path& path, const Stimulus& defaults) {
    const CsvTable table = CsvTable::read(path);
    require_known_columns(table, path);
    if (table.row_count() == 0) throw InputError(path.string(), "lists no stimulus", "add a row for each");
    std::vector<Stimulus> stimuli;
    stimuli.reserve(table.row_count());
    for (size_t row = 0; row < table.row_count(); ++row) stimuli.push_back(stimulus_at(table, row, defaults));
    return stimuli;
}

}  // namespace stairstep
