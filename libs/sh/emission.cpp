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

EmissionZonal mean_emission(double a) {
  const double c = std::sqrt(std::fmax(1 - a * a, 0.0));
  return {1 / std::sqrt(4 * pi), -std::sqrt(3 / pi) / 6 * (1 + a + c + a / (1 + c)),
          std::sqrt(5 / pi) / 20 * (3 + 3 / (1 + c) - c - c * c + 4 * a * (1 + c))};
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
