#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace vsgl::visibility {

// A cell of a triangle that is cut into side^2 of them (math/subdivision.h).
struct Patch {
  std::uint32_t instance, first_index;
  std::uint32_t side = 1, cell = 0;
  double area;  // m^2, positive
};

using Corners = std::array<const scene::Vertex*, 3>;
Corners corners_of(const scene::Scene& scene, std::uint32_t instance, std::uint32_t first_index);
Vec3 position_of(const scene::Vertex& vertex);
// Twice the area times the normal.
Vec3 area_vector(const Corners& corners);

// All triangles that have an area, cut so that no patch exceeds `largest` (m^2) by much; scene order. Throws
// mesh_invalid when there is none.
std::vector<Patch> make_patches(const scene::Scene& scene,
                                double largest = std::numeric_limits<double>::infinity());
std::vector<double> areas_of(const std::vector<Patch>& patches);

}  // namespace vsgl::visibility
