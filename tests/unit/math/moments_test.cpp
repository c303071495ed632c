#include "math/moments.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace vsgl {
namespace {

std::vector<DoubleMoments> random_points(int count) {
  std::mt19937 engine(7);
  const auto uniform = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  const auto vector = [&] { return Vec3{uniform(), uniform(), uniform()}; };
  std::vector<DoubleMoments> points(static_cast<std::size_t>(count));
  for (DoubleMoments& p : points) {
    p.flux = vector(), p.power_diffuse = vector(), p.power_specular = vector();
    p.weight = luminance(p.power_diffuse + p.power_specular);
    p.position = vector();
    p.diffuse_mean = 0.57 * normalise(vector()), p.diffuse_deficit = 1 - 0.57 * 0.57;
    p.specular_mean = normalise(vector());
    p.normal_mean = normalise(vector());
  }
  return points;
}

TEST(Moments, MergingObeysTheLawOfTotalVariance) {
  const std::vector<DoubleMoments> points = random_points(16);
  const std::vector<double> quarter(4, 0.25), sixteenth(16, 1.0 / 16);
  std::vector<DoubleMoments> blocks;
  for (std::size_t i = 0; i < 16; i += 4) blocks.push_back(merge_moments({points.data() + i, 4}, quarter));
  const DoubleMoments steps = merge_moments(blocks, quarter), direct = merge_moments(points, sixteenth);

  EXPECT_NEAR(steps.spread, direct.spread, 1e-14);
  EXPECT_NEAR(steps.weight, direct.weight, 1e-14);
  EXPECT_NEAR(length(steps.position - direct.position), 0, 1e-14);
  EXPECT_NEAR(length(steps.power_specular - direct.power_specular), 0, 1e-14);
  EXPECT_NEAR(steps.diffuse_deficit, 1 - dot(direct.diffuse_mean, direct.diffuse_mean), 1e-14);
  EXPECT_NEAR(steps.specular_deficit, 1 - dot(direct.specular_mean, direct.specular_mean), 1e-14);
  EXPECT_NEAR(steps.normal_deficit, 1 - dot(direct.normal_mean, direct.normal_mean), 1e-14);

  double total = 0, second = 0;
  Vec3 first;
  for (const DoubleMoments& p : points) {
    total += p.weight, second += p.weight * dot(p.position, p.position), first += p.weight * p.position;
  }
  EXPECT_NEAR(direct.spread, second / total - dot(first / total, first / total), 1e-13);
}

TEST(Moments, EmptyTapsCountForNothing) {
  std::vector<DoubleMoments> points = random_points(3);
  points.insert(points.begin(), DoubleMoments{});
  points[0].position = {1e6, 0, 0};
  const std::array<double, 4> quarter{0.25, 0.25, 0.25, 0.25};
  const DoubleMoments merged = merge_moments(points, quarter);
  EXPECT_LT(length(merged.position), 2);
  EXPECT_LT(merged.spread, 3);
  const DoubleMoments empty = merge_moments(std::vector<DoubleMoments>(4), quarter);
  EXPECT_EQ(empty.weight, 0);
  EXPECT_EQ(empty.spread, 0);
  EXPECT_EQ(empty.position, Vec3{});
}

}  // namespace
}  // namespace vsgl
