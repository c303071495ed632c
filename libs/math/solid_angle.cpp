#include "math/solid_angle.h"

namespace vsgl {
namespace {

// Of the rectangle between the axis and the corner (x, y).
double corner_solid_angle(double x, double y) {
  return std::atan2(x * y, std::sqrt(1 + x * x + y * y));
}

}  // namespace

double rectangle_solid_angle(double x0, double y0, double x1, double y1) {
  return corner_solid_angle(x1, y1) - corner_solid_angle(x0, y1) - corner_solid_angle(x1, y0) +
         corner_solid_angle(x0, y0);
}

double midpoint_solid_angle(double x, double y, double area) {
  const double r2 = 1 + x * x + y * y;
  return area / (r2 * std::sqrt(r2));
}

}  // namespace vsgl
