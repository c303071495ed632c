#include "stages/visibility/patches.h"

#include <cmath>

#include "base/error.h"

namespace vsgl::visibility {

Corners corners_of(const scene::Scene& scene, std::uint32_t instance, std::uint32_t first_index) {
  const scene::Instance& from = scene.instances[instance];
  const auto corner = [&](std::uint32_t i) { return &from.vertices[from.indices[first_index + i]]; };
  return {corner(0), corner(1), corner(2)};
}

Vec3 position_of(const scene::Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

Vec3 area_vector(const Corners& corners) {
  const Vec3 a = position_of(*corners[0]);
  return cross(position_of(*corners[1]) - a, position_of(*corners[2]) - a);
}

std::vector<Patch> make_patches(const scene::Scene& scene, double largest) {
  std::vector<Patch> patches;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    for (std::uint32_t first = 0; first + 2 < scene.instances[i].indices.size(); first += 3) {
      const double area = length(area_vector(corners_of(scene, i, first))) / 2;
      if (!std::isfinite(area))
        throw Error(ErrorCode::mesh_invalid, "scene: a triangle's area is not finite; check its vertices");
      if (area <= 0) continue;  // degenerate: no point can fall on it
      const auto side = static_cast<std::uint32_t>(std::max(std::ceil(std::sqrt(area / largest)), 1.0));
      for (std::uint32_t cell = 0; cell < side * side; ++cell)
        patches.push_back({i, first, side, cell, area / side / side});
    }
  if (patches.empty())
    throw Error(ErrorCode::mesh_invalid,
                "scene: no surface to cast a shadow; give it a mesh with triangles of non-zero area");
  return patches;
}

std::vector<double> areas_of(const std::vector<Patch>& patches) {
  std::vector<double> areas;
  areas.reserve(patches.size());
  for (const Patch& patch : patches) areas.push_back(patch.area);
  return areas;
}

}  // namespace vsgl::visibility
