#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>
#include <set>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "../synthetic_tree.h"

namespace vsgl {
namespace {

using interop::Light;
using test::tree_of;

// The room under a spot and a directional light whose texels have roughness, NDF and shading normal of their
// own.
const Rsm& room() {
  static const Rsm rsm = [] {
    Rsm room = test::room_rsm(32, 2);
    room.layers[1].light.type = LightType::directional;
    std::uint32_t k = 0;
    for (RsmLayer& layer : room.layers)
      for (interop::Surface& s : layer.surface) {
        if (s.ndf == interop::NDF_NONE) continue;
        s.alpha = 0.1f + 0.01f * static_cast<float>(++k % 50);
        s.ndf = 1 + k / 5 % 3;
        s.shading_normal =
            test::to_float(normalise(test::to_double(s.normal) + Vec3{0.1 * (k % 3), 0.05 * (k % 7), 0}));
      }
    return room;
  }();
  return rsm;
}

// Keeps the first `count` texels of an RSM.
Rsm only(const Rsm& rsm, std::size_t count) {
  Rsm out = rsm;
  for (RsmLayer& layer : out.layers) {
    std::vector<DoubleMoments> none(static_cast<std::size_t>(rsm.size) * static_cast<std::size_t>(rsm.size));
    const std::size_t kept = std::exchange(count, 0);
    const auto empty = test::moment_pyramid(none, rsm.size);
    std::copy(empty.begin() + static_cast<std::ptrdiff_t>(kept), empty.end(),
              layer.pyramid.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  return out;
}

using TexelId = std::pair<std::uint32_t, std::uint32_t>;  // layer, texel

bool lit(const Light& light) {
  return luminance(test::to_double(light.power_diffuse) + test::to_double(light.power_specular)) > 0;
}

// The texels of the leaves below a node.
void collect(const Lights& tree, std::uint32_t node, std::vector<TexelId>& texels) {
  const Light& light = tree.lights[node];
  if (light.children == 0) {
    if (lit(light)) texels.emplace_back(light.layer, light.texel);
    return;
  }
  for (std::uint32_t k = 0; k < 4; ++k) collect(tree, light.children + k, texels);
}
std::vector<TexelId> texels_below(const Lights& tree, std::uint32_t node) {
  std::vector<TexelId> texels;
  collect(tree, node, texels);
  return texels;
}

std::set<TexelId> lit_texels_of(const Rsm& rsm) {
  std::set<TexelId> texels;
  for (std::uint32_t layer = 0; layer < rsm.layers.size(); ++layer)
    for (std::uint32_t texel = 0; texel < rsm.layers[layer].surface.size(); ++texel)
      if (rsm.layers[layer].pyramid[texel].weight > 0) texels.emplace(layer, texel);
  return texels;
}

TEST(Tree, EveryLitTexelIsInOneLeaf) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 100u, 1024u}) {
    const Rsm rsm = only(room(), count);
    const Lights tree = tree_of(rsm);
    const auto texels = texels_below(tree, 0);
    const std::set<TexelId> expected = lit_texels_of(rsm);
    ASSERT_EQ(expected.size(), count);
    EXPECT_EQ(texels.size(), count);
    EXPECT_EQ(std::set(texels.begin(), texels.end()), expected);
    // As many nodes as leaves of four children need, and at most two empty ones.
    EXPECT_EQ(tree.lights.size(), 1 + 4 * ((count + 1) / 3)) << count;
    EXPECT_EQ(tree.levels.back(), tree.lights.size());
  }
}

// Two groups of 300 and 724 texels that face the same way: the root's halves are these, but for the texel
// that fills up quarters.
TEST(Tree, SplitsFallBetweenWhatIsApart) {
  Rsm rsm = only(room(), 1024);
  for (std::uint32_t k = 0; k < 1024; ++k) {
    interop::Moments& m = rsm.layers[0].pyramid[k];
    m.position = {k < 300 ? 0.0f : 10.0f, static_cast<float>(k % 7), static_cast<float>(k % 11)};
    m.normal_mean = {0, 1, 0};
  }
  const Lights tree = tree_of(rsm);
  for (std::uint32_t half = 0; half < 2; ++half) {
    std::vector<TexelId> texels = texels_below(tree, 1 + 2 * half);
    collect(tree, 2 + 2 * half, texels);
    const auto strangers = std::count_if(texels.begin(), texels.end(),
                                         [&](const TexelId& id) { return (id.second < 300) != (half == 0); });
    EXPECT_LE(strangers, 1) << half;
  }
}

TEST(Tree, LevelsFollowOneAnother) {
  const Lights tree = tree_of(room());
  EXPECT_EQ(tree.levels[0], 0u);
  EXPECT_EQ(tree.levels[1], 1u);
  std::uint32_t next = 1;
  for (std::size_t level = 0; level + 1 < tree.levels.size(); ++level) {
    EXPECT_EQ(next, tree.levels[level + 1]) << level;
    for (std::uint32_t i = tree.levels[level]; i < tree.levels[level + 1]; ++i) {
      if (tree.lights[i].children == 0) continue;
      EXPECT_EQ(tree.lights[i].children, next);
      next += 4;
    }
  }
  EXPECT_LE(tree.levels.size(), 12u);  // 2048 texels: at least 6 levels
}

TEST(Tree, EveryLevelCarriesThePowerOfTheRsm) {
  const Lights tree = tree_of(room());
  const double reflected = test::reflected_power(room());
  for (int level = 0; level + 2 < static_cast<int>(tree.levels.size()); ++level) {
    const Lights list = tree_of(room(), {.level = level});
    EXPECT_FALSE(list.is_tree());
    double power = 0;
    for (const Light& l : list.lights) {
      power += luminance(test::to_double(l.power_diffuse) + test::to_double(l.power_specular));
      EXPECT_EQ(l.children, 0u);
      EXPECT_TRUE(lit(l));
    }
    EXPECT_NEAR(power / reflected, 1, 1e-6) << level;
  }
}

// Means over texels, by their definitions.
struct Expected {
  Vec3 power_diffuse, power_specular, position, normal, diffuse, specular, shading_normal, incident;
  double weight = 0, spread = 0, alpha2 = 0, inverse_square = 0;
  std::array<double, 4> of_ndf{};
};

struct Texel {
  const RsmLayer& layer;
  const interop::Surface& surface;
  DoubleMoments m;

