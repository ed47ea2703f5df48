#include "study/engines/law_directed.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/random.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

struct Answer {
    int track;
    double intensity;
    bool correct;
};

/// Few points, so that everything can be enumerated; prior, deviation and slope are several points wide.
LawDirectedSettings small_settings() {
    return {.tracks = 2,
            .guess = -0.2,
            .guess_sd = 0.5,
            .deviation_sd = 0.15,
            .shapes = {{.beta = 2, .delta = 0.02}, {.beta = 5, .delta = 0.05}},
            .grain = 0.1,
            .range = 2};
}

std::vector<Answer> some_answers() {
    return {{0, 0.1, true},    {1, -0.35, false}, {0, -0.4, true},      {0, -0.6, false}, {1, 0.3, true},
            {1, -0.123, true}, {0, 0.0, false},   {1, 0.2718281, true}, {0, 0.4, true},   {0, -0.1, true}};
}

LawDirected after(const LawDirectedSettings& settings, const std::vector<Answer>& answers) {
    LawDirected engine(settings);
    for (const auto& [track, x, correct] : answers) engine.update(track, x, correct);
    return engine;
}

/// The whole of P(θ, T_0, T_1, shape | answers) for two tracks, by the definition and nothing else.
class Enumeration {
  public:
    Enumeration(const LawDirectedSettings& s, const std::vector<Answer>& answers) : s_(s) {
        const int half = static_cast<int>(std::ceil(s.range / s.grain / 2));
        for (int i = -half; i <= half; ++i) values_.push_back(s.guess + i * s.grain);
        double mass = 0;
        for (size_t shape = 0; shape < s.shapes.size(); ++shape) {
            std::vector<double> likelihood[2];
            for (int k = 0; k < 2; ++k) {
                for (const double t : values_) {
                    double product = 1;
                    for (const Answer& a : answers) {
                        if (a.track == k)
                            product *= a.correct ? right(shape, a.intensity, t) : 1 - right(shape, a.intensity, t);
                    }
                    likelihood[k].push_back(product);
                }
            }
            for (const double law : values_) {
                const double z = (law - s.guess) / s.guess_sd;
                double row = 0;
                for (const double t : values_) row += deviation_weight(t - law);
                for (size_t i = 0; i < values_.size(); ++i) {
                    for (size_t j = 0; j < values_.size(); ++j) {
                        const double weights = deviation_weight(values_[i] - law) * deviation_weight(values_[j] - law);
                        const double p =
                            std::exp(-z * z / 2) * weights / (row * row) * likelihood[0][i] * likelihood[1][j];
                        entries_.push_back({shape, law, {i, j}, p});
                        mass += p;
                    }
                }
            }
        }
        for (Entry& entry : entries_) entry.p /= mass;
    }

    struct Entry {
        size_t shape;
        double law;
        size_t at[2];  // grid points of the thresholds
        double p;
    };

    double mean(const std::function<double(const Entry&)>& f) const {
        double sum = 0;
        for (const Entry& entry : entries_) sum += entry.p * f(entry);
        return sum;
    }

    /// The variance of θ after either answer, each as likely as it is.
    double expected_variance(int track, double intensity) const {
        double mass[2]{}, first[2]{}, second[2]{};
        std::vector<double> rights;
        for (size_t shape = 0; shape < s_.shapes.size(); ++shape) {
            for (const double t : values_) rights.push_back(right(shape, intensity, t));
        }
        for (const Entry& e : entries_) {
            const double p = rights[e.shape * values_.size() + e.at[track]];
            for (const int y : {0, 1}) {
                const double share = e.p * (y == 1 ? p : 1 - p);
                mass[y] += share;
                first[y] += share * e.law;
                second[y] += share * e.law * e.law;
            }
        }
        double expected = 0;
        for (const int y : {0, 1}) {
            const double m = first[y] / mass[y];
            expected += mass[y] * (second[y] / mass[y] - m * m);
        }
        return expected;
    }

    const std::vector<double>& values() const { return values_; }

  private:
    double right(size_t shape, double x, double t) const {
        return probability_correct(s_.shapes[shape], threshold_offset(s_.shapes[shape]), x, t);
    }
    double deviation_weight(double e) const { return std::exp(-e * e / (2 * s_.deviation_sd * s_.deviation_sd)); }

