#include "analysis/coverage_factorial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/coverage_table.h"
#include "analysis/law_fit.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

const FactorialPopulation kPopulation{0.16, 0.02, 3.5};

TEST(CoverageFactorial, AThirdHoldsEachLevelEquallyOften) {
    const auto all = factorial_populations(FactorialShare::all);
    const auto third = factorial_populations(FactorialShare::third);
    EXPECT_EQ(all.size(), 18u);
    EXPECT_EQ(third.size(), 6u);
    std::map<double, int> sds, lapses, betas;
    std::map<std::pair<double, double>, int> pairs;
    for (const FactorialPopulation& p : third) {
        EXPECT_NE(std::find(all.begin(), all.end(), p), all.end());
        ++sds[p.between_observer_sd];
        ++lapses[p.lapse];
        ++betas[p.beta];
        ++pairs[{p.lapse, p.between_observer_sd}];
        ++pairs[{p.lapse, p.beta + 100}];
    }
    for (const auto& [level, count] : sds) EXPECT_EQ(count, 2) << level;
    for (const auto& [level, count] : lapses) EXPECT_EQ(count, 3) << level;
    for (const auto& [level, count] : betas) EXPECT_EQ(count, 2) << level;
    EXPECT_EQ(pairs.size(), 12u);  // each once
}

TEST(CoverageFactorial, PartsAreFittedAsStudies) {
    const FactorialSettings settings{.studies = 2, .bootstrap_studies = 0, .seed = 9, .jobs = 2};
    const auto cells = factorial_coverage(kPopulation, {}, settings);
    ASSERT_EQ(cells.size(), 6u);
    const auto all = factorial_populations(FactorialShare::all);
    const auto place = static_cast<uint64_t>(std::find(all.begin(), all.end(), kPopulation) - all.begin());
    std::vector<std::vector<Trial>> studies;
    for (uint64_t i = 0; i < 2; ++i) {
        const uint64_t seed = Random(settings.seed).stream(place).stream(i).bits() >> 1;
        studies.push_back(simulate_study(factorial_study(kPopulation, {}), seed));
    }
    for (const FactorialCell& cell : cells) {
        if (cell.observers == 20) continue;  // the same once more, and longest
        std::map<std::string, double> bias;
        for (const std::vector<Trial>& study : studies) {
            std::vector<Trial> part;
            for (const Trial& trial : study) {
                const bool has_size = std::find(cell.texels_px.begin(), cell.texels_px.end(),
                                                trial.condition.texel_px) != cell.texels_px.end();
                if (has_size && std::stoi(trial.observer.substr(3)) <= cell.observers) part.push_back(trial);
            }
            const LawFit fit = fit_law(part, 0.82, "part");
            for (const SlopeEstimate& e : fit.law.conditions[0].estimates) {
                bias[e.name] += std::log(e.value / 3.47) / 2;
            }
        }
        ASSERT_EQ(cell.methods.size(), bias.size());
        for (const MethodCoverage& m : cell.methods) EXPECT_NEAR(m.bias, bias[m.method], 1e-6) << m.method;
    }
}

TEST(CoverageFactorial, IsTheSameOnAnyNumberOfThreadsAndInAnyNumberOfGoes) {
    FactorialSettings settings{.studies = 3, .bootstrap_studies = 2, .replicates = 20, .seed = 4, .jobs = 1};
    const FactorialPopulation other{0.05, 0.05, 3.5};
    CoverageTable one;
    one.add(factorial_coverage(other, {}, settings), settings);
    one.add(factorial_coverage(kPopulation, {}, settings), settings);
    settings.jobs = 2;
    CoverageTable first;
    first.add(factorial_coverage(kPopulation, {}, settings), settings);
    CoverageTable two = CoverageTable::read(CsvTable::parse(first.csv(), "coverage.csv"), settings);
    EXPECT_TRUE(two.holds(kPopulation));
    EXPECT_FALSE(two.holds(other));
    two.add(factorial_coverage(other, {}, settings), settings);
    EXPECT_EQ(one.csv(), two.csv());

    const std::string text = coverage_document(CsvTable::parse(one.csv(), "coverage.csv"), "the command");
    for (const char* part : {"the command", "2 of the", "12 cells", "sandwich", "bca", "thresholds"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    settings.seed = 5;
    EXPECT_THROW(CoverageTable::read(CsvTable::parse(first.csv(), "coverage.csv"), settings), InputError);
    EXPECT_THROW(CoverageTable::read(CsvTable::parse("a,b\n1,2\n", "coverage.csv"), settings), InputError);
}

TEST(CoverageFactorial, RefusesEnginesWhoseTracksShareEvidence) {
    Design design;
    design.engine = LawDirectedSettings{};
    EXPECT_THROW(factorial_coverage(kPopulation, design, {.studies = 2}), InputError);
}

TEST(CoverageVerdict, TellsNearFromFar) {
    EXPECT_EQ(coverage_verdict({.coverage = 0.95, .coverage_se = 0.007}), "yes");
    EXPECT_EQ(coverage_verdict({.coverage = 0.925, .coverage_se = 0.007}), "near");
    EXPECT_EQ(coverage_verdict({.coverage = 0.9, .coverage_se = 0.007}), "no");
}

}  // namespace
}  // namespace stairstep
