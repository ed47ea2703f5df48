// tests/study/engines/psychtoolbox_reference.csv: sequences of trials and what Psychtoolbox says after them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stimuli/io/csv.h"
#include "study/engines/psychtoolbox_quest.h"

namespace stairstep {

struct QuestTrial {
    double intensity = 0;
    bool correct = false;
};

struct PsychtoolboxReference {
    PsychtoolboxQuestSettings settings;
    std::vector<QuestTrial> trials;
    double mean, mode, quantile, sd, low, high, quantile_order, x_threshold;
};

/// The sequence that psychtoolbox_reference.m describes, by the same arithmetic.
inline std::vector<QuestTrial> reference_trials(double guess, double seed, double count, double spread, double above,
                                                double below) {
    constexpr double m = 2147483647;
    uint64_t s = static_cast<uint64_t>(seed);
    const auto next = [&s] {
        s = 16807 * s % 2147483647;
        return static_cast<double>(s) / m;
    };
    std::vector<QuestTrial> trials;
    for (int i = 0; i < count; ++i) {
        const double a = next();
        const double b = next();
        const double c = next();
        double distance = spread * (a - .5);
        if (b < .05) distance = 100 * distance;
        const double intensity = guess + distance;
        trials.push_back({intensity, c < (intensity > guess ? above : below)});
    }
    return trials;
}

inline std::vector<PsychtoolboxReference> psychtoolbox_references() {
    const CsvTable table =
        CsvTable::read(std::string(STAIRSTEP_SOURCE_DIR) + "/tests/study/engines/psychtoolbox_reference.csv");
    std::vector<PsychtoolboxReference> references;
    for (size_t row = 0; row < table.row_count(); ++row) {
        const auto get = [&](const char* column) { return table.number(row, table.column(column)); };
        PsychtoolboxReference r;
        r.settings.guess = get("guess");
        r.settings.guess_sd = get("guess_sd");
        r.settings.shape = {get("beta"), get("gamma"), get("delta"), get("p_threshold")};
        r.settings.grain = get("grain");
        if (get("range") > 0) r.settings.range = get("range");
        r.trials =
            reference_trials(get("guess"), get("seed"), get("trials"), get("spread"), get("above"), get("below"));
        r.mean = get("mean");
        r.mode = get("mode");
        r.quantile = get("quantile");
        r.sd = get("sd");
        r.low = get("low");
        r.high = get("high");
        r.quantile_order = get("quantile_order");
        r.x_threshold = get("x_threshold");
        references.push_back(r);
    }
    return references;
}

}  // namespace stairstep
