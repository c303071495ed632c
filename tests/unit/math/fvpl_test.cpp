// The filtered virtual point light: limits, energy, and a square of emitters by quadrature.

#include "math/fvpl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "math/interop_vec.h"
#include "quadrature.h"

namespace vsgl {
namespace {

using interop::Cluster, interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_NONE, interop::NDF_PHONG;
using test::pi;

constexpr std::uint32_t kNdfs[] = {NDF_NONE, NDF_GGX, NDF_BECKMANN, NDF_PHONG};
constexpr Vec3 kUp{0, 0, 1};

// At the origin, facing +z, of one watt of each kind of power.
Cluster cluster(double variance, double normal_sharpness, std::uint32_t ndf, double alpha,
                Vec3 incident = kUp, double lobe_variance = 0, double facet_turn = 0) {
  Cluster c{};
  c.inverse_variance = static_cast<float>(1 / variance);
  c.normal = to_float(kUp);
  c.normal_sharpness = static_cast<float>(normal_sharpness);
  c.diffuse.x = static_cast<float>(1 / pi);
  c.ndf = ndf;
  if (ndf == NDF_NONE) return c;
  const double alpha2 = alpha * alpha, cosine = incident.z;
  c.shading_normal = to_float(kUp);
  c.incident = to_float(incident);
  c.incident_masking = static_cast<float>(1 + smith_lambda(ndf, alpha2, cosine));
  c.facet_turn = static_cast<float>(facet_turn);
  c.alpha2 = static_cast<float>(alpha2 + lobe_variance);
  c.masking_alpha2 = static_cast<float>(alpha2);
  c.specular.y = static_cast<float>((ndf == NDF_GGX ? 1 / pi : 1) / (4 * cosine));
  return c;
}

std::vector<Vec3> receivers_towards() {
  std::vector<Vec3> out;
  for (const double tilt : {0.0, 0.5, 1.1, 1.5, 2.2})
    for (const double turn : {0.0, 1.0, 3.0})
      out.push_back({std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
  return out;
}

TEST(Fvpl, EmitsAsTheExactPointInTheLimit) {
  const Vec3 incident = normalise(Vec3{0.6, 0.1, 0.7});
  for (const std::uint32_t ndf : kNdfs)
    for (const Vec3 w : receivers_towards()) {
      const Cluster c = cluster(1e-12, 1e9, ndf, 0.3, incident);
      const Vec3 exact{std::max(w.z, 0.0) / pi,
                       ndf == NDF_NONE ? 0 : specular_brdf_cos(ndf, 0.3, kUp, incident, w), 0};
      for (const Vec3 found : {fvpl_emission(c, -w, 1), fvpl_emission_flat(c, -w, 1)})
        EXPECT_LT(length(found - exact), 1e-5 * (1 + length(exact))) << ndf;
      EXPECT_NEAR(fvpl_emission_diffuse(c, -w).x, exact.x, 1e-7);
    }
}

TEST(Fvpl, ReceivesFromAPointInTheLimit) {
  for (const std::uint32_t ndf : kNdfs)
    for (const Vec3 u : receivers_towards()) {
      const SpecularReceiver r = specular_receiver(ndf, 0.3, kUp, normalise(Vec3{0.6, 0.1, 0.7}));
      const double distance = 3, inverse_variance = 1e12;
      const FvplView view = fvpl_view(distance * u, inverse_variance);
      ASSERT_TRUE(fvpl_is_point(view.sharpness, r.across));
      const Cluster c = cluster(1 / inverse_variance, 1e9, NDF_NONE, 1);
      const FvplReflection point = fvpl_point(r, c, view), all = fvpl_extended(r, c, view);
      EXPECT_NEAR(all.diffuse, point.diffuse, 1e-6);
      EXPECT_NEAR(all.specular, point.specular, 1e-5 * (1 + point.specular)) << ndf;
    }
}

TEST(Fvpl, StaysFiniteInItsOwnPlace) {
  for (const std::uint32_t ndf : kNdfs)
    for (const double variance : {1e-12, 1e-3, 1e9}) {
      const Cluster c = cluster(variance, 3, ndf, 0.3);
      const FvplView view = fvpl_view({}, 1 / variance);
      const FvplReflection f = fvpl_extended(specular_receiver(ndf, 0.3, kUp, kUp), c, view);
      EXPECT_TRUE(
          std::isfinite(length(fvpl_emission(c, view.u, view.inverse_d2)) * (f.diffuse + f.specular)));
      EXPECT_DOUBLE_EQ(fvpl_fluence(0, 1 / variance), 2 / variance);
    }
}

// The emitted power: all of the diffuse power however the normals spread; of the specular power a share that
// a wider lobe may exceed, since masking is that of the surface itself: at most (1 + Lambda of the widened
// lobe) / (1 + Lambda of the surface) of the direction to the source (Phong, whose Lambda is Beckmann's: 7%
// more).
TEST(Fvpl, EmitsNoMoreThanItsPower) {
  constexpr int kRows = 400, kColumns = 100;
  const auto power = [](const Cluster& c) {
    Vec3 sum;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < kColumns; ++j) {
        const double z = 1 - (2 * i + 1.0) / kRows, r = std::sqrt(1 - z * z), turn = 2 * pi * j / kColumns;
        sum += fvpl_emission(c, {-r * std::cos(turn), -r * std::sin(turn), -z}, 1);
      }
    return sum * (4 * pi / (kRows * kColumns));
  };
  for (const double normal_sharpness : {0.5, 5.0, 60.0, 1e6})
    EXPECT_NEAR(power(cluster(1e-3, normal_sharpness, NDF_NONE, 1)).x, 1, 2e-3) << normal_sharpness;
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double tilt : {0.0, 0.8, 1.3})
      for (const double lobe_variance : {0.0, 0.05, 0.5}) {
        const double alpha = 0.4, wide = alpha * alpha + lobe_variance, cosine = std::cos(tilt);
        const Cluster c = cluster(1e-6, 1e6, ndf, alpha, {std::sin(tilt), 0, cosine}, lobe_variance);
        const double excess =
            (1 + smith_lambda(ndf, wide, cosine)) / (1 + smith_lambda(ndf, alpha * alpha, cosine));
        EXPECT_LT(power(c).y, 1.08 * excess) << ndf << " " << tilt << " " << lobe_variance;
        EXPECT_GT(power(c).y, 0.4) << ndf << " " << tilt << " " << lobe_variance;
      }
}

// One watt of GGX texels of a plane that faces up, with a shading normal of their own.
Cluster bumped(Vec3 shading_normal, Vec3 incident, double alpha, double lobe_variance, double facet_turn) {
  Cluster c = cluster(1e-12, 1e9, NDF_GGX, alpha, incident, lobe_variance, facet_turn);
  const double cosine = dot(shading_normal, incident);
  c.shading_normal = to_float(shading_normal);
  c.incident_masking = static_cast<float>(1 + smith_lambda(NDF_GGX, alpha * alpha, cosine));
  c.specular.y = static_cast<float>(1 / (4 * pi * cosine));
  return c;
}

// A patch of normals with Gaussian slopes as one cluster, against the sum over its texels.
struct PatchError {
  double mean, l1;  // over the upper hemisphere, relative
};
PatchError rough_patch(double alpha, double slope_deviation, double facet_turn) {
  constexpr int kNormals = 400, kRows = 20, kColumns = 40;
  std::mt19937_64 generator(1);
  std::normal_distribution<double> slope(0, slope_deviation);
  const Vec3 incident = normalise(Vec3{0.5, 0, 1});
  std::vector<Cluster> texels;
  Vec3 sum;
  while (texels.size() < kNormals) {
    const Vec3 n = normalise(Vec3{slope(generator), slope(generator), 1});
    if (dot(n, incident) < 0.1) continue;
    texels.push_back(bumped(n, incident, alpha, 0, 0));
    sum += n;
  }
  const double length_of_mean = length(sum) / kNormals, deficit = 1 - length_of_mean * length_of_mean;
  const double turn = facet_turn * deficit / (alpha * alpha + deficit);
  const Cluster patch = bumped(normalise(sum), incident, alpha, deficit, turn);
  double total = 0, found = 0, difference = 0;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const double z = (i + 0.5) / kRows, r = std::sqrt(1 - z * z), azimuth = 2 * pi * j / kColumns;
      const Vec3 u{-r * std::cos(azimuth), -r * std::sin(azimuth), -z};
      double exact = 0;
      for (const Cluster& texel : texels) exact += fvpl_emission_flat(texel, u, 0).y / kNormals;
      const double emitted = fvpl_emission_flat(patch, u, 0).y;
      total += exact;
      found += emitted;
      difference += std::abs(emitted - exact);
    }
  return {found / total, difference / total};
}

// Seen by their mean normal, patches shine too much towards grazing directions.
TEST(Fvpl, NormalsThatSpreadReflectByThoseThatTurnedToTheHalfVector) {
  for (const double alpha : {0.1, 0.2, 0.4})
    for (const double deviation : {0.2, 0.35}) {
      const PatchError turned = rough_patch(alpha, deviation, 0.6),
                       straight = rough_patch(alpha, deviation, 0);
      std::printf("alpha %.1f, slopes %.2f: mean %.3f (by the mean normal %.3f), L1 %.3f (%.3f)\n", alpha,
                  deviation, turned.mean, straight.mean, turned.l1, straight.l1);
      EXPECT_LT(turned.l1, 0.8 * straight.l1);
      EXPECT_NEAR(turned.mean, 1, 0.12);
    }
}

// A square of side 1 in the plane z = 0 by 32x32 points that share one watt.
struct Square {
  static constexpr int kSide = 32;
  double variance = (1 - 1.0 / (kSide * kSide)) / 12;  // per axis

