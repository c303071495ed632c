// The device against the formulas in double precision, without tables, one receiver at a time.

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <random>

#include "math/frame.h"
#include "sh/emission.h"
#include "sh/exponential.h"
#include "sh/proxy_sphere.h"
#include "soft_gi_scene.h"
#include "stages/soft_gi/exposure.h"

namespace vsgl {
namespace {

using namespace test;
using soft_gi::ColourVector;

Vec3 evaluate(const ColourVector& light, const sh::Vector& y) {
  return {sh::dot(light[0], y), sh::dot(light[1], y), sh::dot(light[2], y)};
}

// Order-3 projection of the radiance over the disk, by its definition, times the cosine: irradiance over the
// albedo / pi.
Vec3 exact_irradiance(const ColourVector& lit, Vec3 center, double radius, Vec3 normal) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double distance = length(center), sine = std::min(radius / distance, 1.0),
               cosine = std::sqrt(1 - sine * sine);
  const Frame frame = frame_about(center / distance);
  sh::Vector turned = sh::turn(sh::clamped_cosine(), normal);
  std::array<sh::Vector, 3> radiance{};
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0})
      for (int a = 0; a < 16; ++a) {
        const double v = sine * (1 + side * Gauss::abscissa()[n]) / 2, z = std::hypot(cosine, v);
        const double weight = Gauss::weights()[n] * sine / 2 * v / z * 2 * pi / 16, r = std::sqrt(1 - z * z);
        const Vec3 s = frame.to_world({r * std::cos(pi * a / 8), r * std::sin(pi * a / 8), z});
        const Vec3 hit = s * (distance * (z - v));
        const Vec3 there = evaluate(lit, sh::basis(normalise(hit - center)));
        const sh::Vector y = sh::basis(s);
        for (int i = 0; i < 9; ++i) {
          radiance[0][i] += weight * there.x * y[i];
          radiance[1][i] += weight * there.y * y[i];
          radiance[2][i] += weight * there.z * y[i];
        }
      }
  return {sh::dot(radiance[0], turned), sh::dot(radiance[1], turned), sh::dot(radiance[2], turned)};
}

// Irradiance of order 3, by the normal.
ColourVector light_of_proxies(const ColourVector& light) {
  ColourVector lit;
  for (int c = 0; c < 3; ++c) {
    lit[c] = sh::convolve(light[c], sh::clamped_cosine());
    for (int i = 9; i < 16; ++i) lit[c][i] = 0;
  }
  return lit;
}

// Of a cap of radiance 1.
double cap_irradiance(double below, Vec3 d, Vec3 normal) {
  return std::max(sh::dot(sh::turn(sh::cap(below), d), sh::turn(sh::clamped_cosine(), normal)), 0.0);
}

// Straight between the distances of 2^i radii for which it is stated, by the logarithm.
double exposure(const soft_gi::Exposure& shares, double sine) {
  const double place = std::clamp(-std::log2(sine), 0.0, static_cast<double>(shares.size() - 1));
  const auto level = std::min(static_cast<std::size_t>(place), shares.size() - 2);
  const double part = place - static_cast<double>(level);
  return (1 - part) * static_cast<double>(shares[level]) + part * static_cast<double>(shares[level + 1]);
}

Vec3 disk_irradiance(const ColourVector& lit, Vec3 d, double sine, Vec3 normal, bool averaged) {
  const sh::EmissionZonal mean = sh::mean_emission(sine);
  const sh::Vector bands = averaged ? sh::turn({mean[0], mean[1], mean[2], 0}, d) : sh::basis(-d);
  const double cap = cap_irradiance(sh::below_of_sine(sine), d, normal);
  const Vec3 radiance = evaluate(lit, bands);
  return cap * Vec3{std::max(radiance.x, 0.0), std::max(radiance.y, 0.0), std::max(radiance.z, 0.0)};
}

struct Shade {
  Vec3 direct, indirect;
};
Shade shade_in_double(const Point& at, const std::vector<ProxySphere>& spheres,
                      const std::vector<soft_gi::Exposure>& shares, const ColourVector& light,
                      const std::string& emission, bool published) {
  const ColourVector lit = light_of_proxies(light);
  sh::Vector log{};
  Vec3 indirect;
  double covering = 0;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const ProxySphere& sphere = spheres[s];
    const auto [center, radius] = sh::above_plane({sphere.center - at.position, sphere.radius}, at.normal);
    if (radius <= 0) continue;
    const double distance = length(center), sine = std::min(radius / distance, 1.0);
    const Vec3 d = center / distance;
    const double below = sh::below_of_sine(sine);
    const double share = published ? 1 : exposure(shares[s], sine);
    const sh::Vector f = sh::turn(sh::log_occlusion(below), d);
    for (int i = 0; i < 16; ++i) log[i] += share * f[i];
    covering += share * (published ? 2 * pi * below : cap_irradiance(below, d, at.normal));
    indirect += share * sphere.albedo / pi *
                (emission == "exact" ? exact_irradiance(lit, center, radius, at.normal)
                                     : disk_irradiance(lit, d, sine, at.normal, emission == "averaged"));
  }
  const sh::Vector occlusion = published ? sh::exp_hyb(log) : sh::exp_second_order(log);
  const sh::Vector seen = sh::product(occlusion, sh::turn(sh::clamped_cosine(), at.normal));
  const double open = seen[0] * sh::one()[0];
  const double covered = published ? (sh::one()[0] - occlusion[0]) * sh::one()[0] : pi - open;
  const double share = covering > 0 ? std::clamp(covered / covering, 0.0, 1.0) : 1;
  return {std::min(pi / open, 1.0) * evaluate(light, seen) / pi, share * indirect / pi};
}

