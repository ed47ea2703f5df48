#include "analysis/law_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/law_table.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/random.h"
#include "tests/analysis/planted_thresholds.h"

namespace stairstep {
namespace {

/// A study answered by rule: right wherever the radius is below slope × texel.
std::vector<Trial> study_by_rule(int observers, const std::vector<double>& texels_px, double spread) {
    std::vector<Trial> trials;
    for (int i = 0; i < observers; ++i) {
        const double slope = 3 * std::exp(spread * (i - (observers - 1) / 2.0));
        Random random(static_cast<uint64_t>(i));
        for (const double a : texels_px) {
            for (int k = 0; k < 60; ++k) {
                Trial trial;
                trial.observer = "o" + std::to_string(i);
                trial.condition = {Pattern::step, KernelShape::box, 1, a};
                trial.radius_px = a * slope * std::pow(10, 0.5 - (k + 0.5) / 60);
                const bool right = trial.radius_px < a * slope || random.below(2) == 0;
                trial.response = right ? trial.stimulus : Judgement::line;
                trials.push_back(trial);
            }
        }
    }
    return trials;
}

TEST(FitLaw, GivesIntervalsFromTheSpreadBetweenObservers) {
    const LawFit narrow = fit_law(study_by_rule(8, {5, 10, 20}, 0.01), 0.82, "test");
    const LawFit wide = fit_law(study_by_rule(8, {5, 10, 20}, 0.15), 0.82, "test");
    ASSERT_EQ(narrow.law.conditions.size(), 1u);
    EXPECT_NEAR(narrow.law.slope, 3, 0.3);
    EXPECT_GT(wide.law.slope_ci95.second - wide.law.slope_ci95.first,
              3 * (narrow.law.slope_ci95.second - narrow.law.slope_ci95.first));
    EXPECT_EQ(narrow.law.observers, 8);
    EXPECT_EQ(narrow.law.trials, 8 * 3 * 60);
    EXPECT_EQ(narrow.law.texel_range_px, Interval(5, 20));
}

TEST(FitLaw, TheWorstConditionIsTheLaw) {
    std::vector<Trial> trials = study_by_rule(4, {5, 10}, 0.05);
    std::vector<Trial> easier = study_by_rule(4, {5, 10}, 0.05);
    for (Trial& trial : easier) {
        trial.condition.pattern = Pattern::stair;
        trial.radius_px *= 0.7;
    }
    trials.insert(trials.end(), easier.begin(), easier.end());
    const Law law = fit_law(trials, 0.82, "test").law;
    ASSERT_EQ(law.conditions.size(), 2u);
    EXPECT_EQ(law.pattern, Pattern::step);
    EXPECT_EQ(law.slope, std::max(law.conditions[0].slope, law.conditions[1].slope));
    EXPECT_NEAR(law.conditions[1].slope / law.conditions[0].slope, 0.7, 0.02);
}

TEST(FitLaw, SaysWhatCannotBeEstimated) {
    EXPECT_THROW(fit_law(study_by_rule(1, {5, 10}, 0), 0.82, "test"), FailureError);  // one observer
    std::vector<Trial> all_right = study_by_rule(5, {5, 10}, 0.1);
    for (Trial& trial : all_right) trial.response = trial.stimulus;
    EXPECT_THROW(fit_law(all_right, 0.82, "test"), FailureError);

    // One observer who is always right is left out, with a warning, and the others' law stands.
    std::vector<Trial> mixed = study_by_rule(5, {5, 10}, 0.1);
    for (Trial& trial : mixed) {
        if (trial.observer == "o2") trial.response = trial.stimulus;
    }
    const LawFit fit = fit_law(mixed, 0.82, "test");
    EXPECT_EQ(fit.law.conditions[0].observers, 4);
    EXPECT_FALSE(fit.warnings.empty());
}

/// Every number that a law file would hold.
void expect_writes(const LawFit& fit) {
    const TemporaryFolder folder;
    write_law(folder.path() / "law.json", fit.law);  // throws for NaN and infinity
    const Law read = read_law(folder.path() / "law.json");
    EXPECT_EQ(read.slope, fit.law.slope);
    ASSERT_EQ(read.conditions.size(), fit.law.conditions.size());
    for (size_t k = 0; k < read.conditions.size(); ++k) {
        EXPECT_EQ(read.conditions[k].has_form, fit.law.conditions[k].has_form);
        EXPECT_EQ(read.conditions[k].exponent, fit.law.conditions[k].exponent);
    }
    EXPECT_FALSE(law_table(fit.law).empty());
}

LawFit fit_planted(const PlantedStudy& study, uint64_t seed, const LawFitOptions& options = {}) {
    return fit_law_to_thresholds(study.thresholds(Random(seed)), 0.82, "planted", options);
}

const LawFitOptions kEverything{.bootstrap = {.replicates = 200, .seed = 1, .jobs = 2}};

TEST(FitLaw, HoldsEveryEstimateWithItsMethod) {
    const LawFit fit = fit_planted({}, 1, kEverything);
    ASSERT_EQ(fit.law.conditions.size(), 4u);
    for (const ConditionLaw& law : fit.law.conditions) {
        EXPECT_EQ(law.estimates.size(), std::size(kSlopeMethods) - 1);  // thresholds only where it is asked for
        EXPECT_EQ(law.slope, law.estimates[0].value);
        EXPECT_EQ(law.slope_ci95, law.estimates[0].ci95);
        EXPECT_EQ(law.slope_method, law.estimates[0].method);
        EXPECT_LT(law.tau_ln, law.between_observer_sd_ln);  // without measurement error
        EXPECT_EQ(law.observer_slopes.size(), 10u);
        double weight = 0;
        for (const ObserverSlope& o : law.observer_slopes) weight += o.weight;
        EXPECT_NEAR(weight, 1, 1e-12);
    }
    EXPECT_EQ(fit.law.comparisons.size(), 4u);
    EXPECT_GE(fit.law.slope_ci95.second, fit.law.conditions[0].slope_ci95.second);
    expect_writes(fit);
}

TEST(FitLaw, TheChosenMethodIsTheLaws) {
    for (const SlopeMethod method : kSlopeMethods) {
        LawFitOptions options = kEverything;
        options.method = method;
        const LawFit fit = fit_planted({}, 2, options);
        const ConditionLaw& law = fit.law.conditions[0];
        const auto chosen = std::find_if(law.estimates.begin(), law.estimates.end(),
                                         [&](const SlopeEstimate& e) { return e.name == name(method); });
        ASSERT_NE(chosen, law.estimates.end()) << name(method);
        EXPECT_EQ(law.slope, chosen->value);
        EXPECT_EQ(law.slope_method, chosen->method);
        expect_writes(fit);
    }
    EXPECT_THROW(fit_planted({}, 2, {.method = SlopeMethod::bca}), InputError);  // no replicates
    EXPECT_THROW(fit_planted({}, 2, {.method = SlopeMethod::profile, .robust = true}), InputError);
}

TEST(FitLaw, SaysWhatItsIntervalLacks) {
    const auto warned = [](const LawFit& fit, const char* of) {
        return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                           [&](const std::string& warning) { return warning.find(of) != std::string::npos; });
    };
    const LawFit usual = fit_planted({}, 1, kEverything);
    EXPECT_FALSE(warned(usual, "few observers"));
    EXPECT_FALSE(warned(usual, "bca"));
    PlantedStudy alike;
    alike.observers = 20;
    alike.between_sd = 0.03;
    EXPECT_TRUE(warned(fit_planted(alike, 1, kEverything), "narrow"));
    PlantedStudy unlike;
    unlike.between_sd = 0.4;
    EXPECT_FALSE(warned(fit_planted(unlike, 1, kEverything), "narrow"));
    LawFitOptions bca = kEverything;
    bca.method = SlopeMethod::bca;
    EXPECT_TRUE(warned(fit_planted({}, 1, bca), "bca with 10 observers"));
    PlantedStudy many;
    many.observers = 40;
    EXPECT_FALSE(warned(fit_planted(many, 1, bca), "bca with"));
}

TEST(FitLaw, OneAndTwoThreadsGiveTheSameFile) {
    const TemporaryFolder folder;
    const auto bytes = [&](int jobs) {
        LawFitOptions options{.method = SlopeMethod::thresholds,
                              .bootstrap = {.replicates = 200, .seed = 1, .jobs = jobs}};
        write_law(folder.path() / "law.json", fit_planted({}, 3, options).law);
        return read_file(folder.path() / "law.json");
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(FitLaw, SaysHowFarOneObserverAndOneSizeMoveIt) {
    // Equal errors: the mean without observer j is (n·m − y_j)/(n − 1), without a size that of the other sizes.
    PlantedStudy study;
    study.slopes = {3};
    std::vector<Threshold> thresholds = study.thresholds(Random(4));
    for (Threshold& t : thresholds) t.log_threshold_sd = 0.05;
    const ConditionLaw law = fit_law_to_thresholds(thresholds, 0.82, "test").law.conditions[0];
    double sum = 0;
    for (const ObserverSlope& o : law.observer_slopes) sum += o.ln_slope;
    ASSERT_EQ(law.without_observer.size(), 10u);
    int largest = 0;
    double furthest = 0;
    for (const LeftOut& l : law.without_observer) furthest = std::max(furthest, std::abs(std::log1p(l.change)));
    for (size_t j = 0; j < 10; ++j) {
        const LeftOut& l = law.without_observer[j];
        EXPECT_EQ(l.left_out, law.observer_slopes[j].observer);
        EXPECT_NEAR(std::log(l.slope), (sum - law.observer_slopes[j].ln_slope) / 9, 1e-6);
        EXPECT_NEAR(l.change, l.slope / law.slope - 1, 1e-6);
        largest += l.is_largest;
        EXPECT_EQ(l.is_largest, std::abs(std::log1p(l.change)) == furthest);
    }
    EXPECT_EQ(largest, 1);
    ASSERT_EQ(law.without_size.size(), 4u);
    double without_five = 0;
    for (const Threshold& t : thresholds) {
        if (t.condition.texel_px != 5) without_five += std::log(t.radius_px() / t.condition.texel_px) / 30;
    }
    EXPECT_EQ(law.without_size[0].left_out, "5");
    EXPECT_NEAR(std::log(law.without_size[0].slope), without_five, 1e-6);
}

TEST(FitLaw, RobustFitSaysWhomItTrustsLess) {
    PlantedStudy study;
    study.slopes = {3};
    study.between_sd = 0.05;
    std::vector<Threshold> thresholds = study.thresholds(Random(5));
    for (Threshold& t : thresholds) {
        if (t.observer == "o4") t.log_threshold -= 0.5;  // an observer who needs three times the radius
        if (t.observer == "o6" && t.condition.texel_px == 20) t.log_threshold += 1;  // a track gone wrong
    }
    const LawFit plain = fit_law_to_thresholds(thresholds, 0.82, "test");
    const LawFit robust = fit_law_to_thresholds(thresholds, 0.82, "test", {.robust = true});
    EXPECT_LT(std::abs(std::log(robust.law.slope / 3)), 0.5 * std::abs(std::log(plain.law.slope / 3)) + 0.03);
    const auto& list = robust.law.conditions[0].down_weighted;
    EXPECT_TRUE(std::any_of(list.begin(), list.end(),
                            [](const DownWeighted& d) { return d.observer == "o4" && !d.texel_px && d.weight < 0.3; }));
    EXPECT_TRUE(std::any_of(list.begin(), list.end(), [](const DownWeighted& d) {
        return d.observer == "o6" && d.texel_px == 20 && d.weight < 0.2;
    }));
    EXPECT_GE(robust.warnings.size(), 2u);
    EXPECT_TRUE(plain.law.conditions[0].down_weighted.empty());
    expect_writes(robust);
}

TEST(FitLaw, OneObserverHasNoLawAndSaysWhy) {
    PlantedStudy study;
    study.observers = 1;
    try {
        fit_planted(study, 1);
        FAIL();
    } catch (const FailureError& e) {
        EXPECT_EQ(e.exit_code(), 1);
        EXPECT_NE(std::string(e.what()).find("can't be estimated, because only one observer (o0)"), std::string::npos)
            << e.what();
    }
}

TEST(FitLaw, StandsWhereDataIsThinOrStrange) {
    std::vector<std::pair<const char*, std::vector<Threshold>>> cases;
    PlantedStudy study;
    study.observers = 2;
    cases.emplace_back("two observers", study.thresholds(Random(1)));
    study = {};
    study.between_sd = 0;
    study.threshold_sd = 1e-9;
    cases.emplace_back("identical observers", study.thresholds(Random(2)));
    study = {};
    study.texels_px = {10};
    cases.emplace_back("one size", study.thresholds(Random(3)));
    study.texels_px = {10, 20};
    cases.emplace_back("two sizes", study.thresholds(Random(4)));
    study.texels_px = {1e-3, 1e6};
    cases.emplace_back("far sizes", study.thresholds(Random(5)));
    study = {};
    std::vector<Threshold> doubled = study.thresholds(Random(6));
    const std::vector<Threshold> once = doubled;
    doubled.insert(doubled.end(), once.begin(), once.end());
    cases.emplace_back("every row twice", doubled);
    std::vector<Threshold> wild = once;
    for (Threshold& t : wild) {
        if (t.observer == "o1") t.log_threshold = 30;
    }
    cases.emplace_back("a wild observer", wild);
    std::vector<Threshold> uneven = once;
    for (Threshold& t : uneven) t.log_threshold_sd = t.observer == "o2" ? 1e-7 : 3;
    cases.emplace_back("uneven precision", uneven);
    std::vector<Threshold> patchy = once;
    std::erase_if(patchy, [](const Threshold& t) { return t.observer > "o2" && t.condition.texel_px > 5; });
    cases.emplace_back("most observers at one size", patchy);
    for (const auto& [what, thresholds] : cases) {
        for (const bool robust : {false, true}) {
            SCOPED_TRACE(std::string(what) + (robust ? ", robust" : ""));
            LawFitOptions options = kEverything;
            options.robust = robust;
            const LawFit fit = fit_law_to_thresholds(thresholds, 0.82, "test", options);
            expect_writes(fit);
            const bool one_size = std::string(what) == "one size";
            for (const ConditionLaw& law : fit.law.conditions) {
                if (std::string(what) == "uneven precision") {
                    EXPECT_TRUE(std::any_of(fit.warnings.begin(), fit.warnings.end(), [](const std::string& warning) {
                        return warning.find("few observers") != std::string::npos;
                    }));
                }
                EXPECT_EQ(law.has_form, !one_size);
                EXPECT_EQ(law.without_size.empty(), one_size);
                if (std::string(what) == "identical observers") {
                    EXPECT_LT(law.tau_ln, 1e-8);
                    EXPECT_NEAR(law.slope_ci95.first / law.slope_ci95.second, 1, 1e-8);
                }
            }
            if (one_size) {
                EXPECT_NE(law_table(fit.law).find("intercept and exponent not estimated"), std::string::npos);
            }
        }
    }
}

TEST(FitLaw, FollowsTheUnitOfLength) {
    const std::vector<Threshold> thresholds = PlantedStudy{}.thresholds(Random(7));
    const Law law = fit_law_to_thresholds(thresholds, 0.82, "test").law;
    for (const double scale : {1e-8, 1e8}) {
        std::vector<Threshold> scaled = thresholds;
        for (Threshold& t : scaled) t.condition.texel_px *= scale;  // the radius follows
        const LawFit other = fit_law_to_thresholds(scaled, 0.82, "test");
        expect_writes(other);
        for (size_t k = 0; k < 4; ++k) {
            const ConditionLaw& a = law.conditions[k];
            const ConditionLaw& b = other.law.conditions[k];
            EXPECT_NEAR(b.slope, a.slope, 1e-8);
            EXPECT_NEAR(b.slope_ci95.first, a.slope_ci95.first, 1e-7);
            EXPECT_NEAR(b.exponent, a.exponent, 1e-6);
            EXPECT_NEAR(b.intercept_px / scale, a.intercept_px, 1e-4);
            EXPECT_NEAR(b.intercept_ci95.second / scale, a.intercept_ci95.second, 1e-3);
        }
    }
}

TEST(FitLaw, CoversSlopeInterceptExponentAndWorstCase) {
    // 50 studies of ten observers and four conditions: 200 intervals each (of 800: .946, .951, .946, worst case .965), an observer's effects shared among a study's four.
    int slope = 0, intercept = 0, exponent = 0, worst = 0;
    constexpr int kPlanted = 50;
    const PlantedStudy study;
    for (int i = 0; i < kPlanted; ++i) {
        const Law law = fit_law_to_thresholds(study.thresholds(Random(40).stream(static_cast<uint64_t>(i))), 0.82,
                                              "test", {.bootstrap = {.replicates = 0, .jobs = 2}})
                            .law;
        const auto holds = [](const Interval& interval, double truth) {
            return interval.first <= truth && truth <= interval.second;
        };
        for (size_t k = 0; k < 4; ++k) {
            slope += holds(law.conditions[k].slope_ci95, study.slopes[k]);
            intercept += holds(law.conditions[k].intercept_ci95, 0);
            exponent += holds(law.conditions[k].exponent_ci95, 1);
        }
        worst += holds(law.slope_ci95, 3.47);
    }
    std::printf("of %d studies: slope %.3f, intercept %.3f, exponent %.3f, worst case %.3f\n", kPlanted,
                slope / (4.0 * kPlanted), intercept / (4.0 * kPlanted), exponent / (4.0 * kPlanted),
                worst / double(kPlanted));
    EXPECT_GE(slope, 0.89 * 4 * kPlanted);
    EXPECT_GE(intercept, 0.89 * 4 * kPlanted);
    EXPECT_GE(exponent, 0.89 * 4 * kPlanted);
    EXPECT_GE(worst, 0.88 * kPlanted);
}

TEST(FitCriteria, AskForMoreTexelsWhereLessMayBeSeen) {
    const std::vector<Trial> trials = study_by_rule(4, {5, 10}, 0.05);
    const auto criteria = fit_criteria(trials, {0.75, 0.9}, "test");
    ASSERT_EQ(criteria.size(), 2u);
    EXPECT_GT(criteria[0].slope, criteria[1].slope);
    const double reference = fit_law(trials, 0.82, "test").law.slope;
    EXPECT_DOUBLE_EQ(criteria[0].texels_across, criteria[0].slope / reference);
    EXPECT_DOUBLE_EQ(criteria[1].texels_in_all, std::pow(criteria[1].slope / reference, 2));
    EXPECT_EQ(fit_criteria(trials, {0.82}, "test")[0].texels_across, 1);
}

}  // namespace
}  // namespace stairstep
