#include "stages/soft_gi/tables.h"

#include <cmath>
#include <numbers>

#include "sh/emission.h"
#include "sh/exponential.h"

namespace vsgl::soft_gi {
namespace {

constexpr double pi = std::numbers::pi;

interop::vec4 to_vec4(const std::array<double, 4>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
          static_cast<float>(v[3])};
}

// The couplings times what the shader leaves out of both sides: the clamped cosine's bands, and the basis's
// constants (accumulate.comp.glsl states the order).
void set_couplings(interop::ProxyEntry& entry, double sine) {
  const sh::EmissionMatrix m = sh::emission_matrix(sine);
  const sh::Zonal g = sh::clamped_cosine();
  const auto c = sh::band_factor;
  const auto even = [&](int j, int k) { return g[j] * m.at(j, k, 0) * c(k); };
  const double k2 = std::sqrt(15 / (4 * pi)), turned = std::sqrt(3.0);
  entry.coupling0 = to_vec4({even(0, 0), even(0, 1), even(0, 2), even(1, 0)});
  entry.coupling1 = to_vec4({even(1, 1), even(1, 2), even(2, 0), even(2, 1)});
  entry.coupling2 = to_vec4({even(2, 2), g[1] * m.at(1, 1, 1) * c(1), g[1] * m.at(1, 2, 1) * 2 / k2,
                             turned * g[2] * m.at(2, 1, 1) * c(1)});
  entry.coupling3 = to_vec4({turned * g[2] * m.at(2, 2, 1) * 2 / k2, c(2) * g[2] * m.at(2, 2, 2), 0, 0});
}

}  // namespace

std::vector<interop::ProxyEntry> proxy_table() {
  std::vector<interop::ProxyEntry> table(interop::PROXY_TABLE);
  const sh::Zonal g = sh::clamped_cosine();
#pragma omp parallel for
  for (std::uint32_t i = 0; i < interop::PROXY_TABLE; ++i) {
    const double below = i / (interop::PROXY_TABLE - 1.0), sine = std::sqrt(below * (2 - below));
    interop::ProxyEntry& entry = table[i];
    const sh::Zonal cap = sh::cap(below);
    sh::Zonal log = sh::log_occlusion(below);
    for (int l = 0; l < sh::kOrder; ++l) log[l] *= sh::band_factor(l);
    entry.log_occlusion = to_vec4(log);
    entry.cap = to_vec4({cap[0] * g[0], cap[1] * g[1], cap[2] * g[2], 2 * pi * below});
    if (i > 0) set_couplings(entry, sine);
  }
  return table;
}

std::vector<interop::ProxyFit> exponential_fits() {
  std::vector<interop::ProxyFit> fits;
  for (std::uint32_t i = 0; i < interop::PROXY_FITS; ++i) {
    const auto [constant, linear] = sh::linear_fit(sh::kHybNorm * i / (interop::PROXY_FITS - 1));
    fits.push_back({{static_cast<float>(constant), static_cast<float>(linear)}});
  }
  return fits;
}

}  // namespace vsgl::soft_gi