  template <class Function>
  double sum(Function at) const {
    double total = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) total += at(Vec3{(i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5, 0});
    return total / (kSide * kSide);
  }
};

// Relative error of the sum over receivers all around, at one distance.
struct SquareError {
  double diffuse = 0, specular = 0;
};

// Of L1 norms. Receivers face the square's centre, lean by 0.6, and look from the side.
SquareError lambert_square(double distance, double alpha) {
  const Square square;
  const Cluster c = cluster(square.variance, 1e9, NDF_NONE, 1), texel = cluster(1e-12, 1e9, NDF_NONE, 1);
  double difference[2] = {}, total[2] = {};
  for (const Vec3 w : receivers_towards()) {
    if (w.z < 0.3) continue;
    for (const double lean : {-0.6, 0.0, 0.6}) {
      const Vec3 position = distance * w, normal = normalise(-w + lean * Vec3{0, 1, 0});
      const Vec3 mirrored = 2 * dot(-w, normal) * normal + w;
      const SpecularReceiver r = specular_receiver(NDF_GGX, alpha, normal, mirrored);
      const FvplView view = fvpl_view(-position, 1 / square.variance);
      const FvplReflection f = fvpl_extended(r, c, view);
      const double emitted = fvpl_emission(c, view.u, view.inverse_d2).x;
      const auto exact = [&](auto part) {
        return square.sum([&](Vec3 point) {
          const FvplView to_texel = fvpl_view(point - position, 1e12);
          return std::max(-to_texel.u.z, 0.0) / pi * part(fvpl_point(r, texel, to_texel));
        });
      };
      const double diffuse = exact([](FvplReflection x) { return x.diffuse; });
      const double specular = exact([](FvplReflection x) { return x.specular; });
      difference[0] += std::abs(emitted * f.diffuse - diffuse);
      difference[1] += std::abs(emitted * f.specular - specular);
      total[0] += diffuse;
      total[1] += specular;
    }
  }
  return {difference[0] / total[0], difference[1] / total[1]};
}

// Measured: what the table in docs/shading.md states, rounded up.
TEST(Fvpl, StandsForASquareOfLambertEmitters) {
  struct Row {
    double distance, diffuse, broad, narrow;
  };
  std::printf("distance / side  diffuse  alpha 0.5  alpha 0.1\n");
  for (const Row row : {Row{0.5, 0.27, 0.39, 0.5},
                        {1, 0.024, 0.18, 0.36},
                        {2, 0.0022, 0.055, 0.18},
                        {4, 2e-4, 0.0135, 0.053},
                        {8, 5e-5, 0.0028, 0.018}}) {
    const SquareError broad = lambert_square(row.distance, 0.5), narrow = lambert_square(row.distance, 0.1);
    std::printf("%-16g %7.4f  %9.4f  %9.4f\n", row.distance, broad.diffuse, broad.specular, narrow.specular);
    EXPECT_LT(broad.diffuse, row.diffuse);
    EXPECT_LT(broad.specular, row.broad);
    EXPECT_LT(narrow.specular, row.narrow);
  }
}

// Irradiance from specular emitters in parallel light on receivers that face them, around the mirror
// direction: L1 error.
double specular_square(std::uint32_t ndf, double alpha, double tilt, double distance) {
  const Square square;
  const Vec3 incident{std::sin(tilt), 0, std::cos(tilt)}, mirrored{-incident.x, 0, incident.z};
  const Cluster c = cluster(square.variance, 1e9, ndf, alpha, incident);
  double difference = 0, total = 0;
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0})
    for (const double y : {0.0, 0.5, 1.0}) {
      const Vec3 w = normalise(mirrored + alpha * Vec3{x, y, 0});
      const double exact = square.sum([&](Vec3 point) {
        const Vec3 v = distance * w - point;
        return specular_brdf_cos(ndf, alpha, kUp, incident, normalise(v)) / dot(v, v);
      });
      const FvplView view = fvpl_view(-distance * w, 1 / square.variance);
      difference += std::abs(fvpl_emission(c, view.u, view.inverse_d2).y * view.inverse_d2 - exact);
      total += exact;
    }
  return difference / total;
}