    LawDirectedSettings s_;
    std::vector<double> values_;
    std::vector<Entry> entries_;
};

TEST(LawDirected, PosteriorEqualsTheEnumerationOfEverythingPossible) {
    const Enumeration all(small_settings(), some_answers());
    const LawDirected engine = after(small_settings(), some_answers());
    const double mean = all.mean([](const auto& e) { return e.law; });
    EXPECT_NEAR(engine.estimate().threshold, mean, 1e-12);
    EXPECT_NEAR(engine.estimate().sd,
                std::sqrt(all.mean([&](const auto& e) { return (e.law - mean) * (e.law - mean); })), 1e-12);
    // Below a bound in the middle of a cell lies half of the cell's mass and all before.
    for (const auto& [bound, order] : {std::pair{engine.estimate().low, 0.025}, {engine.estimate().high, 0.975}}) {
        EXPECT_NEAR(all.mean([&](const auto& e) { return std::clamp((bound - e.law) / 0.1 + 0.5, 0.0, 1.0); }), order,
                    1e-12);
    }
    for (const int k : {0, 1}) {
        const double m = all.mean([&](const auto& e) { return all.values()[e.at[k]]; });
        const double square = all.mean([&](const auto& e) { return std::pow(all.values()[e.at[k]] - m, 2); });
        EXPECT_NEAR(engine.track_estimate(k).threshold, m, 1e-12);
        EXPECT_NEAR(engine.track_estimate(k).sd, std::sqrt(square), 1e-12);
    }
}

TEST(LawDirected, PosteriorEqualsTheContinuousIntegral) {
    // p(θ)·Π_k ∫ L_k(θ + e)·N(e) de by the trapezoidal rule on a grid four times as fine, its ends not the engine's.
    const LawDirectedSettings settings{.tracks = 2, .guess = -0.2, .guess_sd = 0.3, .shapes = {PsychometricShape{}}};
    const LawDirected engine = after(settings, some_answers());
    const double offset = threshold_offset({}), h = 0.0025;
    double mass = 0, first = 0, second = 0;
    for (double law = -2.501; law < 2.1; law += h) {
        double p = std::exp(-(law + 0.2) * (law + 0.2) / (2 * 0.09));
        for (int k = 0; k < 2; ++k) {
            double integral = 0;
            for (double e = -7 * 0.04; e <= 7 * 0.04; e += h) {
                double product = std::exp(-e * e / (2 * 0.04 * 0.04));
                for (const auto& [track, x, correct] : some_answers()) {
                    if (track != k) continue;
                    const double right = probability_correct({}, offset, x, law + e);
                    product *= correct ? right : 1 - right;
                }
                integral += product;
            }
            p *= integral;
        }
        mass += p;
        first += p * law;
        second += p * law * law;
    }
    EXPECT_NEAR(engine.estimate().threshold, first / mass, 1e-6);
    EXPECT_NEAR(engine.estimate().sd, std::sqrt(second / mass - first * first / mass / mass), 1e-6);
}

TEST(LawDirected, ExpectedVarianceIsWhatItsNameSays) {
    const Enumeration all(small_settings(), some_answers());
    const LawDirected engine = after(small_settings(), some_answers());
    for (const int k : {0, 1}) {
        for (const double x : {-30.0, -0.7, -0.25, 0.0, 0.123, 0.6, 30.0}) {
            EXPECT_NEAR(engine.expected_variance(k, x), all.expected_variance(k, x), 1e-11) << k << ' ' << x;
        }
    }
}

TEST(LawDirected, SuggestsWhereTheExpectedVarianceIsSmallest) {
    std::vector<Answer> answers;
    for (const Answer& next : some_answers()) {
        const Enumeration all(small_settings(), answers);
        const LawDirected engine = after(small_settings(), answers);
        double smallest = 1e300;
        for (const int k : {0, 1}) {
            for (const double x : all.values()) smallest = std::min(smallest, all.expected_variance(k, x));
        }
        const auto [track, x] = engine.suggest();
        EXPECT_NEAR(all.expected_variance(track, x), smallest, 1e-11) << answers.size();
        answers.push_back(next);
    }
}

