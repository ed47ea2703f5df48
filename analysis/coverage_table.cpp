#include "analysis/coverage_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/law_fit.h"
#include "stimuli/error.h"
#include "stimuli/number.h"
#include "study/bench/bench_table.h"

namespace stairstep {
namespace {

const std::vector<std::string> kColumns{"between_observer_sd",
                                        "lapse",
                                        "beta",
                                        "observers",
                                        "texels_px",
                                        "method",
                                        "studies",
                                        "coverage",
                                        "coverage_se",
                                        "bias_ln",
                                        "bias_se",
                                        "sd_ln",
                                        "width_ln",
                                        "verdict",
                                        "failed",
                                        "unbounded",
                                        "warned",
                                        "replicates",
                                        "seed"};

std::string sizes_text(const std::vector<double>& texels_px) {
    std::string text;
    for (const double a : texels_px) text += (text.empty() ? "" : " ") + format_number(a);
    return text;
}

std::string rows_of(const std::vector<FactorialCell>& cells, const FactorialSettings& settings) {
    CsvWriter csv;
    for (const FactorialCell& cell : cells) {
        for (const MethodCoverage& m : cell.methods) {
            csv.row({format_number(cell.population.between_observer_sd), format_number(cell.population.lapse),
                     format_number(cell.population.beta), std::to_string(cell.observers), sizes_text(cell.texels_px),
                     m.method, std::to_string(m.studies), format_number(m.coverage), format_number(m.coverage_se),
                     format_number(m.bias), format_number(m.bias_se), format_number(m.sd), format_number(m.width),
                     coverage_verdict(m), std::to_string(cell.failed), format_number(cell.unbounded),
                     format_number(cell.warned), std::to_string(settings.replicates), std::to_string(settings.seed)});
        }
    }
    return csv.text();
}

std::string header_line() {
    CsvWriter csv;
    csv.row(kColumns);
    return csv.text();
}

/// One row of the file.
struct Row {
    FactorialPopulation population;
    int observers;
    std::string sizes;
    std::string method;
    int studies;
    double coverage, coverage_se, bias, bias_se, sd, width, unbounded, warned;
    std::string verdict;
};

std::vector<Row> rows_in(const CsvTable& csv) {
    std::vector<Row> rows;
    for (size_t i = 0; i < csv.row_count(); ++i) {
        const auto number = [&](const char* column) { return csv.number(i, csv.column(column)); };
        const auto text = [&](const char* column) { return csv.text(i, csv.column(column)); };
        rows.push_back({{number("between_observer_sd"), number("lapse"), number("beta")},
                        static_cast<int>(number("observers")),
                        text("texels_px"),
                        text("method"),
                        static_cast<int>(number("studies")),
                        number("coverage"),
                        number("coverage_se"),
                        number("bias_ln"),
                        number("bias_se"),
                        number("sd_ln"),
                        number("width_ln"),
                        number("unbounded"),
                        number("warned"),
                        text("verdict")});
    }
    return rows;
}

std::string mark(const std::string& verdict) {
    return verdict == "no" ? " **!**" : verdict == "near" ? " ~" : "";
}

/// Of the default method: a row a population, a column a number of observers and list of sizes.
BenchTable matrix(const std::vector<Row>& rows, const std::string& method, const std::string& name,
                  const std::string& title, const std::function<std::string(const Row&)>& text) {
    BenchTable table{name, title, {"SD", "lapses", "beta"}};
    std::vector<FactorialPopulation> populations;
    for (const Row& row : rows) {
        if (std::find(populations.begin(), populations.end(), row.population) == populations.end()) {
            populations.push_back(row.population);
        }
    }
    const auto for_cells = [&](const auto& visit) {
        for (const int observers : kFactorialObservers) {
            for (const std::vector<double>& texels_px : factorial_sizes_px()) visit(observers, sizes_text(texels_px));
        }
    };
    for_cells([&](int observers, const std::string& sizes) {
        table.columns.push_back(std::to_string(observers) + " observers, " + sizes + " px");
    });
    for (const FactorialPopulation& population : populations) {
        BenchRow line{{{population.between_observer_sd, 2}, {population.lapse, 2}, {population.beta, 1}}};
        for_cells([&](int observers, const std::string& sizes) {
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
                return r.population == population && r.observers == observers && r.sizes == sizes && r.method == method;
            });
            line.cells.emplace_back(row == rows.end() ? "" : text(*row));
        });
        table.rows.push_back(line);
    }
    return table;
}

