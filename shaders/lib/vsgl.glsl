// Light that a VSGL (Gaussian footprint, SG emission) sends to a point, as one spherical Gaussian.
#ifndef VSGL_LIB_VSGL_GLSL
#define VSGL_LIB_VSGL_GLSL

#include "lib/constants.glsl"
#include "lib/sg.glsl"

// Normalised SG of incoming radiance (axis points to the light) and its integral over the sphere.
struct VsglIncoming {
  vec3 axis;
  float sharpness;
  float fluence;  // 1/m^2: times the radiant-intensity amplitude Phi / sg_integral(emission sharpness), W/sr, it is W/m^2
};

// Product of the emission lobe with the footprint's SG of sharpness d2 / variance about `u`, unit, towards the light. The fluence is
// e^exponent (1 - e^(-2 sharpness)) / q with q = variance * sharpness, from which no amplitude or 1 / variance is ever formed.
VsglIncoming vsgl_product(vec3 u, float d2, float variance, vec3 emission_axis, float emission_sharpness) {
  float b = variance * emission_sharpness;
  float total = d2 + b;
  float inverse = 1.0 / max(total, 1e-36);
  float share = d2 * inverse;
  vec3 m = share * u - (b * inverse) * emission_axis;
  float m2 = dot(m, m);
  float inverse_length = inversesqrt(max(m2, 1e-36));
  float relative = m2 * inverse_length;  // q / total, 0..1
  float q = relative * total;
  vec3 axis = m2 > 1e-36 ? m * inverse_length : u;
  float sharpness = q < SHARPNESS_MAX * variance ? q / max(variance, 1e-36) : SHARPNESS_MAX;
  vec3 turn = u + emission_axis;
  float exponent = -emission_sharpness * (share / (1.0 + relative)) * dot(turn, turn);
  float spread = sharpness > 0.5 ? -expm1(-2.0 * sharpness) / max(q, 1e-36)
                                 : 2.0 * phi(-2.0 * sharpness) / max(variance, 1e-36);
  return VsglIncoming(axis, sharpness, (exponent > -87.0 ? exp(exponent) : 0.0) * spread);
}

// [Tokuyoshi 2016, Eqs. (11)-(12)] v: from the receiver to the light's mean position, m; variance: per axis, m^2.
// Deviation: `variance` is half of E|y - mean|^2 (the paper prints all of it, which makes lights sqrt(2) too wide); scaled form.
// Finite even at v = 0 (with the light's axis for a direction) as long as the variance is not 0, too. A point light (variance 0)
// gives e^... / d^2 exactly.
VsglIncoming vsgl_incoming(vec3 v, float variance, vec3 emission_axis, float emission_sharpness) {
  float d2 = dot(v, v);
  vec3 u = d2 > 1e-36 ? v * inversesqrt(d2) : -emission_axis;
  return vsgl_product(u, d2, variance, emission_axis, emission_sharpness);
}

// [Tokuyoshi 2014, Sec. 3.2] The uniform disk of radius r, r^2 = 2 E|y - mean|^2 = 4 variance, seen head on from distance d.
struct DiskCone {
  float solid_angle;  // sr
  float sharpness;    // of the SG of amplitude 2 that stands for the cone: 4 pi / solid_angle
  float density;      // solid_angle / (pi r^2), 1/m^2: 1/d^2 far away, 2/r^2 at the centre
};

// Deviation: 1 - cos = r^2 / (s (s + d)), s = sqrt(d^2 + r^2), keeps its digits for narrow cones.
DiskCone disk_cone(float d, float radius2) {
  float s = sqrt(d * d + radius2);
  float reach = max(s * (s + d), 1e-36);
  float sharpness = 2.0 * reach < SHARPNESS_MAX * radius2 ? 2.0 * reach / max(radius2, 1e-36) : SHARPNESS_MAX;
  return DiskCone(2.0 * PI * radius2 / reach, sharpness, 2.0 / reach);
}

// [Tokuyoshi 2014, Sec. 3.2] The same with the light as a disk. The cone's sharpness, s (s + d) / (2 variance), takes the place of
// d^2 / variance; 2 / (pi r^2) times the SG integral is the same fluence.
VsglIncoming vsgl_incoming_disk(vec3 v, float variance, vec3 emission_axis, float emission_sharpness) {
  float d2 = dot(v, v);
  float inverse = inversesqrt(max(d2, 1e-36));
  vec3 u = d2 > 1e-36 ? v * inverse : -emission_axis;
  float s = sqrt(d2 + 4.0 * variance);
  return vsgl_product(u, 0.5 * s * (s + d2 * inverse), variance, emission_axis, emission_sharpness);
}

#endif