  double specular() const { return luminance(m.power_specular); }
};

Texel texel_at(const Rsm& rsm, TexelId id) {
  const RsmLayer& layer = rsm.layers[id.first];
  const interop::Moments& f = layer.pyramid[id.second];
  Texel out{layer, layer.surface[id.second], {}};
  out.m.power_diffuse = test::to_double(f.power_diffuse);
  out.m.power_specular = test::to_double(f.power_specular);
  out.m.weight = f.weight;
  out.m.position = test::to_double(f.position);
  out.m.spread = f.spread;
  out.m.diffuse_mean = test::to_double(f.diffuse_mean);
  out.m.specular_mean = test::to_double(f.specular_mean);
  out.m.normal_mean = test::to_double(f.normal_mean);
  return out;
}

Expected expected_of(const Rsm& rsm, const std::vector<TexelId>& ids) {
  Expected e;
  double specular = 0, diffuse = 0;
  for (const TexelId& id : ids) {
    const DoubleMoments m = texel_at(rsm, id).m;
    e.power_diffuse += m.power_diffuse;
    e.power_specular += m.power_specular;
    e.weight += m.weight;
    e.position += m.weight * m.position;
    e.normal += m.weight * m.normal_mean;
    diffuse += luminance(m.power_diffuse);
    specular += luminance(m.power_specular);
    e.diffuse += luminance(m.power_diffuse) * m.diffuse_mean;
    e.specular += luminance(m.power_specular) * m.specular_mean;
  }
  e.position *= 1 / e.weight;
  e.normal *= 1 / e.weight;
  e.diffuse *= 1 / diffuse;
  if (specular > 0) e.specular *= 1 / specular;
  for (const TexelId& id : ids) {
    const Texel t = texel_at(rsm, id);
    const Vec3 d = t.m.position - e.position;
    e.spread += t.m.weight / e.weight * (t.m.spread + dot(d, d));
    const double share = specular > 0 ? t.specular() / specular : t.m.weight / e.weight;
    e.shading_normal += share * test::to_double(t.surface.shading_normal);
    e.incident += share * direction_to_source(t.layer.light, t.m.position);
    e.alpha2 += share * static_cast<double>(t.surface.alpha) * static_cast<double>(t.surface.alpha);
    const Vec3 to_source = t.layer.light.position - t.m.position;
    if (t.layer.light.type != LightType::directional) e.inverse_square += share / dot(to_source, to_source);
    if (t.specular() > 0) e.of_ndf[t.surface.ndf] += t.specular();
  }
  return e;
}

void expect_near(interop::vec3 found, Vec3 expected, double tolerance, const char* what) {
  EXPECT_NEAR(length(test::to_double(found) - expected), 0, tolerance) << what;
}

void expect_lobe(interop::vec3 axis, float sharpness, Vec3 mean, const char* what) {
  const SgLobe lobe = lobe_decode({mean, 1 - dot(mean, mean)});
  expect_near(axis, lobe.axis, 1e-5, what);
  EXPECT_NEAR(static_cast<double>(sharpness) / lobe.sharpness, 1, 1e-4) << what;
}

void expect_node(const Rsm& rsm, const Light& l, const std::vector<TexelId>& ids) {
  const Expected e = expected_of(rsm, ids);
  expect_near(l.power_diffuse, e.power_diffuse, 1e-6 * length(e.power_diffuse), "power_diffuse");
  expect_near(l.power_specular, e.power_specular, 1e-6 * length(e.power_specular), "power_specular");
  expect_near(l.position, e.position, 1e-6, "position");
  EXPECT_NEAR(static_cast<double>(l.variance) / (0.5 * e.spread), 1, 1e-5);
  expect_near(l.normal, normalise(e.normal), 1e-6, "normal");
  EXPECT_NEAR(l.normal_deficit, 1 - dot(e.normal, e.normal), 1e-6);
  expect_near(l.shading_normal, normalise(e.shading_normal), 1e-6, "shading_normal");
  expect_near(l.incident, normalise(e.incident), 1e-6, "incident");
  expect_lobe(l.diffuse_axis, l.diffuse_sharpness, e.diffuse, "diffuse lobe");
  EXPECT_NEAR(l.level, std::log2(static_cast<double>(ids.size())) / 2, 1e-6);
  if (e.power_specular == Vec3{}) {
    EXPECT_EQ(l.ndf, interop::NDF_NONE);
    EXPECT_EQ(l.alpha, 1);
    EXPECT_EQ(l.lobe_variance, 0);
    EXPECT_EQ(l.shading_deficit, 0);
    return;
  }
  expect_lobe(l.specular_axis, l.specular_sharpness, e.specular, "specular lobe");
  EXPECT_NEAR(l.alpha, std::sqrt(e.alpha2), 1e-6);
  EXPECT_EQ(l.ndf, std::max_element(e.of_ndf.begin(), e.of_ndf.end()) - e.of_ndf.begin());
  const double deficit = 1 - dot(e.shading_normal, e.shading_normal);
  EXPECT_NEAR(l.shading_deficit, deficit, 1e-6);
  EXPECT_NEAR(l.lobe_variance, deficit + 0.25 * e.spread * e.inverse_square, 1e-6);
}

TEST(Tree, NodesHaveTheStatisticsOfTheirTexels) {
  const Lights tree = tree_of(room());
  int specular = 0, diffuse = 0;
  for (std::uint32_t node = 0; node < tree.lights.size(); ++node) {
    SCOPED_TRACE(node);
    const auto ids = texels_below(tree, node);
    if (ids.empty()) continue;
    expect_node(room(), tree.lights[node], ids);
    ++(tree.lights[node].ndf == interop::NDF_NONE ? diffuse : specular);
  }
  EXPECT_GT(specular, 100);
  EXPECT_GT(diffuse, 100);
}

TEST(Tree, ANodeIsRepresentedByTheTexelNearestToItsMean) {
  const Lights tree = tree_of(room());
  for (std::uint32_t node = 0; node < tree.lights.size(); ++node) {
    const Light& l = tree.lights[node];
    const auto distance_of = [&](TexelId id) {
      return length(texel_at(room(), id).m.position - test::to_double(l.position));
    };
    const double distance = distance_of({l.layer, l.texel});
    expect_near(l.origin, test::to_double(room().layers[l.layer].surface[l.texel].position), 0, "origin");
    for (const TexelId& id : texels_below(tree, node)) EXPECT_LE(distance, 1.001 * distance_of(id) + 1e-6);
  }
}

// Walls are flat, grids regular and rooms symmetric: rounding must not decide how their texels are split.
TEST(Tree, RoundingOfPositionsHardlyChangesIt) {
  Rsm moved = room();
  std::uint32_t k = 0;
  for (RsmLayer& layer : moved.layers)
    for (interop::Moments& m : layer.pyramid)
      for (float* x : {&m.position.x, &m.position.y, &m.position.z})
        *x += 1e-7f * static_cast<float>(static_cast<int>(++k * 2654435761u >> 30) - 1);
  const Lights tree = tree_of(room()), other = tree_of(moved);
  ASSERT_EQ(tree.lights.size(), other.lights.size());
  std::size_t changed = 0;
  for (std::size_t node = 0; node < tree.lights.size(); ++node)
    if (tree.lights[node].texel != other.lights[node].texel) ++changed;
  EXPECT_LT(static_cast<double>(changed), 0.02 * static_cast<double>(tree.lights.size())) << changed;
}

// 5 texels: four leaves and a node of two, whose two other children are empty.
TEST(Tree, EmptyNodesAreWhereTheirParentIs) {
  const Lights tree = tree_of(only(room(), 5));
  ASSERT_EQ(tree.lights.size(), 9u);
  int empty = 0;
  for (const Light& parent : tree.lights)
    for (std::uint32_t k = 0; parent.children != 0 && k < 4; ++k) {
      const Light& l = tree.lights[parent.children + k];
      if (lit(l)) continue;
      ++empty;
      EXPECT_EQ(test::to_double(l.position), test::to_double(parent.position));
      EXPECT_EQ(test::to_double(l.normal), test::to_double(parent.normal));
      EXPECT_EQ(l.children, 0u);
      EXPECT_EQ(l.ndf, interop::NDF_NONE);
    }
  EXPECT_EQ(empty, 2);
}

TEST(Tree, OfNothing) {
  const Rsm rsm = only(room(), 0);
  const Lights tree = tree_of(rsm);
  EXPECT_TRUE(tree.is_tree());
  EXPECT_EQ(tree.levels, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_TRUE(tree.lights.empty());
  EXPECT_TRUE(tree_of(rsm, {.level = 3}).lights.empty());
}

TEST(Tree, WithoutSpecularPowerNothingSpecularIsMerged) {
  for (const bool specular : {false, true}) {
    Report report;
    const Lights tree = generate_lights(test::room_rsm(16, 1, specular), nullptr, {}, nullptr, report);
    EXPECT_EQ(tree.has_specular(), specular);
    const std::string skipped = report.to_json().at("skipped").dump();
    EXPECT_EQ(skipped.find("specular emission") == std::string::npos, specular) << skipped;
    EXPECT_NE(skipped.find("sampling"), std::string::npos);
  }
}

TEST(Tree, SameBytesOnAnyNumberOfThreads) {
  const Rsm rsm = test::room_rsm(128, 2);
  omp_set_num_threads(1);
  const Lights one = tree_of(rsm);
  omp_set_num_threads(2);
  const Lights two = tree_of(rsm);
  ASSERT_EQ(one.lights.size(), two.lights.size());
  EXPECT_EQ(std::memcmp(one.lights.data(), two.lights.data(), one.lights.size() * sizeof(Light)), 0);
}

TEST(Tree, DescribesItsLevels) {
  const Lights tree = tree_of(only(room(), 5));
  const auto json = describe(tree, room(), {}, false).at("tree");
  EXPECT_EQ(json.at("lit_texels"), 5);
  EXPECT_EQ(json.at("depth"), 3);
  const int nodes[] = {1, 4, 4}, leaves[] = {0, 3, 4};
  for (std::size_t level = 0; level < 3; ++level) {
    EXPECT_EQ(json.at("levels")[level].at("nodes"), nodes[level]);
    EXPECT_EQ(json.at("levels")[level].at("leaves"), leaves[level]);
  }
  const double radius = std::sqrt(2 * static_cast<double>(tree.lights[0].variance));
  EXPECT_EQ(json.at("levels")[0].at("radius_m").at("max"), radius);
  EXPECT_FALSE(describe(tree_of(room(), {.level = 2}), room(), {}, false).contains("tree"));
  EXPECT_EQ(describe(tree_of(only(room(), 0)), room(), {}, false).at("tree").at("depth"), 0);
}

TEST(Tree, RefusesLevelsThatAreNotThere) {
  test::expect_error(ErrorCode::out_of_range, {"level: 30 is beyond the tree's 0.."},
                     [] { tree_of(room(), {.level = 30}); });
  test::expect_error(ErrorCode::out_of_range, {"level: 65 is outside -1..64"},
                     [] { tree_of(room(), {.level = 65}); });
  test::expect_error(ErrorCode::out_of_range, {"level: -2 is outside"},
                     [] { tree_of(room(), {.level = -2}); });
}

}  // namespace
}  // namespace vsgl
