#include "math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace vsgl {
namespace {

constexpr double kBelowOne = 1.0 - 0x1p-24;

std::uint32_t fraction_bits(std::uint64_t numerator, std::uint64_t denominator) {
  return static_cast<std::uint32_t>((numerator << 32) / denominator);
}

std::uint32_t golden_bits(std::uint32_t i) {
  return static_cast<std::uint32_t>((i * 0x9E3779B97F4A7C15ull) >> 32);
}

// Chooses between two weights and stretches u over the chosen part: 0 or 1.
int choose(double first, double second, double& u) {
  const double sum = first + second;
  const double share = sum > 0 ? first / sum : 0.5;
  const bool take_first = u < share;
  u = std::min(take_first ? u / share : (u - share) / (1 - share), kBelowOne);
  return take_first ? 0 : 1;
}

std::size_t choose_layer(std::span<const DensityPyramid> layers, double& u) {
  double sum = 0;
  for (const DensityPyramid& layer : layers) sum += layer.mean();
  double rest = u * sum;
  std::size_t chosen = layers.size();
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (layers[k].mean() <= 0) continue;
    if (chosen < layers.size()) rest -= layers[chosen].mean();
    chosen = k;
    if (rest < layers[k].mean()) break;
  }
  if (chosen == layers.size()) throw Error(ErrorCode::internal, "warp: every density is zero");
  u = std::clamp(rest / layers[chosen].mean(), 0.0, kBelowOne);
  return chosen;
}

}  // namespace

std::vector<float> mean_pyramid(std::span<const float> level0, int size) {
  std::vector<float> pyramid(level0.begin(), level0.end());
  pyramid.reserve(pyramid_texels(size));
  for (int level = 1; level < pyramid_levels(size); ++level) {
    const std::size_t width = static_cast<std::size_t>(size >> level),
                      below = pyramid_offset(size, level - 1);
    for (std::size_t j = 0; j < width; ++j)
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t child = below + 4 * j * width + 2 * i;
        pyramid.push_back(0.25f * (pyramid[child] + pyramid[child + 1] + pyramid[child + 2 * width] +
                                   pyramid[child + 2 * width + 1]));
      }
  }
  return pyramid;
}

std::vector<std::string> point_set_names() {
  return {"lattice", "fibonacci", "random"};
}

std::uint32_t point_set_kind(const std::string& name) {
  const std::vector<std::string> names = point_set_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(ErrorCode::bad_value, "points: \"" + name + "\" is none of lattice, fibonacci, random");
  return static_cast<std::uint32_t>(found - names.begin());
}

interop::PointSet make_point_set(std::uint32_t kind, std::uint32_t count, std::uint64_t seed) {
  if (count < 1 || count > interop::MAX_POINTS)
    throw Error(ErrorCode::out_of_range, "points: " + std::to_string(count) + " is not within 1..1048576");
  interop::PointSet set{};
  set.kind = kind == interop::POINTS_LATTICE && count < 8 ? interop::POINTS_FIBONACCI : kind;
  set.count = count;
  set.generator = set.kind == interop::POINTS_LATTICE ? lattice_generator(count) : 1;
  set.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  const auto hash = pcg3d({0xFFFFFFFFu, set.seed.x, set.seed.y});  // a counter that no point has
  set.rotation = {hash[0], hash[1]};
  return set;
}

// Gauss's reduction of the basis (1, g), (0, n) of the lattice scaled by n.
std::uint64_t lattice_shortest_squared(std::uint32_t count, std::uint32_t generator) {
  std::int64_t ax = 1, ay = generator % count, bx = 0, by = count;
  std::int64_t a2 = ax * ax + ay * ay, b2 = by * by;
  for (;;) {
    if (a2 > b2) {
      std::swap(ax, bx);
      std::swap(ay, by);
      std::swap(a2, b2);
    }
    const std::int64_t inner = ax * bx + ay * by;
    const std::int64_t steps =
        (2 * inner + (inner >= 0 ? a2 : -a2)) / (2 * a2);  // nearest integer to inner / a2
    bx -= steps * ax;
    by -= steps * ay;
    const std::int64_t reduced = bx * bx + by * by;
    if (reduced >= b2) return static_cast<std::uint64_t>(a2);
    b2 = reduced;
  }
}

std::uint32_t lattice_generator(std::uint32_t count) {
  // Lengths in units of the mean spacing: squared length / count. Sub-lattices i = s mod 16 have generator g
  // mod count / 16.
  const std::uint32_t sub = count % 16 == 0 ? count / 16 : 0;
  double best = -1;
  std::uint32_t chosen = 1;
  for (std::uint32_t g = 1; g <= count / 2; ++g) {
    if (std::gcd(g, count) != 1) continue;
    double quality = static_cast<double>(lattice_shortest_squared(count, g)) / count;
    if (sub > 1 && quality > best)
      quality = std::min(quality, static_cast<double>(lattice_shortest_squared(sub, g)) / sub);
    if (quality > best) {
      best = quality;
      chosen = g;
    }
  }
  return chosen;
}

// [Jarzynski 2020]
std::array<std::uint32_t, 3> pcg3d(std::array<std::uint32_t, 3> v) {
  const auto mix = [&v] {
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
  };
  for (std::uint32_t& word : v) word = word * 1664525u + 1013904223u;
  mix();
  for (std::uint32_t& word : v) word ^= word >> 16u;
  mix();
  return v;
}

std::array<std::uint32_t, 2> r2_bits(std::uint32_t k) {
  return {k * 0xC13FA9A9u, k * 0x91E10DA5u};
}

std::array<std::uint32_t, 2> point_bits(const interop::PointSet& set, std::uint32_t i) {
  if (set.kind == interop::POINTS_RANDOM) {
    const auto hash = pcg3d({i, set.seed.x, set.seed.y});
    return {hash[0], hash[1]};
  }
  const std::uint64_t count = set.count;
  const std::uint32_t u = fraction_bits(2ull * i + 1, 2 * count);
  const std::uint32_t v = set.kind == interop::POINTS_FIBONACCI
                              ? golden_bits(i)
                              : fraction_bits(static_cast<std::uint64_t>(i) * set.generator % count, count);
  return {u + set.rotation.x, v + set.rotation.y};
}

std::array<double, 2> point(const interop::PointSet& set, std::uint32_t i) {
  const auto bits = point_bits(set, i);
  return {(bits[0] >> 8) * 0x1p-24, (bits[1] >> 8) * 0x1p-24};
}

WarpedPoint warp(std::span<const DensityPyramid> layers, std::array<double, 2> point) {
  WarpedPoint warped;
  const std::size_t chosen = choose_layer(layers, point[0]);
  const DensityPyramid& density = layers[chosen];
  warped.layer = static_cast<int>(chosen);
  for (int level = density.top() - 1; level >= 0; --level) {
    const int i = warped.i * 2, j = warped.j * 2;
    const double p[2][2] = {{density.at(level, i, j), density.at(level, i, j + 1)},
                            {density.at(level, i + 1, j), density.at(level, i + 1, j + 1)}};
    const int column = choose(p[0][0] + p[0][1], p[1][0] + p[1][1], point[0]);
    const int row = choose(p[column][0], p[column][1], point[1]);
    warped.i = i + column;
    warped.j = j + row;
  }
  warped.x = (warped.i + point[0]) / density.size;
  warped.y = (warped.j + point[1]) / density.size;
  return warped;
}

}  // namespace vsgl
