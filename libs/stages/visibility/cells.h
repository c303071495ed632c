#pragma once

#include <cstdint>
#include <vector>

#include "interop/splat.h"
#include "scene/scene.h"

namespace vsgl::visibility {

// The triangles of a scene cut into cells of nearly equal area, of which CELLS_PER_POINT in a row share a
// point, another one for each light. Those that get several points come first, as whole blocks of
// CELLS_PER_POINT; of the others a point's cells lie in as many as it takes.
struct Cells {
  std::vector<std::uint32_t> starts;  // first cell of each triangle
  std::vector<interop::CellTriangle> triangles;
  std::vector<std::uint32_t> masks;  // of cut-outs, a bit a texel, row by row: 1 = opaque
  std::uint32_t count = 0;
  double disk_radius = 0;  // of a point when `points_per_light` equal disks tile the area, m

  std::uint32_t points_per_light() const {
    return (count + interop::CELLS_PER_POINT - 1) / interop::CELLS_PER_POINT;
  }
};

// About `points_per_light` points a light, more where triangles are many and tiny. Throws mesh_invalid where
// nothing has an area, out_of_range for more than 2^32 cells.
Cells make_cells(const scene::Scene& scene, int points_per_light);

}  // namespace vsgl::visibility
