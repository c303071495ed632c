#pragma once

#include "math/specular_lobe.h"

// Specular reflection of a spherical-Gaussian light by Laplace's method in double precision: the twin of
// shaders/lib/mixture_lobe.glsl, where the symbols are explained.

namespace vsgl {

struct HalfVector {
  double x = 0, y = 0;  // components along tangent and bitangent
};

// The light's spread over projected half vectors against that of the density of normals, in the plane of
// incidence and across it.
struct MixtureSpread {
  double par = 0, perp = 0;
  double broad = 1;
  double plane = 0;  // in the plane of incidence, of a light that is on a plane
};
MixtureSpread mixture_spread(const SpecularReceiver& r, double sharpness);

// How much the axis of a light says about the place of the peak, 0..1.
double mixture_direction(std::uint32_t ndf, double sharpness);

// Projected half vector of view and light (local).
HalfVector mixture_half_vector(const SpecularReceiver& r, Vec3 light);

// Where GGX's scales part into a core, of variance tau and mass e^(-1/x), and a tail.
struct MixtureSplit {
  double x = 0, tau = 1;
};
MixtureSplit mixture_split(const SpecularReceiver& r, double sharpness);

// From the light's axis to the direction that the view is reflected to about the half vector `h`.
Vec3 mixture_turn(const SpecularReceiver& r, Vec3 light, HalfVector h);

// Peak of the product of light and core.
struct MixturePeak {
  HalfVector h;
  double cos2 = 1, exponent = 0, scale = 1;
};
MixturePeak mixture_peak(const SpecularReceiver& r, const MixtureSpread& s, Vec3 light, double sharpness,
                         HalfVector half_vector, double tau, double smith);

// (1 - e^-u (1 + u)) / u^2, to 2e-3.
double mixture_incomplete(double u);

// GGX beyond the core, relative to the density's peak; `slope2`: squares of the half vector over a~.
double mixture_tail(const MixtureSpread& s, double x, HalfVector slope2);

// Density of normals at the half vector, filtered by the light, 1/sr.
double mixture_density(const SpecularReceiver& r, Vec3 light, double sharpness);

// [EXT] All densities of normals, any light.
double specular_vmf_mixture(const SpecularReceiver& r, Vec3 axis, double sharpness);

}  // namespace vsgl
