#pragma once

#include <cstdint>

#include "math/microfacet.h"

// Specular reflection of a spherical-Gaussian light in double precision: the twin of
// shaders/lib/specular_lobe.glsl. Each value is the integral of the normalised SG (vMF) times BRDF times
// cosine, 1/sr.

namespace vsgl {

// What the integral needs of a surface point. Local frame: tangent in the plane of incidence on the side of
// the view, bitangent across it, normal.
struct SpecularReceiver {
  Vec3 tangent, bitangent, normal;
  double sin_view = 0, cos_view = 1;  // cos_view >= 1e-4
  double alpha2 = 1;
  double across = 0;       // ndf_sharpness / (4 cos_view^2)
  double across_cos2 = 1;  // cosine of the view to the normal times that to the dominant normal
  Vec3 mirror;             // local: reflection at the dominant normal, times the sharpness of the lobe
  double view_lambda = 0;  // Smith's Lambda of the view direction
  std::uint32_t ndf = 0;
};
SpecularReceiver specular_receiver(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view);

Vec3 specular_local(const SpecularReceiver& r, Vec3 w);

// The parts of the values below; `light` is the light's axis in the local frame.
// How much of the product of the light and BRDF lobes is above the horizon, and the mean cosine of that.
struct SpecularHorizon {
  double visible = 0, cosine = 1;
};
SpecularHorizon specular_horizon(const SpecularReceiver& r, Vec3 light, double sharpness);
// GGX density (1/sr) at the half vector after filtering by the light, and sigma, the cosine that normalises
// it.
struct SpecularFilter {
  double density = 0, slope_cosine = 1;
};
SpecularFilter specular_filter(const SpecularReceiver& r, Vec3 light, double sharpness);

// [Tokuyoshi 2024] as published: GGX filtered by the light over 4 sigma.
double specular_vmf_filtered(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [EXT] GGX with masking, blended into the exact BRDF as the light sharpens.
double specular_vmf_ggx(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [EXT] Beckmann and Phong: Gaussian of projected half vectors, widened by the light; below sharpness 8
// filtered GGX of equal width.
double specular_vmf_projected(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [EXT] The same, with the BRDF at the light's axis for sharp lights.
double specular_vmf_gaussian(const SpecularReceiver& r, Vec3 axis, double sharpness);
// The light's spread filters the density of normals, without fall-back for sharp lights.
double specular_vmf_ndf_filter(const SpecularReceiver& r, Vec3 axis, double sharpness);
// GGX by the blended form, Beckmann and Phong by the Gaussian one.
double specular_vmf_blend(const SpecularReceiver& r, Vec3 axis, double sharpness);

}  // namespace vsgl
