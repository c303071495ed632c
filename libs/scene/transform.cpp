#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsgl::scene {
namespace {

// Exact for multiples of 90 degrees, where sin and cos of a rounded radian are not.
void sin_cos_deg(double degrees, double& sine, double& cosine) {
  const double quarter_turns = std::round(degrees / 90);
  const double rest = (degrees - 90 * quarter_turns) * std::numbers::pi / 180;
  const double s = std::sin(rest), c = std::cos(rest);
  switch (static_cast<int>(std::fmod(quarter_turns, 4) + 4) % 4) {
    case 0:
      sine = s, cosine = c;
      break;
    case 1:
      sine = c, cosine = -s;
      break;
    case 2:
      sine = -s, cosine = -c;
      break;
    default:
      sine = -c, cosine = s;
      break;
  }
}

Vec3 row(const Mat4& m, int i) {
  return {m.m[i][0], m.m[i][1], m.m[i][2]};
}

// Rounded to four units in the last place of the larger term, unless one is 0.
double cancelled_sum(double a, double b) {
  const double larger = std::max(std::abs(a), std::abs(b));
  if (a == 0 || b == 0 || !std::isnormal(larger)) return a + b;
  const double step = std::ldexp(1.0, std::ilogb(larger) - 50);
  return std::round((a + b) / step) * step;
}

}  // namespace

Mat4 translation(Vec3 offset) {
  Mat4 out;
  out.m[0][3] = offset.x;
  out.m[1][3] = offset.y;
  out.m[2][3] = offset.z;
  return out;
}

Mat4 scaling(Vec3 factors) {
  Mat4 out;
  out.m[0][0] = factors.x;
  out.m[1][1] = factors.y;
  out.m[2][2] = factors.z;
  return out;
}

Mat4 rotation(const std::array<double, 4>& quaternion) {
  const auto [x, y, z, w] = quaternion;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0},
           {0, 0, 0, 1}}};
}

Mat4 rotation_xyz_deg(Vec3 angles) {
  double sx, cx, sy, cy, sz, cz;
  sin_cos_deg(angles.x, sx, cx);
  sin_cos_deg(angles.y, sy, cy);
  sin_cos_deg(angles.z, sz, cz);
  const Mat4 x{{{1, 0, 0, 0}, {0, cx, -sx, 0}, {0, sx, cx, 0}, {0, 0, 0, 1}}};
  const Mat4 y{{{cy, 0, sy, 0}, {0, 1, 0, 0}, {-sy, 0, cy, 0}, {0, 0, 0, 1}}};
  const Mat4 z{{{cz, -sz, 0, 0}, {sz, cz, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  return z * y * x;
}

Mat4 compose(const Mat4& outer, const Mat4& inner) {
  Mat4 out = outer * inner;
  const Vec3 moved{inner.m[0][3], inner.m[1][3], inner.m[2][3]};
  for (int i = 0; i < 3; ++i) out.m[i][3] = cancelled_sum(dot(row(outer, i), moved), outer.m[i][3]);
  return out;
}

double determinant(const Mat4& m) {
  return dot(row(m, 0), cross(row(m, 1), row(m, 2)));
}

Vec3 transform_normal(const Mat4& m, Vec3 normal) {
  // The rows of the cofactor matrix are the cross products of the matrix's other two rows.
  const Vec3 cofactor_0 = cross(row(m, 1), row(m, 2));
  const Vec3 cofactor_1 = cross(row(m, 2), row(m, 0));
  const Vec3 cofactor_2 = cross(row(m, 0), row(m, 1));
  const Vec3 out{dot(cofactor_0, normal), dot(cofactor_1, normal), dot(cofactor_2, normal)};
  return determinant(m) < 0 ? -out : out;
}

bool is_finite(const Mat4& m) {
  for (const auto& matrix_row : m.m)
    for (double value : matrix_row)
      if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace vsgl::scene
