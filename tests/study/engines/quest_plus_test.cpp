#include "study/engines/quest_plus.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string_view>

#include "stimuli/error.h"
#include "stimuli/random.h"
#include "study/psychometric.h"

namespace stairstep {
namespace {

std::vector<double> range(double first, double last, double step) {
    std::vector<double> values;
    for (int i = 0; first + i * step <= last + 1e-9; ++i) values.push_back(first + i * step);
    return values;
}

std::vector<std::vector<double>> points(const std::vector<double>& values) {
    std::vector<std::vector<double>> list;
    for (const double v : values) list.push_back({v});
    return list;
}

/// Watson's Weibull in decibels, 1 − λ − (1 − γ − λ)·exp(−10^{β(x − T)/20}); outcome 0 is a correct answer. Our δ is
/// the rate of blind answers, of which γ are right: λ = δ(1 − γ).
void weibull_in_decibels(double contrast, double threshold, double beta, double gamma, double lapse,
                         std::span<double> log_p) {
    const PsychometricShape shape{.beta = beta / 20, .gamma = gamma, .delta = lapse / (1 - gamma)};
    for (const int outcome : {0, 1}) log_p[outcome] = log_likelihood(shape, 0, contrast, threshold, outcome == 0);
}

// Facts of the next two tests: Watson (2017), examples 1 and 4, as the questplus package lists them (Höchenberger,
// questplus/tests/test_qp.py). C is a correct answer, x a wrong one.

TEST(QuestPlus, RepeatsWatsonsFirstExampleTrialByTrial) {
    const std::vector<double> expected{-18, -22, -25, -28, -30, -22, -13, -15, -16, -18, -19, -20, -21, -22, -23, -19,
                                       -20, -20, -18, -18, -19, -17, -17, -18, -18, -18, -19, -19, -19, -19, -19, -19};
    const std::string_view answers = "CCCCxxCCCCCCCCxCCxCCxCCCCCCCCCCC";
    QuestPlus quest({.stimuli = points(range(-40, 0, 1)),
                     .parameters = {{"threshold", range(-40, 0, 1)}},
                     .model = [](auto stimulus, auto parameters, auto log_p) {
                         weibull_in_decibels(stimulus[0], parameters[0], 3.5, 0.5, 0.02, log_p);
                     }});
    for (size_t trial = 0; trial < expected.size(); ++trial) {
        const std::vector<double>& stimulus = quest.stimulus(quest.suggest());
        EXPECT_EQ(stimulus[0], expected[trial]) << "trial " << trial;
        quest.update(stimulus, answers[trial] == 'C' ? 0 : 1);
    }
    EXPECT_EQ(quest.mode()[0], -20);
    EXPECT_EQ(quest.trials(), 32);
}

TEST(QuestPlus, RepeatsWatsonsContrastSensitivityFunctionTrialByTrial) {
    // Two dimensions of stimuli, three parameters: T = max(T_min, c_0 + c_f·f).
    const std::vector<double> contrasts{0,  -4,  0,  0,   -38, 0,   -40, 0,   -26, -26, 0,   -36, -36, 0,   -26, -26,
                                        -2, -26, -6, -26, 0,   -26, 0,   -26, -32, -32, -34, -34, 0,   -26, 0,   -26};
    const std::vector<double> frequencies{40, 40, 34, 36, 0,  38, 0,  38, 18, 18, 40, 0, 0,  40, 20, 20,
                                          40, 22, 40, 20, 40, 18, 40, 18, 0,  0,  0,  0, 40, 18, 38, 18};
    const std::string_view answers = "CxCCCCxCCCCCxCCCCCxxCCCCCCCxxCCC";
    QuestPlusSettings settings{.parameters = {{"minimal threshold", range(-50, -30, 2)},
                                              {"c0", range(-60, -40, 2)},
                                              {"cf", range(0.8, 1.6, 0.2)}},
                               .model = [](auto stimulus, auto parameters, auto log_p) {
                                   const double threshold =
                                       std::max(parameters[0], parameters[1] + parameters[2] * stimulus[1]);
                                   weibull_in_decibels(stimulus[0], threshold, 3, 0.5, 0.01, log_p);
                               }};
    for (const double contrast : range(-50, 0, 2)) {
        for (const double frequency : range(0, 40, 2)) settings.stimuli.push_back({contrast, frequency});
    }
    QuestPlus quest(settings);
    for (size_t trial = 0; trial < contrasts.size(); ++trial) {
        const std::vector<double>& stimulus = quest.stimulus(quest.suggest());
        EXPECT_EQ(stimulus, (std::vector<double>{contrasts[trial], frequencies[trial]})) << "trial " << trial;
        quest.update(stimulus, answers[trial] == 'C' ? 0 : 1);
    }
    EXPECT_EQ(quest.mode()[0], -32);
    EXPECT_EQ(quest.mode()[1], -56);
    EXPECT_NEAR(quest.mode()[2], 1.4, 1e-12);
}

/// A random problem whose probabilities are a table, and the same posterior kept the plain way.
struct RandomProblem {
    Random random;
    std::vector<size_t> sizes;
    std::vector<bool> nuisance;
    size_t stimuli, outcomes, combinations = 1;
    std::vector<double> table;
    std::vector<double> posterior;

