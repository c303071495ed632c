#include "math/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace vsgl {
namespace {

LobeMoments moments_of(Vec3 axis, double one_minus_length) {
  return {(1 - one_minus_length) * axis, one_minus_length * (2 - one_minus_length)};
}

SgLobe lobe_of(Vec3 mean, double sharpness) {
  if (mean == Vec3{}) return {{0, 0, 1}, 0};
  return {normalise(mean), std::min(sharpness, sharpness_max)};
}

}  // namespace

// Newton's method on e^3 + (l - 3) e^2 - 2 l e + 2 = 0 with e = 1 - r: the closed solution by cosines loses
// the digits of e.
double lobe_one_minus_length(double sharpness) {
  const double l = sharpness;
  double e = l < 1 ? 1 / (1 + l / 3) : 1 / (l + 0.5);
  for (int i = 0; i < 8; ++i) {
    const double value = ((e + l - 3) * e - 2 * l) * e + 2;
    const double slope = (3 * e + 2 * (l - 3)) * e - 2 * l;
    e -= value / slope;
  }
  return e;
}

LobeMoments lobe_encode(Vec3 axis, double sharpness) {
  return moments_of(axis, lobe_one_minus_length(sharpness));
}

double lobe_sharpness(double r, double deficit) {
  if (r == 0) return 0;
  return deficit > 0 ? std::min(r * (2 + deficit) / deficit, sharpness_max) : sharpness_max;
}

SgLobe lobe_decode(const LobeMoments& moments) {
  return lobe_of(moments.mean, lobe_sharpness(length(moments.mean), moments.deficit));
}

LobeMoments toksvig_encode(Vec3 axis, double sharpness) {
  return moments_of(axis, 1 / (1 + sharpness));
}

SgLobe toksvig_decode(const LobeMoments& moments) {
  const double r = length(moments.mean);
  return lobe_of(moments.mean, moments.deficit > 0 ? r * (1 + r) / moments.deficit : sharpness_max);
}

// Viete's solution of r^3 - l r^2 - 3 r + l = 0 with r = t + l / 3: t^3 - 3 m^2 t - 2 (l / 3)^3 = 0,
// m^2 = 1 + (l / 3)^2, has the roots 2 m cos((acos((l / (3 m))^3) - 2 pi k) / 3).
LobeMoments laurijssen_encode(Vec3 axis, double sharpness) {
  const double third = sharpness / 3, m = std::sqrt(1 + third * third), c = third / m, c2 = c * c;
  const double angle = std::atan2(std::sqrt(1 + c2 + c2 * c2) / m, c * c2);  // arc cosine of c^3
  const double r = third + 2 * m * std::cos((angle - 2 * std::numbers::pi) / 3);
  return moments_of(axis, 1 - std::clamp(r, 0.0, 1.0));
}

SgLobe laurijssen_decode(const LobeMoments& moments) {
  return lobe_decode({moments.mean, 1 - std::min(dot(moments.mean, moments.mean), 1.0)});
}

LobeMoments lobe_encode_by(std::uint32_t filter, Vec3 axis, double sharpness) {
  if (filter == interop::LOBE_TOKSVIG) return toksvig_encode(axis, sharpness);
  if (filter == interop::LOBE_LAURIJSSEN) return laurijssen_encode(axis, sharpness);
  return lobe_encode(axis, sharpness);
}

SgLobe lobe_decode_by(std::uint32_t filter, const LobeMoments& moments) {
  if (filter == interop::LOBE_TOKSVIG) return toksvig_decode(moments);
  if (filter == interop::LOBE_LAURIJSSEN) return laurijssen_decode(moments);
  return lobe_decode(moments);
}

std::vector<std::string> lobe_filter_names() {
  return {"banerjee", "toksvig", "laurijssen", "none"};  // in the order of LOBE_*
}

std::uint32_t lobe_filter_kind(const std::string& name) {
  const auto names = lobe_filter_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(ErrorCode::bad_value,
                "lobe_filter: \"" + name + "\" is none of banerjee, toksvig, laurijssen, none");
  return static_cast<std::uint32_t>(found - names.begin());
}

}  // namespace vsgl