/// Methods beside each other, for each number of observers.
BenchTable methods_table(const std::vector<Row>& rows) {
    BenchTable table{"methods",
                     "All methods",
                     {"method", "observers", "cells", "studies a cell", "coverage, mean", "lowest", "highest",
                      "outside .93 to .97", "by over two SE", "bias, mean", "width, mean"}};
    std::vector<std::string> methods;
    for (const Row& row : rows) {
        if (std::find(methods.begin(), methods.end(), row.method) == methods.end()) methods.push_back(row.method);
    }
    for (const std::string& method : methods) {
        for (const int observers : kFactorialObservers) {
            double coverage = 0, bias = 0, width = 0, lowest = 1, highest = 0;
            int cells = 0, outside = 0, far = 0, studies = 0;
            for (const Row& row : rows) {
                if (row.method != method || row.observers != observers) continue;
                ++cells;
                studies = std::max(studies, row.studies);
                coverage += row.coverage;
                bias += row.bias;
                width += row.width;
                lowest = std::min(lowest, row.coverage);
                highest = std::max(highest, row.coverage);
                outside += row.verdict != "yes";
                far += row.verdict == "no";
            }
            if (cells == 0) continue;
            table.rows.push_back(
                {{method, observers, cells, studies, BenchCell(coverage / cells, 3), BenchCell(lowest, 3),
                  BenchCell(highest, 3), outside, far, BenchCell(bias / cells, 4), BenchCell(width / cells, 3)}});
        }
    }
    return table;
}

BenchTable failures_table(const std::vector<Row>& rows, const std::string& method) {
    BenchTable table{"failures",
                     "Cells where " + method + " lies outside .93 to .97",
                     {"SD", "lapses", "beta", "observers", "sizes", "coverage", "SE", "beyond two SE", "bias of ln c",
                      "SD of ln c", "fit warns"}};
    for (const Row& row : rows) {
        if (row.method != method || row.verdict == "yes") continue;
        table.rows.push_back({{BenchCell(row.population.between_observer_sd, 2), BenchCell(row.population.lapse, 2),
                               BenchCell(row.population.beta, 1), row.observers, row.sizes, BenchCell(row.coverage, 3),
                               BenchCell(row.coverage_se, 3), row.verdict == "no" ? "yes" : "no",
                               BenchCell(row.bias, 4), BenchCell(row.sd, 3), BenchCell(row.warned, 2)}});
    }
    if (table.rows.empty()) table.notes.push_back("None.");
    return table;
}

}  // namespace

std::string coverage_verdict(const MethodCoverage& m) {
    if (m.coverage >= 0.93 && m.coverage <= 0.97) return "yes";
    return m.is_on_target() ? "near" : "no";
}

CoverageTable CoverageTable::read(const CsvTable& csv, const FactorialSettings& settings) {
    CoverageTable table;
    if (csv.header() != kColumns) {
        throw InputError(csv.place(0), "isn't a table of coverage", "remove it, or write to another file");
    }
    const std::vector<FactorialPopulation> all = factorial_populations(FactorialShare::all);
    const std::vector<Row> rows = rows_in(csv);
    const std::string default_method(name(LawFitOptions{}.method));
    for (size_t i = 0; i < rows.size(); ++i) {
        if (std::find(all.begin(), all.end(), rows[i].population) == all.end()) {
            throw InputError(csv.place(i), "has a population that the factorial doesn't", "write to another file");
        }
        const bool is_same = csv.text(i, csv.column("seed")) == std::to_string(settings.seed) &&
                             csv.text(i, csv.column("replicates")) == std::to_string(settings.replicates) &&
                             (rows[i].method != default_method ||
                              rows[i].studies + csv.number(i, csv.column("failed")) == settings.studies);
        if (!is_same) {
            throw InputError(csv.place(i), "was made with other studies, replicates or another seed",
                             "give the same flags, or write to another file");
        }
        CsvWriter line;
        std::vector<std::string> fields;
        for (size_t c = 0; c < kColumns.size(); ++c) fields.push_back(csv.text(i, c));
        line.row(fields);
        if (table.parts_.empty() || !(table.parts_.back().population == rows[i].population)) {
            table.parts_.push_back({rows[i].population, ""});
        }
        table.parts_.back().rows += line.text();
    }
    return table;
}