    explicit RandomProblem(uint64_t seed) : random(seed), stimuli(2 + random.below(5)), outcomes(2 + random.below(3)) {
        const size_t parameters = 1 + random.below(3);
        for (size_t p = 0; p < parameters; ++p) {
            sizes.push_back(1 + random.below(4));
            nuisance.push_back(random.below(2) == 1);
            combinations *= sizes.back();
        }
        nuisance[random.below(parameters)] = false;
        for (size_t row = 0; row < stimuli * combinations; ++row) {
            std::vector<double> p(outcomes);
            double sum = 0;
            for (double& value : p) sum += value = random.below(8) == 0 ? 0 : random.uniform();
            if (sum == 0) sum = p[0] = 1;
            for (const double value : p) table.push_back(value / sum);
        }
        posterior.assign(combinations, 1.0 / static_cast<double>(combinations));
    }

    /// Row-major, the last parameter fastest.
    size_t combination(std::span<const double> values) const {
        size_t index = 0;
        for (size_t p = 0; p < sizes.size(); ++p) index = index * sizes[p] + static_cast<size_t>(values[p]);
        return index;
    }
    double probability(size_t stimulus, size_t combination, size_t outcome) const {
        return table[(stimulus * combinations + combination) * outcomes + outcome];
    }
    /// The parameters of interest of a combination, as one number.
    size_t target(size_t combination) const {
        size_t index = 0;
        size_t scale = 1;
        for (size_t p = sizes.size(); p-- > 0; combination /= sizes[p]) {
            if (nuisance[p]) continue;
            index += scale * (combination % sizes[p]);
            scale *= sizes[p];
        }
        return index;
    }

    /// By the definition: for each outcome Bayes' rule, sums over the nuisance parameters, the entropy of what remains.
    double expected_entropy(size_t stimulus) const {
        double expected = 0;
        for (size_t o = 0; o < outcomes; ++o) {
            double of_outcome = 0;
            std::vector<double> marginal(combinations);
            for (size_t c = 0; c < combinations; ++c) {
                of_outcome += posterior[c] * probability(stimulus, c, o);
                marginal[target(c)] += posterior[c] * probability(stimulus, c, o);
            }
            if (of_outcome == 0) continue;
            double entropy = 0;
            for (const double joint : marginal) {
                if (joint > 0) entropy -= joint / of_outcome * std::log(joint / of_outcome);
            }
            expected += of_outcome * entropy;
        }
        return expected;
    }

