#pragma once

#include "math/vec.h"

// Spherical Gaussians G(w; axis, sharpness) = exp(sharpness (w.axis - 1)) in double precision: the twin of
// shaders/lib/sg.glsl. Axes are unit vectors; sharpness is 0..2^40.

namespace vsgl {

// The largest lobe sharpness that is ever formed: 2^40.
inline constexpr double sharpness_max = 1099511627776.0;

struct SgLobe {
  Vec3 axis{0, 0, 1};
  double sharpness = 0;
};

// Product of two SGs: e^exponent times the SG of `axis` and `sharpness`.
struct SgProduct {
  Vec3 axis{0, 0, 1};
  double sharpness = 0;
  double exponent = 0;  // <= 0
};

// (e^x - 1) / x, 1 at x = 0.
double phi(double x);

double sg_value(Vec3 w, Vec3 axis, double sharpness);

// Integral over the sphere, sr: (2 pi / sharpness)(1 - e^(-2 sharpness)).
double sg_integral(double sharpness);

// [Wang 2009] exact product. Equal and opposite lobes have no axis; axis1 stands in.
SgProduct sg_product(Vec3 axis1, double sharpness1, Vec3 axis2, double sharpness2);

// [Tokuyoshi 2022] Mass of the normalised SG above the plane through the origin, c = axis.normal: 0..1. Error
// 0.0047 of the peak.
double vmf_hemisphere(double c, double sharpness);

// [Tokuyoshi 2024] Mean of max(w.n, 0) under the normalised SG, c = axis.n: 0..1. Error 1.3e-3 of the peak.
double cosine_mean(double c, double sharpness);

// Integral of the SG times max(w.n, 0) over the sphere.
double cosine_integral(double c, double sharpness);

}  // namespace vsgl
