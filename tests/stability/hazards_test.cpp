// The hazards of float32 one by one: what the library's form keeps and the form before does not.

#include <gtest/gtest.h>

#include "extended.h"
#include "hazard.h"
#include "interop/model.h"

namespace vsgl::test {
namespace {

Row tilted(double angle) {
  // In no plane of coordinates, so that no component is exact.
  const Vec3 z = normalise(Vec3{0.36, -0.48, 0.8}), x = normalise(cross(Vec3{0, 1, 0}, z));
  return direction(std::cos(angle) * z + std::sin(angle) * x);
}

std::vector<Row> joined(std::initializer_list<Row> parts) {
  std::vector<Row> one{{}};
  for (const Row& part : parts) one[0].insert(one[0].end(), part.begin(), part.end());
  return one;
}

void append(std::vector<Row>& rows, const std::vector<Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

// Half vectors within a few widths of a lobe, as squared sine and cosine.
std::vector<Row> lobe_angles(std::initializer_list<double> alphas) {
  std::vector<Row> rows;
  for (const double alpha : alphas)
    for (const double t : {0.0, 0.3, 0.7, 1.0, 1.9}) {
      const double tan2 = alpha * alpha * t * t, cos2 = 1 / (1 + tan2);
      rows.push_back(
          {static_cast<float>(alpha * alpha), static_cast<float>(tan2 * cos2), static_cast<float>(cos2)});
    }
  return rows;
}

TEST(HazardA, SmoothGgxLosesItsCosine) {
  expect_tamed({"A: density of GGX, a = 0.001 to 0.1",
                lobe_angles({1e-3, 1e-2, 0.1}),
                {"microfacet", "ggx_d"},
                before_ggx,
                1,
                0,
                [](Arguments& a) {
                  const long double alpha2 = a.take(), sin2 = a.take(), cos2 = a.take();
                  const long double q = (sin2 + alpha2 * cos2) / (sin2 + cos2);
                  return alpha2 / (extended_pi * q * q);
                },
                {3e-6, 0}});
}

TEST(HazardA, SmoothPhongLosesItsCosine) {
  expect_tamed({"A: density of Phong, n up to 65535",
                lobe_angles({std::sqrt(2 / 65537.0), std::sqrt(2 / 1025.0)}),
                {"microfacet", "phong_d"},
                before_phong,
                1,
                0,
                [](Arguments& a) {
                  const long double alpha2 = a.take(), sin2 = a.take(), cos2 = a.take();
                  return std::exp((1 / alpha2 - 1) * std::log1p(-sin2 / (sin2 + cos2))) /
                         (extended_pi * alpha2);
                },
                {1e-5, 0}});
}

// Receiver, light and sharpness as specular_filter takes them: alpha = 1, light without direction, grazing
// views.
TEST(HazardA, FilteredRoughnessDividesInfinities) {
  std::vector<Row> rows;
  for (const double alpha : {0.02f, 0.3f, 1.0f})
    for (const double cosine : {1.0, 0.3, 0.05}) {
      const double sine = std::sqrt(1 - cosine * cosine);
      append(rows, combinations({words({interop::NDF_GGX}),
                                 numbers({alpha}),
                                 {{0, 0, 1}},
                                 {direction({sine, 0, cosine})},
                                 {direction({-sine, 0, cosine}), direction({-sine, 0.01, cosine + 0.02})},
                                 numbers({0, 1, 300, 1e6, 1e12})}));
    }
  expect_tamed({"A: filtered density, alpha to 1, sharpness 0 to 1e12",
                rows,
                {"specular_lobe", "specular_filter"},
                before_filter,
                2,
                0,
                [](Arguments& a) {
                  a.take_word();
                  const double alpha = a.take();
                  a.take3();
                  const ExtendedVec3 view = extend(a.take3()), light = extend(a.take3());
                  const long double l = a.take(), alpha2 = static_cast<float>(alpha * alpha);
                  const long double c = std::max(view.z, 1e-4L);
                  const auto m = [&](long double slope) {  // F / (1 + F), F = a^2 / (1 - a^2) + slope / (2 l)
                    if (alpha2 == 1 || l == 0) return 1.0L;
                    const long double f = alpha2 / (1 - alpha2) + slope / (2 * l);
                    return f / (1 + f);
                  };
                  const ExtendedVec3 h = normalise(ExtendedVec3{std::hypot(view.x, view.y), 0, c} + light);
                  const long double par = m(1), perp = m(1 / (c * c));
                  const long double q = h.x * h.x / par + h.y * h.y / perp + h.z * h.z;
                  return 1 / (extended_pi * std::sqrt(par * perp) * q * q);
                },
                {2e-4, 0}});
}

long double exact_sg(Arguments& a) {
  const ExtendedVec3 w = normalise(extend(a.take3())), axis = normalise(extend(a.take3()));
  return std::exp(a.take() * (dot(w, axis) - 1));
}

TEST(HazardC, ExponentOfASharpLobeCancels) {
  std::vector<Row> rows;
  for (const double l : {1e4, 1e6, 1e8})
    for (const double exponent : {0.0, 0.1, 1.0, 5.0})
      append(rows, joined({tilted(0.3), tilted(0.3 + std::sqrt(2 * exponent / l)), {static_cast<float>(l)}}));
  expect_tamed({"C: value of an SG, sharpness 1e4 to 1e8",
                rows,
                {"sg", "sg_value"},
                before_sg,
                1,
                0,
                exact_sg,
                {5e-6, 0}});
}

TEST(HazardC, ExponentOfASharpProductCancels) {
  std::vector<Row> rows;
  for (const double l : {1e4, 1e6, 1e8})
    for (const double ratio : {1.0, 0.3, 1e-3})
      for (const double exponent : {0.01, 1.0, 9.0}) {
        const double angle = std::sqrt(2 * exponent * (1 + ratio) / (ratio * l));
        append(rows, joined({tilted(0.3),
                             {static_cast<float>(l)},
                             tilted(0.3 + angle),
                             {static_cast<float>(ratio * l)}}));
      }
  expect_tamed({"C: exponent of a product, sharpness 1e4 to 1e8",
                rows,
                {"sg", "sg_product", 4},
                before_product,
                2,
                1,
                [](Arguments& a) {
                  const ExtendedVec3 axis1 = normalise(extend(a.take3()));
                  const long double l1 = a.take();
                  const ExtendedVec3 axis2 = normalise(extend(a.take3()));
                  return extended_product(axis1, l1, axis2, a.take()).exponent;
                },
                {0, 1e-5}});
}

TEST(HazardC, OpposedLobesCancel) {
  std::vector<Row> rows;
  for (const double gap : {1e-2, 1e-3, 1e-5})
    for (const float l : {3.7f, 5100.3f})
      append(rows, joined({tilted(0.3), {l}, tilted(0.3 + std::numbers::pi - gap), {l}}));
  expect_tamed({"C: sharpness of opposed lobes",
                rows,
                {"sg", "sg_product", 3},
                before_product,
                2,
                0,
                [](Arguments& a) {
                  const ExtendedVec3 axis1 = extend(a.take3());
                  const long double l1 = a.take();
                  const ExtendedVec3 axis2 = extend(a.take3());
                  return extended_product(axis1, l1, axis2, a.take()).sharpness;
                },
                {1e-6, 0}});
}

// The least eigenvalue nu m by bisection of the secular equation.
long double exact_asg_exponent(Arguments& a) {
  const ExtendedVec3 light = normalise(extend(a.take3()));
  const long double eta_x = a.take(), eta_y = a.take(), nu = a.take();
  long double low = 0, high = light.x * light.x + light.y * light.y;
  for (int i = 0; i < 120; ++i) {
    const long double m = 0.5L * (low + high);
    const long double right = light.x * light.x * eta_x / (eta_x + nu * (1 - m)) +
                              light.y * light.y * eta_y / (eta_y + nu * (1 - m));
    (right > m ? low : high) = m;
  }
  return nu * low;
}

TEST(HazardD, LeastEigenvalueDrowns) {
  std::vector<Row> rows;
  for (const double nu : {1e4, 1e6, 1e8})
    for (const double eta : {100.0, 1e4, 1e6})
      for (const double exponent : {0.1, 1.0, 6.0}) {
        const double angle = std::sqrt(exponent * (1 / nu + 1 / eta));
        append(rows,
               joined({direction({0.6 * angle, 0.8 * angle, 1}),
                       {static_cast<float>(4 * eta), static_cast<float>(eta), static_cast<float>(nu)}}));
      }
  expect_tamed({"D: exponent of two anisotropic SGs",
                rows,
                {"reflected_lobe", "asg_product", 3},
                before_asg_exponent,
                1,
                0,
                exact_asg_exponent,
                {2e-5, 2e-5}});
}

// What encoding gives, decoded from the length of the mean alone and with the deficit.
TEST(HazardE, SharpnessFromAMeanLength) {
  const std::vector<Row> lobes = combinations({{tilted(0.3)}, powers(0.1, 1.1e10, 10)});
  gpu::Device device = make_test_device();
  const std::vector<float> encoded = call_library(device, "lobe", "lobe_encode", lobes, 4);
  std::vector<Row> rows;
  std::vector<long double> sharpness;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    rows.push_back(
        {encoded.begin() + static_cast<long>(4 * i), encoded.begin() + static_cast<long>(4 * i + 4)});
    sharpness.push_back(lobes[i][3]);
  }
  std::size_t next = 0;
  expect_tamed({"E: sharpness through its moments, 0.1 to 1e10",
                rows,
                {"lobe", "lobe_decode", 3},
                before_sharpness,
                1,
                0,
                [&](Arguments&) { return sharpness[next++]; },
                {1e-5, 0}});
}

TEST(HazardF, NarrowConesHaveNoHeight) {
  expect_tamed({"F: solid angle of a disk, r/d = 1e-5 to 1",
                combinations({numbers({1, 37.3}), powers(1e-10, 1, 10)}),
                {"vsgl", "disk_cone"},
                before_solid_angle,
                1,
                0,
                [](Arguments& a) {
                  const long double d = a.take(), radius2 = a.take(), s = std::sqrt(d * d + radius2);
                  return 2 * extended_pi * radius2 / (s * (s + d));
                },
                {2e-6, 0}});
}

TEST(HazardF, IntegralOfABroadLobe) {
  std::vector<Row> rows = powers(1e-12, 1e12, 10);
  rows.push_back({0});
  expect_tamed({"F: integral of an SG, sharpness 0 to 1e12",
                rows,
                {"sg", "sg_integral"},
                before_sg_integral,
                1,
                0,
                [](Arguments& a) { return extended_sg_integral(a.take()); },
                {1e-6, 0}});
}

TEST(HazardF, CosineUnderABroadLobe) {
  std::vector<Row> rows;
  for (const float l : {0.0f, 1e-6f, 1e-4f, 1e-3f, 0.01f})
    for (const float c : {-1.0f, -0.3f, 0.4f, 1.0f}) rows.push_back({c, l});
  expect_tamed({"F: clamped cosine, sharpness 0 to 0.01",
                rows,
                {"sg", "cosine_mean"},
                before_cosine_mean,
                1,
                0,
                // To the second order: the mean of max(w.n, 0) (1 + l w.x) over that of (1 + l w.x).
                [](Arguments& a) {
                  const long double c = a.take(), l = a.take();
                  return 0.25L + l * c / 6;
                },
                {0, 1e-4}});
}

// Lights at 1e-3 to 1e3 m, as vsgl_incoming takes them; not fainter than e^-14, and not so small against
// their distance that extended precision fails, too.
std::vector<Row> lights(std::initializer_list<double> variances, std::initializer_list<double> sharpnesses) {
  std::vector<Row> rows;
  for (const double d : {1e-3, 0.1, 3.0, 1e3})
    for (const double variance : variances)
      for (const double sharpness : sharpnesses)
        for (const double exponent : {0.0, 1.0, 12.0}) {
          if (d * d > 1e13 * variance && variance > 0) continue;
          const double angle =
              std::min(std::sqrt(2 * exponent / std::max(sharpness, 1e-9)), std::numbers::pi);
          const Row axis = tilted(0.2), at = tilted(0.2 + angle);
          append(rows,
                 joined({{static_cast<float>(-d * double{at[0]}), static_cast<float>(-d * double{at[1]}),
                          static_cast<float>(-d * double{at[2]})},
                         {static_cast<float>(variance)},
                         axis,
                         {static_cast<float>(sharpness)}}));
        }
  return rows;
}

long double exact_fluence(Arguments& a) {
  const Vec3 v = a.take3();
  const double variance = a.take();
  const Vec3 axis = a.take3();
  return extended_fluence(v, variance, axis, a.take());
}

TEST(HazardG, LightOfASmallCluster) {
  expect_tamed({"G: light of a cluster, variance 1e-12 to 1e4",
                lights({1e-12, 1e-8, 1e-3, 1, 1e4}, {0, 2.2925, 100, 1e4}),
                {"vsgl", "vsgl_incoming", 4},
                before_fluence,
                1,
                0,
                exact_fluence,
                {3e-5, 0}});
}

TEST(HazardG, LightOfAPoint) {
  expect_tamed({"G: light of a point",
                lights({0}, {0, 2.2925, 100, 1e4}),
                {"vsgl", "vsgl_incoming", 4},
                before_fluence,
                1,
                0,
                exact_fluence,
                {3e-5, 0}});
}

TEST(HazardG, ReceiverInTheMiddleOfTheLight) {
  std::vector<Row> rows = combinations({{{0, 0, 0}, {1e-20f, 0, 0}, {0, 1e-22f, -3e-23f}},
                                        numbers({1e-6, 0.3, 1e4}),
                                        {tilted(0.2)},
                                        numbers({0, 2.2925, 1e4})});
  expect_tamed({"H: receiver in the middle of the light",
                rows,
                {"vsgl", "vsgl_incoming", 4},
                before_fluence,
                1,
                0,
                exact_fluence,
                {3e-5, 0}});
}

TEST(HazardH, FactorsOverflow) {
  std::vector<Row> rows;
  for (const double l : {80.0, 100.0, 1e3, 1e5})
    for (const double exponent : {0.0, 1.0, 5.0})
      append(rows, joined({tilted(0.3), tilted(0.3 + std::sqrt(2 * exponent / l)), {static_cast<float>(l)}}));
  expect_tamed({"H: e^(l w.x) e^-l, sharpness 80 to 1e5",
                rows,
                {"sg", "sg_value"},
                before_sg_factored,
                1,
                0,
                exact_sg,
                {5e-6, 0}});
}

// Light below e^-87 is none: no denormal number, which some devices keep and others do not.
TEST(HazardH, FaintLightIsNone) {
  std::vector<Row> rows;
  for (const float sharpness : {44.5f, 48.0f, 60.0f, 1e4f})
    append(rows, joined({{0, 0, 2}, {1e-6f}, {0, 0, 1}, {sharpness}}));  // behind the light: e^-(2 sharpness)
  gpu::Device device = make_test_device();
  const std::vector<float> values = call_library(device, "vsgl", "vsgl_incoming", rows, 5);
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(values[5 * i + 4], 0) << rows[i][7];
  rows[0][7] = 43;
  const float seen = call_library(device, "vsgl", "vsgl_incoming", rows, 5)[4];
  EXPECT_GT(seen, 1e-38f);
}

}  // namespace
}  // namespace vsgl::test
