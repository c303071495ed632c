#include "report/planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace vsgl::report {
namespace {

constexpr int kWidth = 37, kHeight = 23;
constexpr std::size_t kCount = kWidth * kHeight;

// Smooth, with noise of five decades and both signs.
PlaneValues noisy(unsigned seed, float scale) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> decade(-4, 1);
  PlaneValues out(kCount);
  for (std::size_t i = 0; i < kCount; ++i)
    out[i] = scale * (i % 5 == 0 ? -1.0f : 1.0f) * std::pow(10.0f, decade(random));
  return out;
}

PlaneValues round_trip(const PlaneValues& plane) {
  return decode(encode({&plane, 1}, kWidth, kHeight), 1, kWidth, kHeight).front();
}

TEST(Planes, KeepElevenBitsAtAnyScale) {
  for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e9f, 1e30f}) {
    const PlaneValues plane = noisy(1, scale), back = round_trip(plane);
    for (std::size_t i = 0; i < kCount; ++i)
      ASSERT_LE(std::abs(back[i] - plane[i]), std::ldexp(std::abs(plane[i]), -11)) << plane[i];
  }
}

TEST(Planes, KeepSmallValuesBesideLargeOnes) {
  PlaneValues plane(kCount, 1e-7f);
  plane[3] = 1;
  const PlaneValues back = round_trip(plane);
  EXPECT_EQ(back[3], 1);
  EXPECT_NEAR(back[0], 1e-7f, std::ldexp(1.0, -40));
}

TEST(Planes, KeepZerosAndWhatIsNotFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  PlaneValues plane = noisy(2, 1);
  plane[0] = 0;
  plane[50] = std::nanf("");
  plane[51] = kInfinity;
  plane[52] = -kInfinity;
  const PlaneValues back = round_trip(plane);
  EXPECT_EQ(back[0], 0);
  EXPECT_TRUE(std::isnan(back[50]));
  EXPECT_EQ(back[51], kInfinity);
  EXPECT_EQ(back[52], -kInfinity);
  EXPECT_EQ(round_trip(PlaneValues(kCount, 0)), PlaneValues(kCount, 0));
}

TEST(Planes, SeveralPlanesStayApart) {
  const std::vector<PlaneValues> planes = {noisy(3, 1), noisy(4, 100), PlaneValues(kCount, 2)};
  const auto back = decode(encode(planes, kWidth, kHeight), 3, kWidth, kHeight);
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t i = 0; i < kCount; ++i)
      ASSERT_NEAR(back[p][i], planes[p][i], std::ldexp(std::abs(planes[p][i]), -11));
}

TEST(Planes, EqualImagesTakeNoRoom) {
  EXPECT_LT(encode({std::vector<PlaneValues>(3, PlaneValues(kCount, 0))}, kWidth, kHeight).bytes.size(), 60u);
}

// What the page shows of a test: the stored reference plus the stored difference.
struct Shown {
  PlaneValues test, error;
  Shown(const PlaneValues& a, const PlaneValues& b) {
    const PlaneValues stored = round_trip(b), difference = round_trip(difference_from(a, b));
    for (std::size_t i = 0; i < kCount; ++i)
      test.push_back(std::isfinite(stored[i]) ? stored[i] + difference[i] : difference[i]);
    error = difference;
  }
};

TEST(Differences, SmallErrorsAreExactToThreeDigits) {
  const PlaneValues b = noisy(5, 1);
  PlaneValues a = b;
  for (std::size_t i = 0; i < kCount; ++i) a[i] *= 1 + 1e-5f * static_cast<float>(1 + i % 7);
  const Shown shown(a, b);
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_NEAR(shown.error[i], a[i] - b[i], std::ldexp(std::abs(a[i] - b[i]), -9));
}

TEST(Differences, TestsAreKnownWithinTheLargerSide) {
  const PlaneValues a = noisy(6, 1), b = noisy(7, 1);
  const Shown shown(a, b);
  for (std::size_t i = 0; i < kCount; ++i) {
    const float larger = std::max(std::abs(a[i]), std::abs(b[i]));
    ASSERT_NEAR(shown.test[i], a[i], std::ldexp(larger, -9));
    ASSERT_NEAR(shown.error[i], a[i] - b[i], std::ldexp(std::abs(a[i] - b[i]), -9));
  }
}

TEST(Differences, BlackStaysBlack) {
  const PlaneValues b = noisy(8, 1);
  EXPECT_EQ(Shown(PlaneValues(kCount, 0), b).test, PlaneValues(kCount, 0));
}

TEST(Differences, WhatIsNotFiniteOnEitherSideIsKept) {
  PlaneValues a = noisy(9, 1), b = noisy(10, 1);
  a[4] = std::nanf("");
  b[5] = std::nanf("");
  const Shown shown(a, b);
  EXPECT_TRUE(std::isnan(shown.test[4]));
  EXPECT_NEAR(shown.test[5], a[5], std::ldexp(std::abs(a[5]), -11));
}

}  // namespace
}  // namespace vsgl::report
