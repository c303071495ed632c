#pragma once

#include <cstdint>

#include "interop/model.h"
#include "math/sg.h"

// Microfacet BRDFs without Fresnel in double precision: the twin of shaders/lib/microfacet.glsl. `ndf` is
// interop::NDF_*; alpha: roughness 1e-3..1, for Phong sqrt(2 / (n + 2)). `view` and `light` are unit vectors
// away from the surface.

namespace vsgl {

// Cosines of the view direction are floored here.
inline constexpr double cos_min = 1e-4;

// Density of normals, 1/sr, at an angle of squared sine and cosine sin2, cos2 to the mean normal.
// [Walter 2007, Eqs. (33), (25), (30)]
double ggx_d(double alpha2, double sin2, double cos2);
double beckmann_d(double alpha2, double sin2, double cos2);
double phong_d(double alpha2, double sin2, double cos2);
double ndf_density(std::uint32_t ndf, double alpha2, double sin2, double cos2);

// Smith's Lambda [Heitz 2014]; Phong takes Beckmann's [Walter 2007].
double ggx_lambda(double alpha2, double c);
double beckmann_lambda(double alpha2, double c);
double smith_lambda(std::uint32_t ndf, double alpha2, double c);
// sqrt(c^2 + alpha^2 (1 - c^2)) = c (1 + 2 Lambda) of GGX.
double ggx_slope_cosine(double alpha2, double c);

// Sharpness of the SG that stands for the density of normals; at least 1e-3.
double ndf_sharpness(std::uint32_t ndf, double alpha);

// BRDF times cosine of `light`, 1/sr: D G2 / (4 view.normal); zero below the horizon.
double specular_brdf_cos(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view, Vec3 light);

// Normal towards which the lobe of a rough surface leans at grazing angles.
Vec3 dominant_normal(double alpha2, Vec3 normal, Vec3 view);

// SG of the reflected lobe: mirror direction, sharpness lambda_h / (4 cos).
SgLobe specular_lobe(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view);

}  // namespace vsgl
