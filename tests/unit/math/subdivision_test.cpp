// Cells of a triangle: they cover it once.

#include "math/subdivision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsgl {
namespace {

TEST(Subdivision, IntegerRootIsExact) {
  for (const std::uint32_t root : {0u, 1u, 2u, 77u, 4095u, 4096u, 65535u}) {
    EXPECT_EQ(integer_root(root * root), root);
    EXPECT_EQ(integer_root(root * root + root), root);
    if (root > 0) {
      EXPECT_EQ(integer_root(root * root - 1), root - 1);
    }
  }
  EXPECT_EQ(integer_root(0xFFFFFFFFu), 65535u);
}

TEST(Subdivision, OneCellIsTheTriangle) {
  const Vec3 w = subdivision_point(1, 0, {0.3, 0.5});
  EXPECT_NEAR(w.x, 0.2, 1e-15);
  EXPECT_NEAR(w.y, 0.3, 1e-15);
  EXPECT_NEAR(w.z, 0.5, 1e-15);
}

// In coordinates (y, z) of the triangle the corners of each cell span 1 / k^2 of its area, and the cells'
// first three moments add up to the triangle's: so they cover it once.
TEST(Subdivision, CellsTileTheTriangle) {
  for (const std::uint32_t k : {1u, 2u, 3u, 8u}) {
    double mean_y = 0, mean_z = 0, mean_yz = 0;
    for (std::uint32_t cell = 0; cell < k * k; ++cell) {
      const Vec3 a = subdivision_point(k, cell, {0, 0}), b = subdivision_point(k, cell, {1, 0}),
                 c = subdivision_point(k, cell, {0, 1});
      for (const Vec3 corner : {a, b, c})
        for (const double weight : {corner.x, corner.y, corner.z}) EXPECT_GT(weight, -1e-12);
      const double area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
      EXPECT_NEAR(std::abs(area), 1.0 / (k * k), 1e-12);
      const double share = 1.0 / (k * k);
      mean_y += share * (a.y + b.y + c.y) / 3;
      mean_z += share * (a.z + b.z + c.z) / 3;
      for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})  // exact for quadratics
        mean_yz += share / 3 * (p.y + q.y) / 2 * (p.z + q.z) / 2;
    }
    EXPECT_NEAR(mean_y, 1.0 / 3, 1e-12);
    EXPECT_NEAR(mean_z, 1.0 / 3, 1e-12);
    EXPECT_NEAR(mean_yz, 1.0 / 12, 1e-12);
  }
}

}  // namespace
}  // namespace vsgl
