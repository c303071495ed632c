// What the estimators draw, against its densities.

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "interop/model.h"
#include "math/interop_vec.h"
#include "reference/guide.h"
#include "reference/paths.h"
#include "reference/points.h"
#include "reference/source.h"

namespace vsgl::reference {
namespace {

using std::numbers::pi;

interop::Surface pixel(std::uint32_t ndf, float alpha) {
  interop::Surface s{};
  s.position = {0, 0, 0};
  s.normal = {0, 0, 1};
  s.shading_normal = to_float(normalise({0.1, -0.2, 1}));
  s.diffuse = {0.3F, 0.3F, 0.3F};
  s.alpha = alpha;
  s.ndf = ndf;
  if (ndf != interop::NDF_NONE) s.specular = {0.5F, 0.5F, 0.5F};
  return s;
}

// Share of the samples in the directions where `inside` holds, by drawing and by integrating the density.
struct Shares {
  double drawn = 0, integrated = 0;
};
template <typename Inside>
Shares shares(const Receiver& x, Inside inside) {
  constexpr int n = 400;
  Shares out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.5) / n, v = (j + 0.5) / n, z = 2 * u - 1, r = std::sqrt(1 - z * z);
      const Vec3 w{r * std::cos(2 * pi * v), r * std::sin(2 * pi * v), z};
      if (inside(w)) out.integrated += x.density(w) * 4 * pi / (n * n);
      if (inside(x.sample(u, v))) out.drawn += 1.0 / (n * n);
    }
  return out;
}

TEST(ReceiverSampling, FollowsItsDensity) {
  for (const std::uint32_t ndf :
       {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN, interop::NDF_PHONG})
    for (const float alpha : {0.25F, 0.7F})
      for (const Vec3 camera : {Vec3{0.3, 0.4, 1}, Vec3{2, -1, 0.1}}) {
        const Receiver x(pixel(ndf, alpha), camera);
        const auto check = [&](auto inside) {
          const Shares found = shares(x, inside);
          EXPECT_NEAR(found.drawn, found.integrated, 0.01) << ndf << " " << alpha << " " << camera.z;
        };
        check([](Vec3) { return true; });
        check([](Vec3 w) { return w.x > 0; });
        check([](Vec3 w) { return w.z > 0.6; });
        check([](Vec3 w) { return w.y < -0.2 && w.z > 0.2; });
      }
}

LightSource light(LightType type) {
  LightSource out;
  out.type = type;
  out.position = {0.3, -0.2, 0.5};
  out.forward = normalise({0.2, 0.4, -1});
  out.intensity = {1, 2, 3};
  out.cos_inner = 0.9;
  out.cos_outer = 0.7;
  return out;
}

// On the unit sphere about the source (directional: its disk) irradiance over density is the power of a path,
// the same everywhere, since paths start in proportion to the intensity.
TEST(SourceSampling, PathsCarryEqualPower) {
  for (const LightType type : {LightType::spot, LightType::point, LightType::directional}) {
    const Source source(light(type), 2);
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j) {
        const Source::Start start = source.sample((i + 0.5) / 20, (j + 0.5) / 20);
        EXPECT_NEAR(length(start.direction), 1, 1e-12);
        const Source::Arrival arrival = source.arrival(start.origin + 1.5 * start.direction);
        ASSERT_GT(arrival.density, 0);
        EXPECT_NEAR(luminance(arrival.irradiance) / arrival.density, source.power(), 1e-9 * source.power());
        EXPECT_NEAR(length(arrival.incident + start.direction), 0, 1e-9);
      }
  }
}

TEST(SourceSampling, PowerIsTheIntegralOfTheIntensity) {
  const LightSource spot = light(LightType::spot);
  double integral = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) integral += 2 * pi * spot_falloff(spot, 0.7 + 0.3 * (i + 0.5) / n) * 0.3 / n;
  EXPECT_NEAR(Source(spot, 2).power(), luminance(spot.intensity) * integral, 1e-6);
  LightSource hard = spot;
  hard.cos_inner = hard.cos_outer;
  EXPECT_NEAR(Source(hard, 2).power(), luminance(spot.intensity) * 2 * pi * 0.3, 1e-9);
  EXPECT_NEAR(Source(light(LightType::point), 2).power(), luminance(spot.intensity) * 4 * pi, 1e-9);
}

TEST(SourceSampling, FindsTheStartOfAPath) {
  for (const LightType type : {LightType::spot, LightType::point, LightType::directional}) {
    Source source(light(type), 2);
    source.set_share(0.25, 0.5);
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j < 30; ++j) {
        const double u = 0.25 + 0.5 * (i + 0.4) / 30, v = (j + 0.4) / 30;
        const Source::Start start = source.sample(u, v);
        const auto [u1, u2] = source.start_of_path_to(start.origin + 1.5 * start.direction);
        EXPECT_NEAR(u1, u, 1e-6);
        EXPECT_NEAR(u2, v, 1e-6);
      }
  }
}

TEST(GuideSampling, FollowsItsDensity) {
  Guide guide(2);
  std::array<double, Guide::kCells> weights{};
  weights[5 * Guide::kSide + 9] = 3;
  weights[40 * Guide::kSide] = 1;
  guide.set(1, weights);
  constexpr int n = 512;
  double total = 0, uniform = 0, peak_drawn = 0, peak_integrated = 0;
  const auto in_peak = [](const std::array<double, 2>& u) { return u[0] < 0.12 && u[1] < 0.2; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const std::array<double, 2> u{(i + 0.5) / n, (j + 0.5) / n};
      const double density = guide.density(1, u);
      EXPECT_GT(density, 0.19);
      total += density / (n * n);
      uniform += guide.density(0, u) / (n * n);
      if (in_peak(guide.warp(1, u))) peak_drawn += 1.0 / (n * n);
      if (in_peak(u)) peak_integrated += density / (n * n);
    }
  EXPECT_NEAR(total, 1, 1e-6);
  EXPECT_NEAR(uniform, 1, 1e-6);
  EXPECT_GT(peak_drawn, 0.5);
  EXPECT_NEAR(peak_drawn, peak_integrated, 0.005);
}

TEST(LatticePoints, AreUniformAndOfTheirCounter) {
  const Points points(7, 32);
  double mean = 0, square = 0;
  constexpr int lattices = 2000;
  for (std::uint32_t k = 0; k < lattices; ++k) {
    const auto u = points.lattice(Stream::light, k, 3)[5];
    mean += u[0] / lattices;
    square += u[1] * u[1] / lattices;
  }
  EXPECT_NEAR(mean, 0.5, 0.03);
  EXPECT_NEAR(square, 1.0 / 3, 0.03);
  const auto first = points.lattice(Stream::light, 1, 2)[0];
  EXPECT_EQ(first, points.lattice(Stream::light, 1, 2)[0]);
  EXPECT_NE(first, points.lattice(Stream::brdf, 1, 2)[0]);
  EXPECT_NE(first, points.lattice(Stream::light, 2, 2)[0]);
  EXPECT_NE(first, points.lattice(Stream::light, 1, 3)[0]);
  EXPECT_NE(first, Points(8, 32).lattice(Stream::light, 1, 2)[0]);
  // One point in each of the columns of width 1/32.
  std::array<int, 32> columns{};
  for (int i = 0; i < 32; ++i)
    ++columns[static_cast<std::size_t>(32 * points.lattice(Stream::light, 9, 0)[i][0])];
  for (const int count : columns) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace vsgl::reference
