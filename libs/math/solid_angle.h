#pragma once

#include "math/vec.h"

namespace vsgl {

// Solid angle (sr) of the rectangle [x0, x1] x [y0, y1] on the plane at distance 1 from the eye: exact, the
// second difference of atan2(x y, sqrt(1 + x^2 + y^2)) at the corners.
double rectangle_solid_angle(double x0, double y0, double x1, double y1);

// Midpoint rule, area / (1 + x^2 + y^2)^(3/2) at the centre: relative error 1e-6 for the sum over 512x512
// texels of a 90-degree view.
double midpoint_solid_angle(double x, double y, double area);

}  // namespace vsgl
