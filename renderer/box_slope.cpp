#include "renderer/box_slope.h"

#include "stimuli/error.h"

namespace stairstep {

double box_slope(const Law& law, const std::string& source, bool convert_kernel) {
    if (law.kernel == KernelShape::box) return law.slope;
    if (!convert_kernel) {
        throw InputError(source, "is a law for the kernel " + std::string(name(law.kernel)) + ", the filter is a box",
                         "use a law for box, or --convert-kernel to convert it by equal variance");
    }
    return slope_for_kernel(law, KernelShape::box);
}

}  // namespace stairstep
