// An adaptive engine for the law itself: it runs one observer's tracks together and asks next what tells most about c.
//
// The study wants c in r = c·a, not the threshold of one texel size. In x = log10(a/r) the law gives every track the same
// threshold, θ = −log10 c; a real observer's track k deviates from it:
//
//   T_k = θ + e_k,   e_k ~ N(0, σ_e²),   θ ~ N(guess, guess_sd²)
//   p(θ, s | answers) ∝ p(θ)·p(s)·Π_k ∫ L_k(θ + e; s)·N(e; 0, σ_e²) de
//
// with L_k the product of Ψ or 1 − Ψ (study/psychometric.h) at what was really shown in track k, and s the shape of the
// observer's psychometric function, one of a few (`shapes`), equally likely beforehand and summed over: an observer
// has one slope, alike for all texel sizes, and nobody knows it. Everything lives on a grid, as logarithms; after an
// answer only track k's L_k and its integral change (study/engines/deviation_kernel.h).
//
// The next trial is the track and the intensity after whose answer the variance of θ is expected smallest. For a yes/no
// outcome y that expectation has a closed form (the law of total variance, E[θ|y] being linear in y):
//
//   E[Var(θ | answers, y)] = Var θ − Cov(θ, y)²/(P·(1 − P)),   P = P(y = 1), all under the posterior.
//
// It is computed exactly on the grid, for every open track and for intensities that cover two of the track's posterior SDs
// on either side. Ties go to the track with the fewest trials, then to the lowest index; so everything is deterministic. No
// open track is ever more than `longest_lead` trials ahead of another open one. With σ_e = 0 all tracks are one, and they
// take turns; a large σ_e leaves each track to itself.
//
// σ_e: by default .04, the deviation of single thresholds, 10 % of the radius, that the study's statistics are planned with
// (.10 in ln r is .0434 in log10 r), and a little less than the SD of .05 at which a track is called converged: smaller
// deviations could hardly be told from none, and larger ones would show in a single observer's tracks.
//
// What it gains, and what it doesn't, is measured in study/engines/law_directed_gain.h. A trial (suggest and update) with 4
// tracks, 501 points and the usual shapes takes 1 ms on average and at most 2 to 3; with one fixed shape 0.15 ms; where
// σ_e is .3 or more, and tracks say little of each other, 4 to 8 ms.
#pragma once

#include <span>
#include <vector>

#include "study/engines/deviation_kernel.h"
#include "study/engines/estimate.h"
#include "study/psychometric.h"

namespace stairstep {

/// Slopes of 2, 3.5 and 6 about QUEST's 3.5, each with lapse rates of .01 and .06; γ = .5, p_T = .82. Five slopes (1.75 to 7)
/// gave the same errors and coverage in simulation, for 1.7 times the time.
std::vector<PsychometricShape> usual_shapes();

struct LawDirectedSettings {
    /// Texel sizes of the round, 1 to 1000.
    int tracks = 4;
    /// Prior of θ: normal with this mean and standard deviation, log10 units; guess_sd > 0.
    double guess = 0;
    double guess_sd = 0.5;
    /// σ_e, log10 units: 0, or at least half a grain.
    double deviation_sd = 0.04;
    /// What the observer's psychometric function may be: at least one, all with one p_threshold. One alone is a fixed slope,
    /// and faster; but with a wrong one 95 % intervals cover much less.
    std::vector<PsychometricShape> shapes = usual_shapes();
    /// Grid spacing and full width around the guess, log10 units; grain > 0, range > 2·grain, at most 10⁴ points. Intensities
    /// that are suggested lie on the grid, or on its continuation by its own width: the grain should be a small part
    /// of the psychometric function's width, 1/β.
    double grain = 0.01;
    double range = 5;
    /// The most trials by which one open track may be ahead of another, ≥ 1.
    int longest_lead = 10;
};

class LawDirected {
  public:
    struct Suggestion {
        /// From 0.
        int track = 0;
        /// x = log10(texel_px/radius_px).
        double intensity = 0;
    };

    /// Throws InputError naming a setting that is out of its range.
    explicit LawDirected(const LawDirectedSettings& settings);

    /// The trial to run next, among all tracks or among those that are `open` (one entry a track, at least one true).
    Suggestion suggest() const;
    Suggestion suggest(std::span<const bool> open) const;

    /// Takes in an answer given in a track at a finite intensity, suggested or not, on the grid or off it.
    void update(int track, double intensity, bool correct);

    /// θ = −log10 c.
    const ThresholdEstimate& estimate() const { return law_; }
    /// T_k, with what the other tracks say of it.
    ThresholdEstimate track_estimate(int track) const;

    /// E[Var θ] after one more answer in the track at a finite intensity: what suggest() makes smallest.
    double expected_variance(int track, double intensity) const;

    int tracks() const { return static_cast<int>(tracks_.size()); }
    int trials() const { return trials_; }
    int trials(int track) const { return tracks_[static_cast<size_t>(track)].trials; }

  private:
    /// One track; arrays hold one block of grid points a shape.
    struct Track {
        int trials = 0;
        /// ln L_k, and its integral over the deviation, up to one constant for both.
        std::vector<double> log_likelihood;
        std::vector<double> log_evidence;
    };
    /// The posterior of a track's threshold and what the law's θ has to do with it, one shape.
    struct Joint {
        size_t shape;
        /// Grid point of the first entry.
        size_t first;
        /// P(t_j), and E[θ − mean; t_j].
        std::vector<double> mass;
        std::vector<double> moment;
    };
    struct Candidate {
        double reduction = 0;
        double intensity = 0;
    };

    double value_at(size_t i) const { return first_value_ + static_cast<double>(i) * grain_; }
    void refresh_posterior();
    std::vector<Joint> joint_with_law(size_t track) const;
    Candidate best_candidate(const std::vector<Joint>& joints) const;

    std::vector<PsychometricShape> shapes_;
    std::vector<double> offsets_;
    DeviationKernel kernel_;
    double first_value_;
    double grain_;
    double placement_;
    int longest_lead_;
    std::vector<double> log_prior_;
    /// Ψ where the threshold lies (index − middle)·grain above the intensity, middle = 2·points − 1; one block a shape.
    std::vector<double> psi_;
    std::vector<Track> tracks_;
    /// P(θ_i, shape).
    std::vector<double> posterior_;
    ThresholdEstimate law_;
    int trials_ = 0;
};

}  // namespace stairstep
