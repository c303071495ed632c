#pragma once

#include "math/specular_lobe.h"

// Specular reflection with the BRDF times cosine as one lobe about the mirror direction: the twin of
// shaders/lib/reflected_lobe.glsl. Each specular_vmf_* is the integral of the normalised SG times BRDF times
// cosine, 1/sr.

namespace vsgl {

// BRDF times cosine over the density of normals relative to its peak, in a direction at `cosine` to the
// normal.
double specular_coefficient(const SpecularReceiver& r, double cosine);

// The lobe's frame, from the receiver's local one: x across the plane of incidence, y within it, z = mirror
// direction.
Vec3 reflected_local(const SpecularReceiver& r, Vec3 light);

// Of the lobe's ASG along its x and y: lambda_h / (8 cos^2) and lambda_h / 8, lambda_h = 2 / alpha^2.
struct ReflectedBandwidths {
  double x = 0, y = 0;
};
ReflectedBandwidths reflected_bandwidths(const SpecularReceiver& r);

// [Wang 2009] Both as SGs.
double specular_vmf_sg(const SpecularReceiver& r, Vec3 axis, double sharpness);

// [Xu 2013] integral of the normalised SG times the lobe's ASG without its smooth term; `light` in the lobe's
// frame.
double specular_asg_convolved(const SpecularReceiver& r, Vec3 light, double sharpness);
// [Tokuyoshi 2016, C.2] ASG for the lobe, SG for the light; coefficient at the axis of their product.
double specular_vmf_asg(const SpecularReceiver& r, Vec3 axis, double sharpness);

// [Xu 2013] Product of the ASGs of bandwidths (eta_x, eta_y) about z and (nu, nu) about `light`, unit, in the
// first one's frame: e^-exponent times an ASG about `axis` whose integral, smooth terms at the axis included,
// is `integral`, sr.
struct AsgProduct {
  Vec3 axis;
  double exponent = 0;
  double integral = 0;
};
AsgProduct asg_product(Vec3 light, double eta_x, double eta_y, double nu);
// [Tokuyoshi 2014s] Both as ASGs.
double specular_vmf_asg_asg(const SpecularReceiver& r, Vec3 axis, double sharpness);

}  // namespace vsgl
