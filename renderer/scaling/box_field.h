// A scene of any number of triangles that looks the same with all of them: boxes on a ground and above it, whose faces are
// flat however finely they are divided.
//
// Each face has cells × cells squares of two triangles, so that
//
//   triangles = kBoxes · 12 · cells² + 2      the last two are the ground's
//
// cells = 1 has 1,010 triangles, cells = 31 has 968,690.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene.h"

namespace stairstep::scaling {

inline constexpr int kBoxes = 84;

/// Appends a closed box around the origin of its own space, its faces divided; neighbouring faces share their vertices' places to
/// the bit. cells ≥ 1.
void append_divided_box(Mesh& mesh, const glm::dvec3& half_size, const glm::dmat4& world_from_box, int cells);

/// The cells that bring the number of triangles closest to this one, by ratio; ≥ 1.
int cells_for(double triangles);

/// The same boxes at every call, within 16 m of the origin on a ground at height 0. cells ≥ 1.
Scene make_box_field(int cells);

}  // namespace stairstep::scaling
