#include "math/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace vsgl {
namespace {

double by_brute_force(const std::vector<Vec3>& points, std::uint32_t self, std::size_t k) {
  std::vector<double> distances2;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 v = points[i] - points[self];
    if (i != self) distances2.push_back(dot(v, v));
  }
  std::sort(distances2.begin(), distances2.end());
  return distances2[std::min(k, distances2.size()) - 1];
}

// Points in space, on a plane, on a line, and many in one place.
std::vector<Vec3> scattered(int flat) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) {
    Vec3 p{uniform(random), uniform(random), uniform(random)};
    if (flat >= 1) p.y = 0.25;
    if (flat >= 2) p.z = -1;
    if (flat == 3 && i % 3 == 0) p = {0.5, 0.5, 0.5};
    points.push_back(p);
  }
  return points;
}

TEST(PointTree, FindsWhatBruteForceFinds) {
  for (int flat = 0; flat < 4; ++flat) {
    const std::vector<Vec3> points = scattered(flat);
    const PointTree tree(points);
    for (std::uint32_t self = 0; self < points.size(); ++self)
      for (const int k : {1, 2, 10, 400})
        ASSERT_EQ(tree.neighbour_distance2(self, k),
                  by_brute_force(points, self, static_cast<std::size_t>(k)))
            << "flat " << flat << " point " << self << " k " << k;
  }
}

TEST(PointTree, TakesTheFurthestWhereThereAreFewer) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(PointTree(points).neighbour_distance2(0, 10), 9);
  EXPECT_EQ(PointTree(std::span(points).first(1)).neighbour_distance2(0, 1),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace vsgl