    QuestPlusSettings settings() const {
        QuestPlusSettings s{.outcomes = static_cast<int>(outcomes)};
        for (size_t i = 0; i < stimuli; ++i) s.stimuli.push_back({static_cast<double>(i)});
        for (size_t p = 0; p < sizes.size(); ++p) {
            s.parameters.push_back({.name = std::to_string(p),
                                    .values = range(0, static_cast<double>(sizes[p]) - 1, 1),
                                    .nuisance = nuisance[p]});
        }
        s.model = [problem = *this](auto stimulus, auto parameters, auto log_p) {
            for (size_t o = 0; o < problem.outcomes; ++o) {
                log_p[o] =
                    std::log(problem.probability(static_cast<size_t>(stimulus[0]), problem.combination(parameters), o));
            }
        };
        return s;
    }
};

RC_GTEST_PROP(QuestPlus, ExpectsTheEntropyOfTheDefinition, (uint64_t seed)) {
    RandomProblem problem(seed);
    QuestPlus quest(problem.settings());
    for (int trial = 0; trial < 4; ++trial) {
        const std::vector<double> expected = quest.expected_entropies();
        const size_t suggested = quest.suggest();
        for (size_t s = 0; s < problem.stimuli; ++s) {
            RC_ASSERT(std::abs(expected[s] - problem.expected_entropy(s)) < 1e-12);
            RC_ASSERT(expected[s] >= expected[suggested]);
            RC_ASSERT(s >= suggested || expected[s] > expected[suggested]);
        }
        // An answer drawn as the model with the present posterior would give it: never an impossible one.
        const size_t stimulus = problem.random.below(problem.stimuli);
        size_t outcome = 0;
        double mass = 0;
        do {
            outcome = problem.random.below(problem.outcomes);
            mass = 0;
            for (size_t c = 0; c < problem.combinations; ++c) {
                mass += problem.posterior[c] * problem.probability(stimulus, c, outcome);
            }
        } while (mass < 1e-3);
        for (size_t c = 0; c < problem.combinations; ++c) {
            problem.posterior[c] *= problem.probability(stimulus, c, outcome) / mass;
        }
        quest.update(quest.stimulus(stimulus), static_cast<int>(outcome));
        for (size_t p = 0; p < problem.sizes.size(); ++p) {
            std::vector<double> plain(problem.sizes[p]);
            size_t below = 1;
            for (size_t q = p + 1; q < problem.sizes.size(); ++q) below *= problem.sizes[q];
            for (size_t c = 0; c < problem.combinations; ++c) {
                plain[c / below % problem.sizes[p]] += problem.posterior[c];
            }
            const std::vector<double> marginal = quest.marginal(p);
            double mean = 0;
            double square = 0;
            for (size_t i = 0; i < plain.size(); ++i) {
                RC_ASSERT(std::abs(marginal[i] - plain[i]) < 1e-12);
                mean += plain[i] * static_cast<double>(i);
                square += plain[i] * static_cast<double>(i * i);
            }
            RC_ASSERT(std::abs(quest.mean(p) - mean) < 1e-12);
            RC_ASSERT(std::abs(quest.sd(p) * quest.sd(p) - (square - mean * mean)) < 1e-12);
        }
    }
}

QuestPlusSettings small_settings(double gamma, double delta) {
    return {.stimuli = points(range(-2, 2, 0.5)),
            .parameters = {{"threshold", range(-2, 2, 0.25)}, {.name = "beta", .values = {1, 50}, .nuisance = true}},
            .model = [=](auto stimulus, auto parameters, auto log_p) {
                const PsychometricShape shape{
                    .beta = parameters[1], .gamma = gamma, .delta = delta, .p_threshold = (1 + gamma) / 2};
                const double offset = threshold_offset(shape);
                log_p[0] = log_likelihood(shape, offset, stimulus[0], parameters[0], false);
                log_p[1] = log_likelihood(shape, offset, stimulus[0], parameters[0], true);
            }};
}

TEST(QuestPlus, TakesStimuliOffItsListAsTheyAre) {
    // At 0.013 the posterior of T is the model's there, not at 0 or 0.5.
    QuestPlusSettings settings = small_settings(0.5, 0.01);
    settings.parameters[1].values = {3.5};
    settings.parameters[0].prior = std::vector<double>(17, 2.0);
    settings.parameters[0].prior[3] = 0;
    QuestPlus quest(settings);
    quest.update(std::vector{0.013}, 1);
    const PsychometricShape shape{.p_threshold = 0.75};
    std::vector<double> plain;
    double mass = 0;
    for (const double t : settings.parameters[0].values) {
        plain.push_back(plain.size() == 3 ? 0 : probability_correct(shape, threshold_offset(shape), 0.013, t));
        mass += plain.back();
    }
    for (size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(quest.marginal(0)[i], plain[i] / mass, 1e-14);
}

TEST(QuestPlus, StaysFiniteUnderContradictions) {
    for (const double gamma : {0.0, 0.5}) {
        QuestPlus quest(small_settings(gamma, 0));
        for (int i = 0; i < 2000; ++i) quest.update(std::vector{i % 2 == 0 ? 10.0 : -10.0}, i % 2);
        double mass = 0;
        for (const double p : quest.marginal(0)) mass += p;
        EXPECT_NEAR(mass, 1, 1e-12);
        EXPECT_TRUE(std::isfinite(quest.mean(0)));
        // A wrong answer far above every threshold is equally impossible for all, and changes nothing.
        QuestPlus fresh(small_settings(gamma, 0));
        fresh.update(std::vector{0.3}, 1);
        const double before = fresh.mean(0);
        fresh.update(std::vector{1e6}, 0);
        EXPECT_NEAR(fresh.mean(0), before, 1e-12);
        for (const double entropy : quest.expected_entropies()) EXPECT_TRUE(std::isfinite(entropy));
    }
}

TEST(QuestPlus, RefusesWhatIsNoProblem) {
    const QuestPlusSettings good = small_settings(0.5, 0.01);
    const auto refuses = [&](auto spoil) {
        QuestPlusSettings settings = good;
        spoil(settings);
        EXPECT_THROW(QuestPlus{settings}, InputError);
    };
    refuses([](auto& s) { s.stimuli.clear(); });
    refuses([](auto& s) { s.stimuli[1] = {1, 2}; });
    refuses([](auto& s) { s.stimuli[1] = {NAN}; });
    refuses([](auto& s) { s.parameters.clear(); });
    refuses([](auto& s) { s.parameters[0].nuisance = true; });
    refuses([](auto& s) { s.parameters[0].values.clear(); });
    refuses([](auto& s) { s.parameters[1].prior = {1}; });
    refuses([](auto& s) { s.parameters[1].prior = {0, 0}; });
    refuses([](auto& s) { s.parameters[1].prior = {1, -1}; });
    refuses([](auto& s) { s.outcomes = 1; });
    refuses([](auto& s) { s.outcomes = 3; });  // the model fills two
    refuses([](auto& s) { s.parameters[0].values.resize(10'000'000); });
    refuses([](auto& s) { s.model = {}; });

    QuestPlus quest(good);
    EXPECT_THROW(quest.update(std::vector{0.0, 1.0}, 0), InputError);
    EXPECT_THROW(quest.update(std::vector<double>{NAN}, 0), InputError);
    EXPECT_THROW(quest.update(std::vector{0.0}, 2), InputError);
    EXPECT_EQ(quest.trials(), 0);
}

}  // namespace
}  // namespace stairstep
