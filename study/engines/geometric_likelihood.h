// Products along a grid on which u, the Weibull function's 10^{β(x − T + ε)}, is a geometric sequence: the inner loops of
// QUEST. A likelihood is linear in e^{−u}, so a factor a + b·e^{−u} is all there is to compute, and how depends on u alone.
//
// Two points at a time, and without the standard library's exp: the same numbers on every machine. Relative error of the factors: a few 10⁻¹⁶.
#pragma once

#include <cstddef>

namespace stairstep {

/// u at point i is scale·power[i].
struct GeometricSequence {
    double scale = 1;
    const double* power = nullptr;
};

/// factor[i] *= a + b·e^{−u}, i = begin … end − 1, for u from 0 to 700.
void multiply_by_exponential(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b);

/// factor[i] *= a + b·(1 − e^{−u}), which keeps its digits where u is small and a is 0. u up to 0.07.
void multiply_by_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b);

/// The same, faster, for u up to 10⁻³ and up to 10⁻⁶.
void multiply_by_small_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b);
void multiply_by_tiny_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b);

}  // namespace stairstep
