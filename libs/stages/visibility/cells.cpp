#include "stages/visibility/cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "math/interop_vec.h"
#include "stages/visibility/patches.h"

namespace vsgl::visibility {
namespace {

constexpr double kBlockSide = 32;
// Points from which on a triangle is cut into one block each: rounding their number to a square then changes
// it by a quarter at most.
constexpr double kLeastBlocks = 16;
static_assert(interop::CELLS_PER_POINT == kBlockSide * kBlockSide);

// The cut-outs of a scene's materials as bits.
class MaskPacker {
 public:
  MaskPacker(const scene::Scene& scene, std::vector<std::uint32_t>& words) : scene_(scene), words_(words) {}

  void describe(std::uint32_t material, interop::CellTriangle& triangle) {
    const scene::Material& m = scene_.materials[material];
    if (m.alpha_cutoff <= 0 || m.base_color_texture < 0) return;
    const scene::Texture& texture = scene_.textures[m.base_color_texture];
    const auto [at, is_new] = firsts_.try_emplace(material, static_cast<std::uint32_t>(words_.size()));
    if (is_new) append(texture, m.alpha_cutoff);
    triangle.mask = at->second;
    triangle.mask_width = static_cast<std::uint32_t>(texture.width);
    triangle.mask_height = static_cast<std::uint32_t>(texture.height);
  }

 private:
  void append(const scene::Texture& texture, double cutoff) {
    const std::size_t first = words_.size(), texels = texture.rgba.size() / 4;
    words_.resize(first + (texels + 31) / 32);
    for (std::size_t i = 0; i < texels; ++i)
      if (texture.rgba[4 * i + 3] / 255.0 >= cutoff) words_[first + i / 32] |= 1U << i % 32;
  }

  const scene::Scene& scene_;
  std::vector<std::uint32_t>& words_;
  std::map<std::uint32_t, std::uint32_t> firsts_;  // of each material
};

// `share`: the triangle's area over that of a point.
interop::CellTriangle make_triangle(const Corners& corners, double area, double share) {
  const auto uv = [&](std::size_t i) { return interop::vec2{corners[i]->uv[0], corners[i]->uv[1]}; };
  const bool blocks = share >= kLeastBlocks;
  interop::CellTriangle out{};
  out.a = to_float(position_of(*corners[0]));
  out.b = to_float(position_of(*corners[1]));
  out.c = to_float(position_of(*corners[2]));
  out.uv_a = uv(0);
  out.uv_b = uv(1);
  out.uv_c = uv(2);
  const double outer = blocks ? std::round(std::sqrt(share)) : 1;
  const double inner = blocks ? kBlockSide : std::max(std::round(kBlockSide * std::sqrt(share)), 1.0);
  const double side = outer * inner / kBlockSide;  // in those of a point's piece
  out.outer_side = static_cast<std::uint32_t>(outer);
  out.inner_side = static_cast<std::uint32_t>(inner);
  out.radius = static_cast<float>(std::sqrt(area / (side * side * std::numbers::pi)));
  return out;
}

std::uint64_t cell_count(const interop::CellTriangle& triangle) {
  const std::uint64_t side = std::uint64_t{triangle.outer_side} * triangle.inner_side;
  return side * side;
}

}  // namespace

Cells make_cells(const scene::Scene& scene, int points_per_light) {
  std::vector<Patch> order = make_patches(scene);
  double area = 0;
  for (const Patch& triangle : order) area += triangle.area;
  const double piece = area / points_per_light;
  std::stable_partition(order.begin(), order.end(), [&](const Patch& t) { return t.area >= kLeastBlocks * piece; });
  Cells cells;
  cells.disk_radius = std::sqrt(piece / std::numbers::pi);
  MaskPacker masks(scene, cells.masks);
  std::uint64_t count = 0;
  for (const Patch& t : order) {
    auto triangle = make_triangle(corners_of(scene, t.instance, t.first_index), t.area, t.area / piece);
    masks.describe(scene.instances[t.instance].material, triangle);
    cells.starts.push_back(static_cast<std::uint32_t>(count));
    count += cell_count(triangle);
    if (count > 0xFFFFFFFF - interop::CELLS_PER_POINT)
      throw Error(ErrorCode::out_of_range,
                  "points: " + std::to_string(points_per_light) +
                      " a light cut this scene into more than 2^32 cells; use fewer");
    cells.triangles.push_back(triangle);
  }
  cells.count = static_cast<std::uint32_t>(count);
  return cells;
}

}  // namespace vsgl::visibility
