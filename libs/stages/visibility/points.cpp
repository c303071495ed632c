#include "stages/visibility/points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "math/interop_vec.h"
#include "math/subdivision.h"

namespace vsgl::visibility {
namespace {

// Patches, addressed by a share of their total weight.
struct ShareTable {
  std::vector<double> end;            // summed weight up to and including each patch
  std::vector<std::uint32_t> bucket;  // first patch of each of bucket.size() - 1 equal shares

  double total() const { return end.back(); }
};

ShareTable build_share_table(const std::vector<double>& weights) {
  ShareTable table;
  table.end.resize(weights.size());
  std::partial_sum(weights.begin(), weights.end(), table.end.begin());
  const std::size_t buckets = std::clamp<std::size_t>(table.end.size(), 1, std::size_t{1} << 16);
  table.bucket.resize(buckets + 1);
  for (std::size_t b = 0; b <= buckets; ++b) {
    const double share = table.total() * static_cast<double>(b) / static_cast<double>(buckets);
    const auto at = std::upper_bound(table.end.begin(), table.end.end(), share);
    table.bucket[b] =
        static_cast<std::uint32_t>(std::min<std::size_t>(at - table.end.begin(), table.end.size() - 1));
  }
  return table;
}

// The patch that holds the share s in [0,1) of the weight, and how far into it, 0..1.
std::pair<std::size_t, double> locate(const ShareTable& table, double s) {
  const double target = s * table.total();
  const auto b = static_cast<std::size_t>(s * static_cast<double>(table.bucket.size() - 1));
  const auto first = table.end.begin() + table.bucket[b];
  const auto last = table.end.begin() + table.bucket[b + 1];  // the answer is in [first, last]
  const std::size_t j = std::upper_bound(first, last, target) - table.end.begin();
  const double start = j == 0 ? 0 : table.end[j - 1];
  return {j, std::clamp((target - start) / (table.end[j] - start), 0.0, 1.0)};
}

// A well mixed hash of a counter (the finaliser of splitmix64), as a number in [0,1).
double hash_unit(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

// Whether the material is cut out at these texture coordinates (nearest texel, repeated).
bool is_hole(const scene::Scene& scene, const scene::Material& material, double u, double v) {
  if (material.alpha_cutoff <= 0 || material.base_color_texture < 0) return false;
  const auto& texture = scene.textures[material.base_color_texture];
  const auto texel = [](double t, int size) {
    return std::min(static_cast<int>((t - std::floor(t)) * size), size - 1);
  };
  const std::size_t pixel =
      static_cast<std::size_t>(texel(v, texture.height)) * texture.width + texel(u, texture.width);
  return texture.rgba[4 * pixel + 3] / 255.0 < material.alpha_cutoff;
}

// [Ritschel 2008] points on the surfaces, at random there.
// Deviation: point k takes the share frac(k phi) of the weight, phi the golden ratio, so that any run of
// consecutive points is stratified over the patches. Inside its patch one coordinate is the residual of that
// share, the other a hash: a second Kronecker coordinate would put the points of one patch on a few lines.
// `radius`: of the points of each patch, m.
interop::SplatPoint make_point(const scene::Scene& scene, const std::vector<Patch>& patches,
                               const ShareTable& table, std::uint64_t k, std::uint64_t seed,
                               const std::vector<float>& radius) {
  const std::uint64_t fraction = k * 0x9E3779B97F4A7C15u;  // 2^64 frac(k phi)
  const auto [j, r1] = locate(table, static_cast<double>(fraction >> 11) * 0x1p-53);
  const Patch& patch = patches[j];
  const double root = std::sqrt(r1);
  const double r2 = hash_unit(k + seed * max_pool_size);
  const Vec3 weights = subdivision_point(patch.side, patch.cell, {root * (1 - r2), root * r2});
  const Corners corners = corners_of(scene, patch.instance, patch.first_index);
  Vec3 position;
  double u = 0, v = 0;
  for (const auto& [corner, weight] :
       {std::pair{corners[0], weights.x}, {corners[1], weights.y}, {corners[2], weights.z}}) {
    position += weight * position_of(*corner);
    u += weight * static_cast<double>(corner->uv[0]);
    v += weight * static_cast<double>(corner->uv[1]);
  }
  const bool hole = is_hole(scene, scene.materials[scene.instances[patch.instance].material], u, v);
  return {to_float(position), hole ? 0.0f : radius[j], to_float(normalise(area_vector(corners))), 0.0f};
}

}  // namespace

PointPool sample_points(const scene::Scene& scene, const std::vector<Patch>& patches,
                        const std::vector<double>& weights, std::size_t light_count, int points_per_light,
                        std::uint64_t seed) {
  const ShareTable table = build_share_table(weights);
  PointPool pool;
  for (const Patch& patch : patches) pool.area += patch.area;
  pool.disk_radius = std::sqrt(pool.area / (std::numbers::pi * points_per_light));
  std::vector<float> radius;
  for (std::size_t j = 0; j < patches.size(); ++j)
    radius.push_back(static_cast<float>(
        pool.disk_radius * std::sqrt(patches[j].area / pool.area / (weights[j] / table.total()))));
  const std::size_t size = std::min(max_pool_size, light_count * static_cast<std::size_t>(points_per_light));
  pool.points.resize(size);
  std::size_t holes = 0;
#pragma omp parallel for schedule(static) reduction(+ : holes)
  for (std::size_t k = 0; k < size; ++k) {
    pool.points[k] = make_point(scene, patches, table, k, seed, radius);
    if (pool.points[k].radius == 0.0f) ++holes;
  }
  pool.holes = holes;
  return pool;
}

}  // namespace vsgl::visibility
