#include "renderer/light.h"

#include <cassert>

namespace stairstep {

Light spot_light(const glm::dvec3& position, const glm::dvec3& target, double half_side, double cone_deg) {
    const glm::dvec3 back = position - target;
    assert(glm::length(back) > 0);
    return {Light::Kind::spot, basis_towards(direction_of(back)), position, half_side, 1, cone_deg};
}

}  // namespace stairstep
