#pragma once

// The environment as spherical harmonics, and what follows from it.

#include <array>

#include "interop/proxy.h"
#include "scene/environment.h"
#include "sh/basis.h"

namespace vsgl::soft_gi {

// Coefficients in red, green and blue.
using ColourVector = std::array<sh::Vector, 3>;

// Radiance, W/(m^2 sr), in the world's directions: texels' centres, weighted by their exact solid angles. The
// same for any number of threads.
ColourVector project(const scene::Environment& environment);

// Irradiance of a sphere by the direction of its normal, bands 0 to 2.
interop::ProxyLight irradiance_form(const ColourVector& light);
// Irradiance of an unshadowed receiver, W/m^2; [Sloan 2007, Section 3] may be negative where the light rings.
Vec3 irradiance(const ColourVector& light, Vec3 normal);
// Least radiance and irradiance over a grid of directions, luminance: below 0 where the light rings.
double least_radiance(const ColourVector& light);

// [Sloan 2007, Section 4.1] how many radii a sphere of influence needs so that one proxy at its rim changes
// no receiver's shade by more than `tolerance`, relative to the largest irradiance: for the given light, over
// a grid of directions and normals.
struct Influence {
  double shadow, indirect;
};
Influence choose_influence(const ColourVector& light, double tolerance);

}  // namespace vsgl::soft_gi
