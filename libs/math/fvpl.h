#pragma once

#include "interop/cluster.h"
#include "math/specular_lobe.h"

// Filtered virtual point light (FVPL) in double precision: the twin of shaders/lib/fvpl.glsl, where the
// symbols are explained. Directions `u` are unit vectors from the receiver to the cluster's mean.

namespace vsgl {

// A cluster as a receiver sees it.
struct FvplView {
  Vec3 u;                 // 0 in the very place of the mean
  double d2 = 0;          // squared distance, m^2
  double inverse_d2 = 0;  // 1/m^2, at most 1e24
  double sharpness = 0;   // d2 / sigma^2
};
// v: from the receiver to the mean, m.
FvplView fvpl_view(Vec3 v, double inverse_variance);

// Whether the cluster lights the receiver like a point. `across`: of the SpecularReceiver, 0 without a
// specular lobe.
bool fvpl_is_point(double sharpness, double across);

// Mean of the clamped cosine of a direction over the cluster's normals, 0..1; c = direction . mean normal.
double fvpl_cosine(double c, double normal_sharpness);

// Density of half vectors, 1/sr, of a GGX lobe whose normals are spread: alpha2 of the surface, `spread`
// added by the cluster.
double ggx_spread_d(double alpha2, double spread, double sin2, double cos2);

// Specular BRDF of the widened lobe times the cosine `seen` from the light source to `w`, 1/sr, over the
// constant that c.specular holds.
double fvpl_specular(const interop::Cluster& c, Vec3 w, double inverse_d2, double seen);

// Radiant intensity towards the receiver, W/sr: without specular emission and of parallel normals, of
// parallel normals, and any.
Vec3 fvpl_emission_diffuse(const interop::Cluster& c, Vec3 u);
Vec3 fvpl_emission_flat(const interop::Cluster& c, Vec3 u, double inverse_d2);
Vec3 fvpl_emission(const interop::Cluster& c, Vec3 u, double inverse_d2);

// What irradiance from the mean of a flat cluster is multiplied by since its texels lie in a plane, 0..2.
// `cosine`: clamped, at the receiver; `blurred`: 1 if it is a mean over the footprint, or 0.
double fvpl_plane(const interop::Cluster& c, Vec3 u, Vec3 receiver_normal, double cosine,
                  double inverse_sharpness, double blurred);

// Radiance per unit of radiant intensity and of each reflectance, 1/m^2.
struct FvplReflection {
  double diffuse = 0, specular = 0;
};
FvplReflection fvpl_point(const SpecularReceiver& r, const interop::Cluster& c, const FvplView& view);
FvplReflection fvpl_extended(const SpecularReceiver& r, const interop::Cluster& c, const FvplView& view);

// Irradiance over a sphere per unit of radiant intensity, 1/m^2: 1 / d2 far away, at most 2 / sigma^2.
double fvpl_fluence(double d2, double inverse_variance);

}  // namespace vsgl
