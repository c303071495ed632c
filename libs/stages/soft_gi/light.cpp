#include "stages/soft_gi/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/interop_vec.h"
#include "sh/emission.h"
#include "sh/product.h"
#include "stages/soft_gi/directions.h"

namespace vsgl::soft_gi {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int kDirections = 96;
constexpr double kLeastInfluence = 1, kMostInfluence = 1000;

void add(ColourVector& sum, Vec3 colour, const sh::Vector& y) {
  const auto [r, g, b] = to_array(colour);
  for (int i = 0; i < sh::kCoefficients; ++i)
    sum[0][i] += r * y[i], sum[1][i] += g * y[i], sum[2][i] += b * y[i];
}

Vec3 evaluate(const ColourVector& light, const sh::Vector& y) {
  return {sh::dot(light[0], y), sh::dot(light[1], y), sh::dot(light[2], y)};
}
double largest(Vec3 colour) {
  return std::max({colour.x, colour.y, colour.z});
}
ColourVector convolved(const ColourVector& light) {
  const sh::Zonal cosine = sh::clamped_cosine();
  return {sh::convolve(light[0], cosine), sh::convolve(light[1], cosine), sh::convolve(light[2], cosine)};
}

// The largest sine, 1e-3..1, whose effect is within the tolerance; effects grow with it.
template <class Effect>
double largest_sine(double tolerance, Effect effect) {
  double low = 1 / kMostInfluence, high = 1 / kLeastInfluence;
  for (int i = 0; i < 20; ++i) {
    const double middle = std::sqrt(low * high);
    (effect(middle) <= tolerance ? low : high) = middle;
  }
  return low;
}

}  // namespace

ColourVector project(const scene::Environment& environment) {
  std::vector<Vec3> equator;
  for (int column = 0; column < environment.width; ++column)
    equator.push_back(scene::environment_direction((column + 0.5) / environment.width, 0.5));
  std::vector<ColourVector> rows(static_cast<std::size_t>(environment.height));
#pragma omp parallel for
  for (int row = 0; row < environment.height; ++row) {
    const double solid_angle = scene::environment_texel(environment, 0, row).solid_angle;
    const Vec3 middle = scene::environment_direction(0.5, (row + 0.5) / environment.height);
    for (int column = 0; column < environment.width; ++column) {
      const Vec3 turn = equator[static_cast<std::size_t>(column)];
      const Vec3 there{turn.x * middle.z, middle.y, turn.z * middle.z};
      add(rows[static_cast<std::size_t>(row)], solid_angle * environment.at(column, row),
          sh::basis(environment.rotation.direction(there)));
    }
  }
  ColourVector sum{};
  for (const ColourVector& row : rows)
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < sh::kCoefficients; ++i) sum[c][i] += row[c][i];
  return sum;
}

interop::ProxyLight irradiance_form(const ColourVector& light) {
  const ColourVector e = convolved(light);
  const double k0 = std::sqrt(1 / (4 * pi)), k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (16 * pi)),
               k20 = std::sqrt(5 / (16 * pi));
  const auto colour = [&](auto of) { return to_float({of(e[0]), of(e[1]), of(e[2])}); };
  using V = const sh::Vector&;
  return {colour([&](V f) { return k0 * f[0]; }),
          colour([&](V f) { return k1 * f[3]; }),
          colour([&](V f) { return k1 * f[1]; }),
          colour([&](V f) { return k1 * f[2]; }),
          colour([&](V f) { return k2 * f[8] - k20 * f[6]; }),
          colour([&](V f) { return -k2 * f[8] - k20 * f[6]; }),
          colour([&](V f) { return 2 * k20 * f[6]; }),
          colour([&](V f) { return k2 * f[4]; }),
          colour([&](V f) { return k2 * f[5]; }),
          colour([&](V f) { return k2 * f[7]; })};
}

Vec3 irradiance(const ColourVector& light, Vec3 normal) {
  return evaluate(convolved(light), sh::basis(normal));
}

double least_radiance(const ColourVector& light) {
  double least = luminance(evaluate(light, sh::basis({0, 0, 1})));
  for (const Vec3 d : directions(4 * kDirections))
    least = std::min(least, luminance(evaluate(light, sh::basis(d))));
  return least;
}

Influence choose_influence(const ColourVector& light, double tolerance) {
  const std::vector<Vec3> all = directions(kDirections);
  const ColourVector lit = convolved(light);
  double most = 0;
  std::vector<sh::Vector> cosines, bases;
  for (const Vec3 d : all) {
    bases.push_back(sh::basis(d));
    cosines.push_back(sh::turn(sh::clamped_cosine(), d));
    most = std::max(most, largest(evaluate(lit, bases.back())));
  }
  if (!(most > 0)) return {kLeastInfluence, kLeastInfluence};
  const double shadow = largest_sine(tolerance, [&](double sine) {
    double worst = 0;
    for (const Vec3 d : all) {
      const sh::Matrix hidden = sh::multiplier(sh::turn(sh::cap(sh::below_of_sine(sine)), d));
      for (const sh::Vector& cosine : cosines) {
        sh::Vector seen;
        for (int i = 0; i < sh::kCoefficients; ++i) seen[i] = sh::dot(hidden[i], cosine);
        worst = std::max(worst, largest(evaluate(light, seen)));
      }
    }
    return worst / most;
  });
  // A white proxy straight ahead.
  const double indirect = largest_sine(tolerance, [&](double sine) {
    const sh::EmissionZonal mean = sh::mean_emission(sine);
    const sh::Zonal bands{mean[0], mean[1], mean[2], 0}, cap = sh::cap(sh::below_of_sine(sine));
    const double solid_cosine = sh::dot(sh::turn(cap, {0, 0, 1}), sh::turn(sh::clamped_cosine(), {0, 0, 1}));
    double worst = 0;
    for (const Vec3 d : all) worst = std::max(worst, largest(evaluate(lit, sh::turn(bands, d))));
    return worst / pi * solid_cosine / most;
  });
  return {1 / shadow, 1 / indirect};
}

}  // namespace vsgl::soft_gi