// Measured, rounded up. Half the widening errs by more, and twice of it for lobes of Gaussian slopes; GGX's
// core would take up to twice of it where the spread exceeds its own width.
TEST(Fvpl, WidensTheLobeAsASquareOfSpecularEmittersDoes) {
  struct Row {
    std::uint32_t ndf;
    double distance, broad, oblique, narrow;
  };
  constexpr Row kRows[] = {{NDF_GGX, 2, 0.05, 0.08, 0.33},          {NDF_GGX, 4, 0.011, 0.021, 0.1},
                           {NDF_GGX, 8, 0.0025, 0.0052, 0.022},     {NDF_BECKMANN, 2, 0.021, 0.03, 0.12},
                           {NDF_BECKMANN, 4, 0.006, 0.0085, 0.018}, {NDF_BECKMANN, 8, 0.0015, 0.0022, 0.0043},
                           {NDF_PHONG, 2, 0.023, 0.035, 0.12},      {NDF_PHONG, 4, 0.0063, 0.0097, 0.018},
                           {NDF_PHONG, 8, 0.0016, 0.0026, 0.0043}};
  for (const Row& row : kRows) {
    SCOPED_TRACE(testing::Message() << "NDF " << row.ndf << " distance " << row.distance);
    EXPECT_LT(specular_square(row.ndf, 0.3, 0.3, row.distance), row.broad);
    EXPECT_LT(specular_square(row.ndf, 0.3, 0.8, row.distance), row.oblique);
    EXPECT_LT(specular_square(row.ndf, 0.1, 0.3, row.distance), row.narrow);
  }
}

}  // namespace
}  // namespace vsgl
