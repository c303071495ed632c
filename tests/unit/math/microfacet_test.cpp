#include "math/microfacet.h"

#include <gtest/gtest.h>

#include "quadrature.h"

namespace vsgl {
namespace {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;
using test::pi;

// Integral of D(h) f(cos(h)) over the hemisphere; sin = s^2 resolves the peak.
template <class F>
double normals_integral(std::uint32_t ndf, double alpha, F f) {
  constexpr int count = 20000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) / count, sin2 = s * s * s * s, cosine = std::sqrt(1 - sin2);
    sum += ndf_density(ndf, alpha * alpha, sin2, 1 - sin2) * f(cosine) * 2 * pi * 2 * s * s * s /
           (cosine * count);
  }
  return sum;
}

TEST(Microfacet, DensitiesCoverUnitArea) {
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double alpha : {0.006, 0.1, 0.5, 1.0})
      EXPECT_NEAR(normals_integral(ndf, alpha, [](double c) { return c; }), 1, 1e-4) << ndf << " " << alpha;
}

TEST(Microfacet, SmithLambdaIsTheProjectedAreaOfTheNormals) {
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN})
    for (const double alpha : {0.1, 0.5, 1.0})
      for (const double degrees : {0.0, 45.0, 75.0, 87.0}) {
        const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
        const double area = normals_integral(ndf, alpha, [&](double z) {
          return test::azimuth_mean_above(c * z, s * std::sqrt(1 - z * z), 1);
        });
        EXPECT_NEAR(c * (1 + smith_lambda(ndf, alpha * alpha, c)) / area, 1, 1e-2)
            << ndf << " " << alpha << " " << degrees;
      }
}

TEST(Microfacet, BrdfIsReciprocalAndLosesNoMoreThanMasking) {
  const Vec3 n{0, 0, 1}, a = normalise(Vec3{0.8, 0.1, 0.3}), b = normalise(Vec3{-0.5, 0.4, 0.6});
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double alpha : {0.05, 0.3, 1.0}) {
      EXPECT_NEAR(
          specular_brdf_cos(ndf, alpha, n, a, b) * a.z / (specular_brdf_cos(ndf, alpha, n, b, a) * b.z), 1,
          1e-12);
      const test::SpecularReference reference(ndf, alpha, a);
      const double albedo = 4 * pi * reference.integral(n, 0);  // under light from everywhere
      EXPECT_LT(albedo, 1.003);
      EXPECT_GT(albedo, 0.3);
    }
  EXPECT_EQ(specular_brdf_cos(NDF_GGX, 0.2, n, a, {0.6, 0, -0.8}), 0);
}

// Mean absolute error of the SG against D / D(0), cosine-weighted.
double sharpness_error(std::uint32_t ndf, double alpha, double sharpness) {
  constexpr int count = 20000;
  double error = 0, total = 0;
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) / count, c = 1 - s * s * s * s, weight = c * s * s * s;
    const double d =
        ndf_density(ndf, alpha * alpha, 1 - c * c, c * c) / ndf_density(ndf, alpha * alpha, 0, 1);
    error += std::abs(d - std::exp(sharpness * (c - 1))) * weight;
    total += d * weight;
  }
  return error / total;
}

TEST(Microfacet, SharpnessFitsTheDensityNoWorseThanThePapers) {
  for (const double alpha : {0.1, 0.3, 0.5, 0.7, 1.0}) {
    const double papers = sharpness_error(NDF_GGX, alpha, 2 / (alpha * alpha));
    EXPECT_LT(sharpness_error(NDF_GGX, alpha, ndf_sharpness(NDF_GGX, alpha)), papers + 0.004) << alpha;
    EXPECT_LT(sharpness_error(NDF_BECKMANN, alpha, ndf_sharpness(NDF_BECKMANN, alpha)),
              sharpness_error(NDF_BECKMANN, alpha, 2 / (alpha * alpha)) + 0.004)
        << alpha;
  }
  for (const double n : {1.0, 4.0, 16.0, 64.0, 1023.0}) {
    const double alpha = std::sqrt(2 / (n + 2));
    EXPECT_LT(sharpness_error(NDF_PHONG, alpha, ndf_sharpness(NDF_PHONG, alpha)),
              sharpness_error(NDF_PHONG, alpha, n) + 1e-3)
        << n;
  }
  EXPECT_EQ(ndf_sharpness(NDF_GGX, 1), 1e-3);
}

TEST(Microfacet, ReflectedLobePointsToTheMirrorDirection) {
  const Vec3 n = normalise(Vec3{1, 2, 3}), view = normalise(Vec3{0.2, 0.1, 1});
  const SgLobe lobe = specular_lobe(NDF_BECKMANN, 0.1, n, view);
  EXPECT_NEAR(dot(normalise(lobe.axis + view), n), 1, 1e-12);
  EXPECT_NEAR(lobe.sharpness, 200 / (4 * dot(n, view)), 0.1);
  EXPECT_NEAR(dot(dominant_normal(0.25, n, n), n), 1, 1e-12);
  // At grazing view the dominant normal leans towards the view.
  const Vec3 grazing = normalise(Vec3{1, 0, 0.05});
  EXPECT_GT(dominant_normal(0.25, {0, 0, 1}, grazing).x, 0.3);
}

}  // namespace
}  // namespace vsgl
