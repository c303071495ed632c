#include "stages/metrics/colour.h"

#include <algorithm>
#include <cmath>

#include "math/srgb.h"

namespace vsgl::metrics {
namespace {

// Rows: X, Y, Z of the primaries, from the chromaticities of Rec.709 and D65 (x, y) = (0.3127, 0.3290), as
// [Andersson 2020] uses them.
constexpr Vec3 kX = {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0};
constexpr Vec3 kY = {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0};
constexpr Vec3 kZ = {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0};

// Scaled to the row sum 1, so that white becomes (1, 1, 1).
Vec3 normalised(Vec3 row) {
  return row / (row.x + row.y + row.z);
}
struct Matrix {
  Vec3 x, y, z;
};
Matrix rgb_to_xyz() {
  return {normalised(kX), normalised(kY), normalised(kZ)};
}
// The columns of the inverse are the cross products of the rows over the determinant.
Matrix inverse(const Matrix& m) {
  const double determinant = dot(m.x, cross(m.y, m.z));
  const Vec3 a = cross(m.y, m.z) / determinant, b = cross(m.z, m.x) / determinant,
             c = cross(m.x, m.y) / determinant;
  return {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}};
}
Vec3 apply(const Matrix& m, Vec3 v) {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}

// The cube root of CIE 1976, with its straight line below (6/29)^3.
double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

double encode_srgb(double linear) {
  return srgb_encode(std::clamp(linear, 0.0, 1.0));
}

Vec3 to_xyz(Vec3 linear_rgb) {
  static const Matrix matrix = rgb_to_xyz();
  return apply(matrix, linear_rgb);
}

Vec3 from_xyz(Vec3 xyz) {
  static const Matrix matrix = inverse(rgb_to_xyz());
  return apply(matrix, xyz);
}

Vec3 to_ycxcz(Vec3 linear_rgb) {
  const Vec3 v = to_xyz(linear_rgb);
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

Vec3 from_ycxcz(Vec3 c) {
  const double y = (c.x + 16) / 116;
  return from_xyz({y + c.y / 500, y, y - c.z / 200});
}

Vec3 to_lab(Vec3 linear_rgb) {
  const Vec3 v = to_xyz(linear_rgb);
  const double x = lab_curve(v.x), y = lab_curve(v.y), z = lab_curve(v.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double encode_pu21(double luminance) {
  const double p = std::pow(std::clamp(luminance, 0.005, 10000.0), 0.9062562627);
  const double ratio = (0.353487901 + 0.3734658629 * p) / (1 + 8.277049286e-05 * p);
  return 596.3148142 * (std::pow(ratio, 0.09150303166) - 0.9099517204);
}

}  // namespace vsgl::metrics