bool CoverageTable::holds(const FactorialPopulation& population) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.population == population; });
}

void CoverageTable::add(const std::vector<FactorialCell>& cells, const FactorialSettings& settings) {
    parts_.push_back({cells.front().population, rows_of(cells, settings)});
}

std::string CoverageTable::csv() const {
    std::string text = header_line();
    for (const FactorialPopulation& population : factorial_populations(FactorialShare::all)) {
        for (const Part& part : parts_) {
            if (part.population == population) text += part.rows;
        }
    }
    return text;
}

std::string coverage_document(const CsvTable& csv, const std::string& command) {
    const std::vector<Row> rows = rows_in(csv);
    const std::string method(name(LawFitOptions{}.method));
    std::set<std::tuple<double, double, double>> populations;
    int failures = 0, cells = 0, near = 0;
    for (const Row& row : rows) {
        populations.insert({row.population.between_observer_sd, row.population.lapse, row.population.beta});
        if (row.method != method) continue;
        ++cells;
        failures += row.verdict == "no";
        near += row.verdict == "near";
    }
    std::string text =
        "# What intervals for the law's slope cover\n\nMade by\n\n```\n" + command +
        "\n```\n\nwith version " STAIRSTEP_VERSION
        ". The same seed gives the same bytes, with any number of `--jobs` and in any number of goes "
        "(`--resume`).\n\n"
        "A law is planted in simulated observers, who go through sessions with the usual engine into a "
        "store; what comes\nout is fitted as any study is, and 95 % intervals for c are counted that "
        "hold the median observer's slope. " +
        std::to_string(populations.size()) + " of the\nfactorial's " +
        std::to_string(factorial_populations(FactorialShare::all).size()) +
        " populations were simulated (between-observer SD of ln c × lapse rate × steepness), each with "
        "three numbers of\nobservers and two lists of sizes: " +
        std::to_string(cells) +
        " cells. A study has 40 trials a track. Fits expect β of about 3 and few lapses, so that\nβ of 2 "
        "and 5 and lapses of .05 are wrong slopes and inattentive observers.\n\nThe default method, " +
        method + ", lies in .93 to .97 in " + std::to_string(cells - failures - near) +
        " cells, outside by two standard\nerrors at most in " + std::to_string(near) + " (~), and outside by more in " +
        std::to_string(failures) + " (**!**).\n\n";
    text +=
        "`fit` warns where it knows that its interval may hold c less often: where it is so narrow that the observers' "
        "shapes\n"
        "count, where few observers have most of the weight, and for bca with fewer than 40 observers. The last column "
        "of the\n"
        "third table is the share of studies in which it did. Bootstraps are made of part of the studies, as the last "
        "table\n"
        "says. Cells of one row share their simulated observers and are not independent of each other.\n\n";
    text += to_markdown(matrix(rows, method, "coverage", "Coverage of " + method,
                               [](const Row& row) {
                                   return format_fixed(row.coverage, 3) + " ± " + format_fixed(row.coverage_se, 3) +
                                          mark(row.verdict);
                               })) +
            "\n";
    text += to_markdown(matrix(
                rows, method, "bias", "Bias of ln c (" + method + ")",
                [](const Row& row) { return format_fixed(row.bias, 4) + " ± " + format_fixed(row.bias_se, 4); })) +
            "\n";
    text += to_markdown(failures_table(rows, method)) + "\n";
    text += to_markdown(methods_table(rows));
    return text;
}

}  // namespace stairstep
