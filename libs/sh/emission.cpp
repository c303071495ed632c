#include "sh/emission.h"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace vsgl::sh {
namespace {

constexpr double pi = std::numbers::pi;
using Gauss = boost::math::quadrature::gauss<double, 30>;

// Directions within the cone, in the plane of azimuth 0: `direction` from the origin, `normal` of the sphere
// where it is met. `weight`: sums to 1 - cos(theta).
struct Sight {
  Vec3 direction, normal;
  double weight;
};

// z^2 = cos^2 + v^2 makes the integrand smooth at the sphere's rim.
template <class Visit>
void for_each_sight(double sine, Visit visit) {
  const double cosine2 = std::fmax(1 - sine * sine, 0.0);
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0}) {
      const double v = sine * (1 + side * Gauss::abscissa()[n]) / 2, z = std::sqrt(cosine2 + v * v);
      const double r = std::sqrt(std::fmax(sine * sine - v * v, 0.0));  // 1 - z^2
      // The distance z - v; the normal's z = ((z - v) z - 1) / sine = (cosine2 + v^2 - v z - 1) / sine.
      const Vec3 normal{(z - v) * r / sine, 0, (v * v - sine * sine - v * z) / sine};
      visit(Sight{{r, 0, z}, normal, Gauss::weights()[n] * sine / 2 * v / z});
    }
}

}  // namespace

EmissionZonal mean_emission(double sine) {
  EmissionZonal sums{};
  for_each_sight(sine, [&](const Sight& sight) {
    const Vector y = basis(sight.normal);
    for (int l = 0; l < kEmissionOrder; ++l) sums[l] += sight.weight * y[index(l, 0)];
  });
  for (double& sum : sums) sum /= below_of_sine(sine);
  return sums;
}

EmissionZonal mean_emission_closed(double sine) {
  const double d = 1 / sine, e = std::sqrt(std::fmax(d * d - 1, 0.0)), d2 = d * d, d3 = d2 * d;
  return {1 / (2 * std::sqrt(pi)),
          -std::sqrt(3.0) * (2 * d3 - 2 * e * d2 - e + 1) / (6 * std::sqrt(pi) * d * (d - e)),
          std::sqrt(5.0) * (6 * d2 * d3 - 6 * e * d2 * d2 - 3 * e * d2 - e + 4) /
              (20 * std::sqrt(pi) * d2 * (d - e))};
}

EmissionZonal mean_emission_polynomial(double a) {
  return {0.28209, (0.08432 * a - 0.25073) * a - 0.32494,
          ((-0.22230 * a + 0.22502) * a + 0.47398) * a + 0.15950};
}

EmissionMatrix emission_matrix(double sine) {
  EmissionMatrix out;
  for_each_sight(sine, [&](const Sight& sight) {
    const Vector to = basis(sight.direction), from = basis(sight.normal);
    for (int m = 0; m < kEmissionOrder; ++m)
      for (int j = m; j < kEmissionOrder; ++j)
        for (int k = m; k < kEmissionOrder; ++k)
          // Over the azimuth: of 1, or of cos^2.
          out.couplings[m][j][k] +=
              sight.weight * (m == 0 ? 2 * pi : pi) * to[index(j, m)] * from[index(k, m)];
  });
  return out;
}

}  // namespace vsgl::sh