struct Case {
  int spheres;
  double largest, tolerance;  // of the radiance, where the unshadowed one is about 1
};

// The table errs by up to 0.7% of a logarithm.
TEST(SoftGiOracle, DeviceFollowsTheFormulas) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto sky = coloured_sky();
  const ColourVector light = soft_gi::project(sky);
  for (const Case& setting : {Case{1, 0.5, 0.003}, Case{5, 0.3, 0.003}, Case{40, 0.15, 0.003}}) {
    std::vector<ProxySphere> spheres;
    for (int i = 0; i < setting.spheres; ++i)
      spheres.push_back({{uniform(random), uniform(random), uniform(random)},
                         setting.largest * (0.55 + 0.45 * uniform(random)),
                         {0.9, 0.6, 0.3}});
    const auto shares = soft_gi::exposures(spheres);
    std::vector<Point> points;
    for (int i = 0; i < 40; ++i)
      points.push_back({{2 * uniform(random), 2 * uniform(random), 2 * uniform(random)},
                        normalise({uniform(random), uniform(random), uniform(random)})});
    for (const auto& emission : emissions())
      for (const auto& exponential : exponentials()) {
        SoftGiParams params = everywhere();
        params.emission = emission.name;
        params.exponential = exponential.name;
        const bool published = exponential.name == "hyb";
        if (published) params.normalisation = "solid-angle", params.overlap = "whole";
        const Indirect image = shade(gbuffer_of(points), proxies_of(spheres), sky, params);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const Shade expected = shade_in_double(points[i], spheres, shares, light, emission.name, published);
          EXPECT_LE(length(widen(image.direct[i]) - expected.direct), setting.tolerance)
              << setting.spheres << " spheres, " << exponential.name << ", receiver " << i;
          EXPECT_LE(length(widen(image.diffuse[i]) - expected.indirect), setting.tolerance)
              << setting.spheres << " spheres, " << emission.name << ", receiver " << i;
        }
      }
  }
}

// Of one sphere all but its radiance is the same by any operator, so that ratios to the point's have no error
// of the exponential, and at the table's entries none of the table.
TEST(SoftGiOracle, OperatorsFollowTheFormulas) {
  const auto sky = coloured_sky();
  const ColourVector lit = light_of_proxies(soft_gi::project(sky));
  for (const Vec3 d : {Vec3{0, 0, 1}, normalise(Vec3{1, -2, 0.5}), normalise(Vec3{-1, 0.3, -0.6})})
    for (const double tilt : {0.0, 0.7})
      for (const double below : {2e-4, 1.0 / 255, 11.0 / 255, 73.0 / 255, 175.0 / 255}) {
        const double sine = std::sqrt(below * (2 - below));
        const Vec3 normal =
            frame_about(d).to_world({std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt)});
        if (dot(d, normal) <= sine) continue;
        const GBuffer gbuffer = gbuffer_of({{{}, normal}});
        const Proxies proxies = proxies_of({{d, sine, {1, 1, 1}}});
        const auto light_by = [&](const char* emission) {
          SoftGiParams params = everywhere();
          params.emission = emission;
          return widen(shade(gbuffer, proxies, sky, params).diffuse[0]);
        };
        const auto expect_ratios = [&](Vec3 found, Vec3 expected) {
          const Vec3 point = light_by("point"), at_point = disk_irradiance(lit, d, sine, normal, false);
          EXPECT_NEAR(found.x / point.x, expected.x / at_point.x, 2e-5) << tilt << ", " << sine;
          EXPECT_NEAR(found.y / point.y, expected.y / at_point.y, 2e-5) << tilt << ", " << sine;
          EXPECT_NEAR(found.z / point.z, expected.z / at_point.z, 2e-5) << tilt << ", " << sine;
        };
        expect_ratios(light_by("averaged"), disk_irradiance(lit, d, sine, normal, true));
        if (below > 1e-3) expect_ratios(light_by("exact"), exact_irradiance(lit, d, sine, normal));
      }
}

// Two spheres that overlap, the smaller one black: what they hide and send goes by the shares of each at that
// distance.
TEST(SoftGiOracle, SharesGoByTheDistance) {
  const std::vector<ProxySphere> spheres{{{}, 1, {1, 1, 1}}, {{0.8, 0, 0}, 0.7, {}}};
  const auto shares = soft_gi::exposures(spheres);
  const ColourVector light = soft_gi::project(even_sky());
  for (const double distance : {2.3, 3.0, 3.6, 5.0, 9.0}) {
    const Point at{{0.4, 0, distance}, {0, 0, -1}};
    const Indirect image = shade(gbuffer_of({at}), proxies_of(spheres), even_sky(), everywhere());
    const Shade expected = shade_in_double(at, spheres, shares, light, "averaged", false);
    EXPECT_NEAR((1 - widen(image.direct[0]).x) / (1 - expected.direct.x), 1, 0.02) << distance;
    EXPECT_NEAR(widen(image.diffuse[0]).x / expected.indirect.x, 1, 0.02) << distance;
  }
}

}  // namespace
}  // namespace vsgl
