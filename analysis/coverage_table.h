// The factorial's figures as files: coverage.csv, and the document that is made of it.
//
// coverage.csv has a row a cell and method: `between_observer_sd, lapse, beta, observers, texels_px, method, studies, coverage,
// coverage_se, bias_ln, bias_se, sd_ln, width_ln, verdict, failed, unbounded, warned, replicates, seed`. Sizes are separated by
// spaces. `verdict` is `yes` where coverage lies in .93 to .97, `near` where it lies outside by two standard errors at most, and
// else `no`. Numbers are written in full, so that a file that was read and written again has the same bytes.
#pragma once

#include <string>
#include <vector>

#include "analysis/coverage_factorial.h"
#include "stimuli/io/csv.h"

namespace stairstep {

/// "yes", "near" or "no", as above.
std::string coverage_verdict(const MethodCoverage& coverage);

/// Populations that are measured, and the text of their rows, kept as it was read or made.
class CoverageTable {
  public:
    /// None.
    CoverageTable() = default;
    /// What an earlier run wrote, for going on. Throws InputError, naming file and line, for what no run writes, and for rows of
    /// other studies, replicates or seed than `settings` has.
    static CoverageTable read(const CsvTable& csv, const FactorialSettings& settings);

    bool holds(const FactorialPopulation& population) const;
    /// All cells of one population.
    void add(const std::vector<FactorialCell>& cells, const FactorialSettings& settings);

    /// The whole file: populations in the factorial's order, however they came.
    std::string csv() const;

  private:
    struct Part {
        FactorialPopulation population;
        std::string rows;
    };
    std::vector<Part> parts_;
};

/// docs/coverage.md from coverage.csv: coverage and bias of the default method in every cell, all methods beside each other, and
/// what failed. `command` is what made the file.
std::string coverage_document(const CsvTable& csv, const std::string& command);

}  // namespace stairstep