TEST(LawDirected, OnAFineGridNoIntensityIsMuchBetterThanTheSuggested) {
    // There the search takes steps of an eighth of the SD. On and off the grid, inside its window and outside.
    LawDirected engine({.guess = -0.5, .grain = 0.02, .range = 4});
    Random random(5);
    for (int trial = 0; trial < 25; ++trial) {
        const auto [track, x] = engine.suggest();
        const double variance = engine.estimate().sd * engine.estimate().sd;
        const double reduction = variance - engine.expected_variance(track, x);
        for (int k = 0; k < 4 && trial % 6 == 0; ++k) {
            for (double other = -2.503; other < 1.5; other += 0.1) {
                EXPECT_LE(variance - engine.expected_variance(k, other), reduction * 1.01) << trial << ' ' << other;
            }
        }
        engine.update(track, x, random.uniform() < probability_correct({}, threshold_offset({}), x, -0.54));
    }
}

TEST(LawDirected, WithoutDeviationsIsOneQuest) {
    const LawDirected engine = after({.tracks = 2, .guess = -0.3, .deviation_sd = 0, .shapes = {{}}}, some_answers());
    Quest quest({.guess = -0.3});
    for (const auto& [track, x, correct] : some_answers()) quest.update(x, correct);
    const ThresholdEstimate expected = quest.estimate();
    for (const ThresholdEstimate& e : {engine.estimate(), engine.track_estimate(0), engine.track_estimate(1)}) {
        EXPECT_NEAR(e.threshold, expected.threshold, 1e-12);
        EXPECT_NEAR(e.sd, expected.sd, 1e-12);
        EXPECT_NEAR(e.low, expected.low, 1e-12);
        EXPECT_NEAR(e.high, expected.high, 1e-12);
    }
}

TEST(LawDirected, WithBoundlessDeviationsLeavesEachTrackToItself) {
    const LawDirected engine = after({.tracks = 3, .guess = -0.3, .deviation_sd = 1e7, .shapes = {{}}}, some_answers());
    EXPECT_NEAR(engine.estimate().threshold, -0.3, 1e-9);  // the tracks say nothing of the law
    for (int k = 0; k < 3; ++k) {
        Quest quest({.guess = -0.3, .guess_sd = 1e7});  // flat on the grid, as the tracks' own prior is
        for (const auto& [track, x, correct] : some_answers()) {
            if (track == k) quest.update(x, correct);
        }
        EXPECT_NEAR(engine.track_estimate(k).threshold, quest.mean(), 1e-9) << k;
        EXPECT_NEAR(engine.track_estimate(k).sd, quest.sd(), 1e-9) << k;
    }
}

RC_GTEST_PROP(LawDirected, AnyAnswersInAnyOrderGiveOneSoundPosterior, ()) {
    const auto raw = *rc::gen::container<std::vector<std::tuple<int, int, bool>>>(
        rc::gen::tuple(rc::gen::inRange(0, 2), rc::gen::inRange(-3000, 3000), rc::gen::arbitrary<bool>()));
    std::vector<Answer> answers;
    for (const auto& [track, x, correct] : raw) answers.push_back({track, x / 1000.0, correct});
    const LawDirected engine = after(small_settings(), answers);
    std::reverse(answers.begin(), answers.end());
    const LawDirected reversed = after(small_settings(), answers);

    RC_ASSERT(engine.trials() == static_cast<int>(answers.size()));
    RC_ASSERT(engine.trials(0) + engine.trials(1) == engine.trials());
    for (const auto& [a, b] : {std::pair{engine.estimate(), reversed.estimate()},
                               {engine.track_estimate(0), reversed.track_estimate(0)},
                               {engine.track_estimate(1), reversed.track_estimate(1)}}) {
        RC_ASSERT(std::isfinite(a.threshold) && a.sd >= 0 && a.low <= a.high);
        RC_ASSERT(std::abs(a.threshold - b.threshold) < 1e-9 && std::abs(a.sd - b.sd) < 1e-9);
        RC_ASSERT(std::abs(a.low - b.low) < 1e-9 && std::abs(a.high - b.high) < 1e-9);
    }
    // Nobody expects to know less after an answer.
    const auto [track, x] = engine.suggest();
    RC_ASSERT(std::isfinite(x) && (track == 0 || track == 1));
    RC_ASSERT(engine.expected_variance(track, x) <= engine.estimate().sd * engine.estimate().sd);
}

