#include "kmeans/kmeans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "../expect_error.h"
#include "math/interop_vec.h"
#include "math/lobe.h"
#include "math/moments.h"

namespace vsgl {
namespace {

using interop::Light;
using interop::Moments;
using interop::vec3;
using test::expect_error;

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

double hashed(std::uint32_t i, std::uint32_t what) {
  return pcg3d({i, what, 11})[0] * 0x1p-32;
}

// Level 0 of some layers of size x size texels.
struct Texels {
  int size;
  std::vector<std::vector<Moments>> layers;
  std::vector<std::span<const Moments>> spans;

  std::uint32_t of_layer() const { return static_cast<std::uint32_t>(size * size); }
  std::uint32_t count() const { return of_layer() * static_cast<std::uint32_t>(layers.size()); }
  const Moments& at(std::uint32_t texel) const { return layers[texel / of_layer()][texel % of_layer()]; }
};

// A point in the cube [-3,3]^3 on a grid of `steps` places a side, or nothing that reflects (one of five).
Moments hashed_texel(std::uint32_t i, int steps) {
  DoubleMoments m;
  Moments out{};
  if (hashed(i, 0) < 0.2) return out;
  const auto on_grid = [&](std::uint32_t what) {
    return 6 * std::floor(steps * hashed(i, what)) / steps - 3;
  };
  const Vec3 normal = normalise({hashed(i, 4) - 0.5, hashed(i, 5) - 0.5, 0.1 + hashed(i, 6)});
  const LobeMoments diffuse = lobe_encode(normal, 2), specular = lobe_encode(normal, 100 * hashed(i, 7) + 1);
  out.flux = {1, 2, 3};
  out.power_diffuse = to_float({hashed(i, 8), hashed(i, 9), 0.5});
  out.power_specular = to_float({hashed(i, 10), 0, hashed(i, 11)});
  out.weight = static_cast<float>(luminance(to_double(out.power_diffuse) + to_double(out.power_specular)));
  out.position = to_float({on_grid(1), on_grid(2), on_grid(3)});
  out.spread = static_cast<float>(1e-3 * hashed(i, 12));
  out.diffuse_mean = to_float(diffuse.mean);
  out.diffuse_deficit = static_cast<float>(diffuse.deficit);
  out.specular_mean = to_float(specular.mean);
  out.specular_deficit = static_cast<float>(specular.deficit);
  out.normal_mean = to_float(normal);
  return out;
}

Texels hashed_texels(int size, std::uint32_t layers, int steps = 1 << 20) {
  Texels texels{size, {}, {}};
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    texels.layers.emplace_back();
    for (std::uint32_t i = 0; i < texels.of_layer(); ++i)
      texels.layers.back().push_back(hashed_texel(layer * texels.of_layer() + i, steps));
  }
  for (const auto& layer : texels.layers) texels.spans.emplace_back(layer);
  return texels;
}

std::vector<std::uint32_t> lit_texels(const Texels& texels) {
  std::vector<std::uint32_t> lit;
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    if (texels.at(i).weight > 0) lit.push_back(i);
  return lit;
}

// `count` lit texels, of each layer some; every `repeat` are the same one.
std::vector<std::uint32_t> hashed_centres(const Texels& texels, std::uint32_t count,
                                          std::uint32_t repeat = 1) {
  const auto lit = lit_texels(texels);
  std::vector<std::uint32_t> centres;
  for (std::uint32_t i = 0; i < count; ++i)
    centres.push_back(
        lit[static_cast<std::size_t>(hashed(i / repeat, 20) * static_cast<double>(lit.size()))]);
  return centres;
}

Clusters cluster(const Texels& texels, const std::vector<std::uint32_t>& centres,
                 const KmeansParams& params) {
  Report report;
  return cluster_texels(texels.spans, texels.size, centres, params, device(), report);
}

// ---- the search

struct Point {
  vec3 place, facing;
};

float square(vec3 d) {
  return d.x * d.x + d.y * d.y + d.z * d.z;
}
vec3 difference(vec3 a, vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
vec3 times(vec3 v, float s) {
  return {v.x * s, v.y * s, v.z * s};
}

// In single precision, step by step as the shader has it.
Point point_of(const Texels& texels, std::uint32_t texel, const KmeansParams& params) {
  const Moments& m = texels.at(texel);
  const vec3 facing = times(m.normal_mean, static_cast<float>(std::sqrt(params.normal_weight)));
  if (params.space == interop::KMEANS_3D)
    return {times(m.position, static_cast<float>(1 / params.scene_radius)), facing};
  const auto side = static_cast<std::uint32_t>(texels.size), row = texel / side;
  const float scale = 1 / static_cast<float>(side);
  // Layers are further apart than anything within one.
  return {{(static_cast<float>(texel % side) + 0.5f) * scale, (static_cast<float>(row % side) + 0.5f) * scale,
           static_cast<float>(row / side) * 1000},
          facing};
}

float distance(const Point& a, const Point& b) {
  return square(difference(a.place, b.place)) + square(difference(a.facing, b.facing));
}

// Compares every texel with every centre; of equally near ones the first.
std::vector<std::uint32_t> brute_force(const Texels& texels, const std::vector<std::uint32_t>& centres,
                                       const KmeansParams& params) {
  std::vector<Point> points;
  for (const std::uint32_t centre : centres) points.push_back(point_of(texels, centre, params));
  std::vector<std::uint32_t> clusters;
  for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
    const Point p = point_of(texels, texel, params);
    auto best = static_cast<std::uint32_t>(centres.size());
    for (std::uint32_t i = 0; i < centres.size() && texels.at(texel).weight > 0; ++i)
      if (best == centres.size() || distance(p, points[i]) < distance(p, points[best])) best = i;
    clusters.push_back(best);
  }
  return clusters;
}

void expect_nearest(const Texels& texels, const std::vector<std::uint32_t>& centres) {
  for (const std::uint32_t space : {interop::KMEANS_2D, interop::KMEANS_3D})
    for (const double normal_weight : {0.0, 0.3}) {
      const KmeansParams params{.space = space, .normal_weight = normal_weight, .scene_radius = 4};
      EXPECT_EQ(cluster(texels, centres, params).cluster_of, brute_force(texels, centres, params))
          << centres.size() << " centres, space " << space << ", weight of normals " << normal_weight;
    }
}

TEST(Kmeans, FindsTheNearestCentreAsBruteForceDoes) {
  const Texels texels = hashed_texels(64, 1);
  for (const std::uint32_t count : {1u, 2u, 3u, 5u, 64u, 1000u})
    expect_nearest(texels, hashed_centres(texels, count));
}

// On the coarse grid most distances tie.
TEST(Kmeans, GivesTiesToTheFirstCentre) {
  const Texels texels = hashed_texels(32, 1, 4);
  expect_nearest(texels, hashed_centres(texels, 500));
  expect_nearest(texels, hashed_centres(texels, 1000, 1000));  // all the same
  expect_nearest(texels, hashed_centres(texels, 2000, 50));
}

TEST(Kmeans, KeepsLayersApartIn2D) {
  const Texels texels = hashed_texels(32, 6);
  const auto centres = hashed_centres(texels, 100);
  expect_nearest(texels, centres);
  for (const double normal_weight : {0.0, 1e4}) {
    const Clusters clusters = cluster(texels, centres, {.normal_weight = normal_weight});
    for (const std::uint32_t texel : lit_texels(texels))
      EXPECT_EQ(centres[clusters.cluster_of[texel]] / texels.of_layer(), texel / texels.of_layer());
  }
}

// ---- the sums

DoubleMoments merge(const Texels& texels, const std::vector<std::uint32_t>& members) {
  std::vector<DoubleMoments> taps;
  for (const std::uint32_t texel : members) taps.push_back(to_double(texels.at(texel)));
  return merge_moments(taps, std::vector<double>(taps.size(), 1));
}

void expect_near(vec3 a, Vec3 b, double tolerance) {
  EXPECT_LE(length(to_double(a) - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

void expect_light(const Light& light, const DoubleMoments& m, double floor) {
  const double power = luminance(m.power_diffuse + m.power_specular);
  expect_near(light.power_diffuse, m.power_diffuse, 1e-6 * power);
  expect_near(light.power_specular, m.power_specular, 1e-6 * power);
  expect_near(light.position, m.position, 3e-6);
  EXPECT_NEAR(light.variance, std::max(m.spread / 2, floor), 1e-5 * m.spread);
  const SgLobe diffuse = lobe_decode({m.diffuse_mean, m.diffuse_deficit}),
               specular = lobe_decode({m.specular_mean, m.specular_deficit});
  expect_near(light.diffuse_axis, diffuse.axis, 1e-5);
  expect_near(light.specular_axis, specular.axis, 1e-5);
  EXPECT_NEAR(static_cast<double>(light.diffuse_sharpness) / diffuse.sharpness, 1, 1e-4);
  EXPECT_NEAR(static_cast<double>(light.specular_sharpness) / specular.sharpness, 1, 1e-4);
  expect_near(light.normal, normalise(m.normal_mean), 1e-5);
  EXPECT_NEAR(light.normal_deficit, m.normal_deficit, 1e-5);
}

// Member nearest to the centre; the first of several.
std::uint32_t representative(const Texels& texels, const std::vector<std::uint32_t>& members,
                             std::uint32_t centre, const KmeansParams& params) {
  const Point c = point_of(texels, centre, params);
  return *std::ranges::min_element(
      members, {}, [&](std::uint32_t texel) { return distance(point_of(texels, texel, params), c); });
}

void expect_lights(const Texels& texels, const std::vector<std::uint32_t>& centres, KmeansParams params) {
  params.variance_floor = 1e-4;
  const Clusters clusters = cluster(texels, centres, params);
  std::vector<std::vector<std::uint32_t>> members(centres.size());
  for (const std::uint32_t texel : lit_texels(texels)) members[clusters.cluster_of[texel]].push_back(texel);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    SCOPED_TRACE("cluster " + std::to_string(i) + " of " + std::to_string(centres.size()));
    const Light& light = clusters.lights[i];
    if (members[i].empty()) {
      const Light zeros{};
      EXPECT_EQ(std::memcmp(&light, &zeros, sizeof zeros), 0);
      continue;
    }
    expect_light(light, merge(texels, members[i]), params.variance_floor);
    EXPECT_NEAR(light.level, std::log2(static_cast<double>(members[i].size())) / 2, 1e-5);
    EXPECT_EQ(light.layer * texels.of_layer() + light.texel,
              representative(texels, members[i], centres[i], params));
  }
}

// One cluster of all, some large ones, some of few texels, most empty.
TEST(Kmeans, LightsAreTheSumsOverTheirTexels) {
  const Texels texels = hashed_texels(128, 1);
  for (const std::uint32_t count : {1u, 3u, 1000u}) expect_lights(texels, hashed_centres(texels, count), {});
  expect_lights(texels, hashed_centres(texels, 100, 20), {});
  const Texels faces = hashed_texels(32, 6);
  for (const std::uint32_t space : {interop::KMEANS_2D, interop::KMEANS_3D})
    expect_lights(faces, hashed_centres(faces, 200), {.space = space});
}

TEST(Kmeans, ConservesPower) {
  const Texels texels = hashed_texels(256, 1);
  const DoubleMoments all = merge(texels, lit_texels(texels));
  for (const std::uint32_t count : {1u, 10u, 1000u}) {
    Vec3 power;
    for (const Light& light : cluster(texels, hashed_centres(texels, count), {}).lights)
      power += to_double(light.power_diffuse) + to_double(light.power_specular);
    EXPECT_NEAR(luminance(power) / luminance(all.power_diffuse + all.power_specular), 1, 1e-6) << count;
  }
}

// ---- Lloyd's iterations

TEST(Kmeans, IterationsNeverRaiseTheCost) {
  const Texels texels = hashed_texels(32, 2);
  const auto centres = hashed_centres(texels, 40);
  for (const std::uint32_t space : {interop::KMEANS_2D, interop::KMEANS_3D})
    for (const double normal_weight : {0.0, 0.3}) {
      KmeansParams params{.space = space, .normal_weight = normal_weight, .scene_radius = 4};
      const double first = cluster(texels, centres, params).cost;
      double last = first;
      for (params.iterations = 1; params.iterations <= 4; ++params.iterations) {
        const double cost = cluster(texels, centres, params).cost;
        EXPECT_LE(cost, last * (1 + 1e-6)) << params.iterations;
        last = cost;
      }
      EXPECT_LT(last, 0.9 * first) << "space " << space << ", weight of normals " << normal_weight;
    }
}

// The cost of an iteration in double precision: centres at the means of the clusters before.
TEST(Kmeans, IterationsMoveCentresToTheMeans) {
  const Texels texels = hashed_texels(64, 1);
  const auto centres = hashed_centres(texels, 20);
  const KmeansParams params{.space = interop::KMEANS_3D};
  const auto before = cluster(texels, centres, params).cluster_of;
  std::vector<std::vector<std::uint32_t>> members(centres.size());
  for (const std::uint32_t texel : lit_texels(texels)) members[before[texel]].push_back(texel);
  std::vector<Vec3> means;
  for (const auto& cluster_members : members) means.push_back(merge(texels, cluster_members).position);
  double cost = 0;
  for (const std::uint32_t texel : lit_texels(texels)) {
    double nearest = 1e9;
    for (const Vec3 mean : means) {
      const Vec3 d = to_double(texels.at(texel).position) - mean;
      nearest = std::min(nearest, dot(d, d));
    }
    cost += static_cast<double>(texels.at(texel).weight) * nearest;
  }
  KmeansParams moved = params;
  moved.iterations = 1;
  EXPECT_NEAR(cluster(texels, centres, moved).cost / cost, 1, 1e-5);
}

TEST(Kmeans, StopsWhenFewTexelsMove) {
  const Texels texels = hashed_texels(32, 1);
  EXPECT_EQ(cluster(texels, hashed_centres(texels, 1), {.iterations = 20}).iterations, 1);
  const int many = cluster(texels, hashed_centres(texels, 20), {.iterations = 1000}).iterations;
  EXPECT_GT(many, 2);
  EXPECT_LT(many, 1000);
}

// ---- the choice of centres

std::vector<std::uint32_t> choose(const Texels& texels, const std::vector<std::vector<float>>& densities,
                                  std::uint32_t count, std::uint32_t space) {
  std::vector<std::vector<float>> pyramids;
  std::vector<DensityPyramid> views;
  for (const auto& density : densities) pyramids.push_back(mean_pyramid(density, texels.size));
  for (const auto& pyramid : pyramids) views.push_back({texels.size, pyramid});
  Report report;
  return choose_centres(views, texels.spans, space, {.count = count}, device(), report);
}

// All of the density on one texel that reflects and one that does not.
TEST(Kmeans, EveryLayerThatReflectsHasACentreIn2D) {
  const Texels texels = hashed_texels(16, 3);
  const std::uint32_t lit = lit_texels(texels).front();
  std::vector<std::vector<float>> densities(3, std::vector<float>(256, 0));
  densities[0][lit] = 3 * 256;
  const auto centres = choose(texels, densities, 8, interop::KMEANS_2D);
  ASSERT_EQ(centres.size(), 8u);
  EXPECT_EQ(std::ranges::count(centres, lit), 6);
  for (const std::uint32_t layer : {1u, 2u})
    EXPECT_EQ(std::ranges::count_if(centres, [&](std::uint32_t c) { return c / 256 == layer; }), 1);
  EXPECT_EQ(choose(texels, densities, 8, interop::KMEANS_3D), std::vector<std::uint32_t>(8, lit));
  expect_error(ErrorCode::out_of_range, {"count: 2", "layers"},
               [&] { choose(texels, densities, 2, interop::KMEANS_2D); });
}

TEST(Kmeans, DarkTexelsAreNoCentres) {
  const Texels texels = hashed_texels(16, 1);
  std::vector<float> density(256, 0);
  for (std::uint32_t i = 0; i < 256; ++i)
    if (!(texels.at(i).weight > 0)) density[i] = 1;
  const auto centres = choose(texels, {density}, 8, interop::KMEANS_3D);
  ASSERT_EQ(centres.size(), 1u);
  for (const std::uint32_t texel : lit_texels(texels))
    EXPECT_LE(texels.at(texel).weight, texels.at(centres[0]).weight);
}

}  // namespace
}  // namespace vsgl
