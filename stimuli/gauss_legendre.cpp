#include "stimuli/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace stairstep {

QuadratureRule gauss_legendre(size_t count, double low, double high) {
    QuadratureRule rule;
    const double n = static_cast<double>(count);
    for (size_t k = 0; k < count; ++k) {
        double x = -std::cos(std::numbers::pi * (static_cast<double>(k) + 0.75) / (n + 0.5));
        double slope = 1;
        for (int iteration = 0; iteration < 8; ++iteration) {
            double previous = 0, p = 1;
            for (double j = 1; j <= n; ++j) {
                const double next = ((2 * j - 1) * x * p - (j - 1) * previous) / j;
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            x -= p / slope;
        }
        rule.nodes.push_back((low + high) / 2 + (high - low) / 2 * x);
        rule.weights.push_back((high - low) / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace stairstep