TEST(LawDirected, IsAValue) {
    LawDirected original = after(small_settings(), some_answers());
    LawDirected copy = original;
    EXPECT_EQ(copy.suggest().intensity, original.suggest().intensity);
    EXPECT_EQ(copy.suggest().track, original.suggest().track);
    const ThresholdEstimate before = original.estimate();
    copy.update(0, 0.5, false);
    EXPECT_EQ(original.estimate().threshold, before.threshold);
    EXPECT_NE(copy.estimate().threshold, before.threshold);
    original.update(0, 0.5, false);
    EXPECT_EQ(copy.estimate().threshold, original.estimate().threshold);
    EXPECT_EQ(copy.estimate().sd, original.estimate().sd);
}

TEST(LawDirected, TracksThatAreAlikeTakeTurns) {
    LawDirected engine({.tracks = 3, .deviation_sd = 0, .shapes = {{}}, .grain = 0.05, .range = 4});
    Random random(2);
    for (int trial = 0; trial < 30; ++trial) {
        const auto [track, x] = engine.suggest();
        EXPECT_EQ(track, trial % 3);
        engine.update(track, x, random.uniform() < 0.8);
    }
}

TEST(LawDirected, NoOpenTrackIsLeftBehindAndClosedOnesRest) {
    // One observer guesses in one track alone; another sees everything in one track and nothing in the others.
    for (const bool guesses : {true, false}) {
        LawDirectedSettings settings{.grain = 0.05, .range = 4, .longest_lead = 4};
        settings.deviation_sd = 0.3;
        LawDirected engine(settings);
        Random random(3);
        for (int trial = 0; trial < 150; ++trial) {
            const bool open[]{true, trial < 60, true, true};
            const auto [track, x] = engine.suggest(open);
            ASSERT_TRUE(open[track]);
            const bool correct = guesses ? (track == 0 ? random.uniform() < 0.5 : x > -0.5) : track == 0;
            engine.update(track, x, correct);
            int fewest = 1000, most = 0;
            for (int k = 0; k < 4; ++k) {
                if (!open[k]) continue;
                fewest = std::min(fewest, engine.trials(k));
                most = std::max(most, engine.trials(k));
            }
            ASSERT_LE(most - fewest, 4);
        }
    }
}

TEST(LawDirected, StaysFiniteUnderContradictionsAndExtremes) {
    for (const double beta : {0.1, 3.5, 50.0}) {
        for (const double rate : {0.0, 0.01}) {
            for (const double deviation_sd : {0.0, 0.05, 1e6}) {
                const PsychometricShape shape{.beta = beta, .gamma = rate, .delta = rate, .p_threshold = 0.5};
                LawDirected engine({.tracks = 2, .deviation_sd = deviation_sd, .shapes = {shape}, .grain = 0.1});
                // Within a track, and between the two.
                for (int i = 0; i < 600; ++i) {
                    engine.update(i % 2, i % 2 == 0 ? -2 : 2, i % 2 == 0);
                    engine.update(i % 2, i % 3 == 0 ? 10 : -10, i % 3 != 0);
                    if (i % 50 != 0) continue;
                    const auto [track, x] = engine.suggest();
                    EXPECT_TRUE(std::isfinite(x));
                    EXPECT_TRUE(std::isfinite(engine.expected_variance(track, x)));
                    for (const ThresholdEstimate& e : {engine.estimate(), engine.track_estimate(0), engine.track_estimate(1)}) {
                        EXPECT_TRUE(std::isfinite(e.threshold) && std::isfinite(e.low) && std::isfinite(e.high));
                        EXPECT_GE(e.sd, 0) << beta << ' ' << rate << ' ' << deviation_sd;
                    }
                }
            }
        }
    }
}

