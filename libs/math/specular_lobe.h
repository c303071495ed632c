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
// [Xu 2013] integral of the normalised SG times the BRDF's ASG without its smooth term.
double specular_asg_convolved(const SpecularReceiver& r, Vec3 light, double sharpness);
// BRDF times cosine over the density of normals relative to its peak, in a direction at `cosine` to the
// normal.
double specular_coefficient(const SpecularReceiver& r, double cosine);

// [Tokuyoshi 2024] as published: GGX filtered by the light over 4 sigma.
double specular_vmf_filtered(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [EXT] GGX with masking, blended into the exact BRDF as the light sharpens.
double specular_vmf_ggx(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [EXT] Beckmann and Phong: Gaussian of projected half vectors, with fall-backs for broad and sharp lights.
double specular_vmf_gaussian(const SpecularReceiver& r, Vec3 axis, double sharpness);
// The most accurate form of each density of normals.
double specular_vmf(const SpecularReceiver& r, Vec3 axis, double sharpness);
// [Tokuyoshi 2016, C.2] ASG lobe [Xu 2013]; coefficient and smooth term at the light's axis as printed, or at
// the product lobe's.
double specular_vmf_asg(const SpecularReceiver& r, Vec3 axis, double sharpness);
double specular_vmf_asg_product(const SpecularReceiver& r, Vec3 axis, double sharpness);

}  // namespace vsgl
