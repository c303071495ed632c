#include "stages/visibility/points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace vsgl::visibility {
namespace {

struct Triangle {
  std::uint32_t instance, first_index;
};

// The triangles of a scene, addressed by a share of their total area.
struct AreaTable {
  std::vector<Triangle> triangles;
  std::vector<double> end;            // summed area up to and including each triangle, m^2
  std::vector<std::uint32_t> bucket;  // first triangle of each of bucket.size() - 1 equal shares of the area

  double total() const { return end.back(); }
};

Vec3 position_of(const scene::Vertex& v) {
  return {v.position[0], v.position[1], v.position[2]};
}

const scene::Vertex& corner(const scene::Instance& instance, std::uint32_t first_index, int i) {
  return instance.vertices[instance.indices[first_index + i]];
}

// Twice the area times the normal.
Vec3 area_vector(const scene::Instance& instance, std::uint32_t first_index) {
  const Vec3 a = position_of(corner(instance, first_index, 0));
  return cross(position_of(corner(instance, first_index, 1)) - a,
               position_of(corner(instance, first_index, 2)) - a);
}

AreaTable build_area_table(const scene::Scene& scene) {
  AreaTable table;
  double sum = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const auto& instance = scene.instances[i];
    for (std::uint32_t first = 0; first + 2 < instance.indices.size(); first += 3) {
      const double area = length(area_vector(instance, first)) / 2;
      if (area <= 0) continue;  // degenerate: no point can fall on it
      sum += area;
      table.triangles.push_back({i, first});
      table.end.push_back(sum);
    }
  }
  if (!(sum > 0) || !std::isfinite(sum))
    throw Error(ErrorCode::mesh_invalid,
                "scene: no surface to cast a shadow; give it a mesh with triangles of non-zero area");
  const std::size_t buckets = std::clamp<std::size_t>(table.end.size(), 1, std::size_t{1} << 16);
  table.bucket.resize(buckets + 1);
  for (std::size_t b = 0; b <= buckets; ++b) {
    const double share = sum * static_cast<double>(b) / static_cast<double>(buckets);
    const auto at = std::upper_bound(table.end.begin(), table.end.end(), share);
    table.bucket[b] =
        static_cast<std::uint32_t>(std::min<std::size_t>(at - table.end.begin(), table.end.size() - 1));
  }
  return table;
}

// The triangle that holds the share s in [0,1) of the area, and how far into it, 0..1.
std::pair<std::size_t, double> locate(const AreaTable& table, double s) {
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
// Deviation: point k takes the share frac(k phi) of the area, phi the golden ratio, so that any run of
// consecutive points is stratified over the triangles. Inside its triangle one coordinate is the residual of
// that share, the other a hash: a second Kronecker coordinate would put the points of one triangle on a few
// lines.
interop::SplatPoint make_point(const scene::Scene& scene, const AreaTable& table, std::uint64_t k,
                               std::uint64_t seed, double radius) {
  const std::uint64_t fraction = k * 0x9E3779B97F4A7C15u;  // 2^64 frac(k phi)
  const auto [j, r1] = locate(table, static_cast<double>(fraction >> 11) * 0x1p-53);
  const auto [index, first] = table.triangles[j];
  const auto& instance = scene.instances[index];
  const double root = std::sqrt(r1);
  const double r2 = hash_unit(k + seed * max_pool_size);
  const double weight[3] = {1 - root, root * (1 - r2), root * r2};
  Vec3 position;
  double u = 0, v = 0;
  for (int i = 0; i < 3; ++i) {
    const auto& vertex = corner(instance, first, i);
    position += weight[i] * position_of(vertex);
    u += weight[i] * static_cast<double>(vertex.uv[0]);
    v += weight[i] * static_cast<double>(vertex.uv[1]);
  }
  const Vec3 normal = normalise(area_vector(instance, first));
  const bool hole = is_hole(scene, scene.materials[instance.material], u, v);
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(position.x), f(position.y), f(position.z)},
          hole ? 0.0f : f(radius),
          {f(normal.x), f(normal.y), f(normal.z)},
          0.0f};
}

}  // namespace

PointPool sample_points(const scene::Scene& scene, std::size_t light_count, int points_per_light,
                        std::uint64_t seed) {
  const AreaTable table = build_area_table(scene);
  PointPool pool;
  pool.area = table.total();
  pool.disk_radius = std::sqrt(pool.area / (std::numbers::pi * points_per_light));
  const std::size_t size = std::min(max_pool_size, light_count * static_cast<std::size_t>(points_per_light));
  pool.points.resize(size);
  std::size_t holes = 0;
#pragma omp parallel for schedule(static) reduction(+ : holes)
  for (std::size_t k = 0; k < size; ++k) {
    pool.points[k] = make_point(scene, table, k, seed, pool.disk_radius);
    if (pool.points[k].radius == 0.0f) ++holes;
  }
  pool.holes = holes;
  return pool;
}

}  // namespace vsgl::visibility
