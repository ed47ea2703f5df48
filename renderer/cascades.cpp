#include "renderer/cascades.h"

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {

Splits splits_named(const std::string& name) {
    if (name == "uniform") return Splits::uniform;
    if (name == "logarithmic") return Splits::logarithmic;
    if (name == "practical") return Splits::practical;
    throw InputError("--splits", "\"" + name + "\" is no way to split a view",
                     "use one of uniform, logarithmic, practical");
}

std::vector<double> split_distances(double near, double far, const Cascades& cascades) {
    std::vector<double> borders;
    for (int i = 0; i <= cascades.count; ++i) {
        const double share = static_cast<double>(i) / cascades.count;
        const double uniform = near + share * (far - near);
        const double logarithmic = near * std::pow(far / near, share);
        switch (cascades.splits) {
            case Splits::uniform: borders.push_back(uniform); break;
            case Splits::logarithmic: borders.push_back(logarithmic); break;
            case Splits::practical: borders.push_back((uniform + logarithmic) / 2); break;
        }
    }
    borders.front() = near;
    borders.back() = far;
    return borders;
}

}  // namespace stairstep