TEST(LawDirected, TracksFarApartMeetInTheMiddle) {
    // 82 % right at −1 in one track and at 1 in the other: two thresholds 2 log units apart where σ is .05, e^−400 of the
    // density, and still a posterior. By the normal model it lies halfway with SD σ/√2.
    LawDirected engine({.tracks = 2, .guess_sd = 100, .deviation_sd = 0.05, .shapes = {{}}, .grain = 0.05});
    for (int i = 0; i < 4000; ++i) {
        engine.update(0, -1, i % 50 < 41);
        engine.update(1, 1, i % 50 < 41);
    }
    EXPECT_NEAR(engine.track_estimate(0).threshold, -1, 0.05);
    EXPECT_NEAR(engine.track_estimate(1).threshold, 1, 0.05);
    EXPECT_NEAR(engine.estimate().threshold, 0, 0.005);
    EXPECT_NEAR(engine.estimate().sd, 0.05 / std::sqrt(2.0), 0.001);
    EXPECT_TRUE(std::isfinite(engine.suggest().intensity));
}

TEST(LawDirected, HundredThousandTrialsFindTheLaw) {
    LawDirected engine({.tracks = 2, .deviation_sd = 0.05, .shapes = {{}}, .grain = 0.05, .range = 2});
    Random random(8);
    const double offset = threshold_offset({}), thresholds[]{-0.21, -0.19};
    for (int i = 0; i < 100'000; ++i) {
        const double x = -0.2 + (i % 7 - 2) * 0.05;
        engine.update(i % 2, x, random.uniform() < probability_correct({}, offset, x, thresholds[i % 2]));
    }
    EXPECT_EQ(engine.trials(), 100'000);
    EXPECT_NEAR(engine.estimate().threshold, -0.2, 0.005);
    EXPECT_NEAR(engine.estimate().sd, 0.05 / std::sqrt(2.0), 0.003);  // two deviations are all that is left unknown
    EXPECT_TRUE(std::isfinite(engine.suggest().intensity));
}

TEST(LawDirected, FindsPlantedLawsAsSurelyAsItSays) {
    // θ, deviations and slope drawn as the engine expects them: then the squared error in units of its own SD is 1 on
    // average (its SD over 50 observers is .2), and 95 % intervals hold.
    const LawDirectedSettings settings{.guess = -0.5, .guess_sd = 0.3, .grain = 0.05, .range = 3};
    double squares = 0, sd = 0;
    int covered = 0;
    for (uint64_t observer = 0; observer < 50; ++observer) {
        Random random = Random(21).stream(observer);
        const PsychometricShape& shape = settings.shapes[random.below(settings.shapes.size())];
        const double law = settings.guess + settings.guess_sd * random.normal();
        double thresholds[4];
        for (double& threshold : thresholds) threshold = law + settings.deviation_sd * random.normal();
        LawDirected engine(settings);
        for (int trial = 0; trial < 50; ++trial) {
            const auto [track, x] = engine.suggest();
            const double p = probability_correct(shape, threshold_offset(shape), x, thresholds[track]);
            engine.update(track, x, random.uniform() < p);
        }
        const ThresholdEstimate found = engine.estimate();
        squares += std::pow((found.threshold - law) / found.sd, 2) / 50;
        sd += found.sd / 50;
        covered += found.low <= law && law <= found.high;
    }
    EXPECT_NEAR(squares, 1, 0.6);
    EXPECT_GE(covered, 43);
    EXPECT_LT(sd, 0.08);
}

TEST(LawDirected, RefusesImpossibleSettings) {
    EXPECT_THROW(LawDirected({.tracks = 0}), InputError);
    EXPECT_THROW(LawDirected({.tracks = 1001}), InputError);
    EXPECT_THROW(LawDirected({.guess = NAN}), InputError);
    EXPECT_THROW(LawDirected({.guess_sd = 0}), InputError);
    EXPECT_THROW(LawDirected({.deviation_sd = -0.1}), InputError);
    EXPECT_THROW(LawDirected({.deviation_sd = 0.001}), InputError);
    EXPECT_THROW(LawDirected({.deviation_sd = NAN}), InputError);
    EXPECT_THROW(LawDirected({.shapes = {}}), InputError);
    EXPECT_THROW(LawDirected({.shapes = {{.beta = -1}}}), InputError);
    EXPECT_THROW(LawDirected({.shapes = {{.p_threshold = 0.82}, {.p_threshold = 0.8}}}), InputError);
    EXPECT_THROW(LawDirected({.grain = 0}), InputError);
    EXPECT_THROW(LawDirected({.grain = 1e-6}), InputError);
    EXPECT_THROW(LawDirected({.longest_lead = 0}), InputError);
}

}  // namespace
}  // namespace stairstep
