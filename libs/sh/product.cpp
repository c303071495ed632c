#include "sh/product.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace vsgl::sh {
namespace {

// Exact for polynomials of degree 9 = 3 (kOrder - 1): 8 points in z, 16 azimuths.
using Gauss = boost::math::quadrature::gauss<double, 8>;
constexpr int kAzimuths = 16;

// Calls visit(direction, weight) for the points of the quadrature over the sphere.
template <class Visit>
void for_each_direction(Visit visit) {
  const double step = 2 * std::numbers::pi / kAzimuths;
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double z : {-Gauss::abscissa()[n], Gauss::abscissa()[n]})
      for (int a = 0; a < kAzimuths; ++a) {
        const double r = std::sqrt(1 - z * z), azimuth = (a + 0.5) * step;
        visit(Vec3{r * std::cos(azimuth), r * std::sin(azimuth), z}, Gauss::weights()[n] * step);
      }
}

std::vector<Triple> integrate_triples() {
  std::vector<Triple> all;
  for (int i = 0; i < kCoefficients; ++i)
    for (int j = i; j < kCoefficients; ++j)
      for (int k = j; k < kCoefficients; ++k) all.push_back({i, j, k, 0});
  for_each_direction([&](Vec3 direction, double weight) {
    const Vector y = basis(direction);
    for (Triple& t : all) t.value += weight * y[t.i] * y[t.j] * y[t.k];
  });
  std::erase_if(all, [](const Triple& t) { return std::abs(t.value) < 1e-12; });
  return all;
}

}  // namespace

const std::vector<Triple>& triples() {
  static const std::vector<Triple> all = integrate_triples();
  return all;
}

Matrix multiplier(const Vector& f) {
  Matrix out{};
  for (const auto& [i, j, k, value] : triples()) {
    std::array<int, 3> order{i, j, k};
    do {
      out[order[1]][order[2]] += value * f[order[0]];
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return out;
}

Vector product(const Vector& f, const Vector& g) {
  const Matrix matrix = multiplier(f);
  Vector out{};
  for (int i = 0; i < kCoefficients; ++i) out[i] = dot(matrix[i], g);
  return out;
}

}  // namespace vsgl::sh
