// How far a proportion can be trusted: Wilson's score interval (1927).
//
//   (k + z²/2 ± z·√(k(n − k)/n + z²/4))/(n + z²),   z = 1.959964
//
// All π that a normal approximation of k under π doesn't reject; lies within [0, 1], and has a width also where all answers are
// alike. Its coverage is near 95 % on average, where the textbook's p ± z·√(p(1 − p)/n) is far below (Agresti & Coull 1998).
//
// Anchors: 5 of 10 → [.2366, .7634]; 0 of 10 → [0, .2775].
#pragma once

#include <utility>

namespace stairstep {

/// 95 %, of `successes` in `trials` > 0, 0 ≤ successes ≤ trials (asserted).
std::pair<double, double> binomial_interval(double successes, double trials);

}  // namespace stairstep
