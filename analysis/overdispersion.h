// Answers that vary more than independent ones would: the beta-binomial likelihood of Schuett et al. (2016).
//
// The n answers of a block (same strength, nothing else changed) share a probability that is itself beta distributed
// around Ψ: with ν = 1/η² − 1, k right answers have the likelihood
//
//   B(k + Ψν, n − k + (1 − Ψ)ν)/B(Ψν, (1 − Ψ)ν) = Π_{j<k}(Ψν + j)·Π_{j<n−k}((1 − Ψ)ν + j)/Π_{j<n}(ν + j)
//
// η in [0, 1), 0 for independent answers; its prior is Beta(1, 10), as in psignifit 4.
//
// What a block is here: all trials of a track at the same strength. Constant stimuli come in such blocks. An adaptive track
// shows almost every strength once, and one answer is as likely under any η: such a track says nothing about η, its posterior is
// the prior and T's is the same as without. It would take a grouping by time to see an observer drift there, and along an adaptive
// track time goes with strength. So the option is for blocked data, and does no harm elsewhere.
//
// Anchors: n = 1 gives Ψ or 1 − Ψ whatever η; Ψ = ½, ν = 2 makes all k from 0 to n equally likely, 1/(n + 1) by order.
#pragma once

namespace stairstep {

/// ln of the likelihood of one sequence with `right` right and `wrong` wrong answers. psi in (0, 1), eta in [0, 1).
double beta_binomial_log_likelihood(double right, double wrong, double psi, double eta);

/// ln of the density of Beta(1, 10) at eta in [0, 1).
double log_overdispersion_prior(double eta);

}  // namespace stairstep
