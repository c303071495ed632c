// What Monte Carlo over the cone of a virtual spherical light needs: the cone, directions in it, and directions in proportion to a BRDF.
#ifndef VSGL_LIB_VSL_GLSL
#define VSGL_LIB_VSL_GLSL

#include "lib/frame.glsl"
#include "lib/microfacet.glsl"

// 1 - cos of the half angle of the cone in which a light of squared radius `radius2` is seen from squared distance `d2`, 0..1.
// [Tokuyoshi 2014, Sec. 3.1] A disk that faces the receiver: cos = d / s, s^2 = d^2 + r^2; the hemisphere at d = 0.
float disk_cone_height(float d2, float radius2) {
  float s = sqrt(d2 + radius2);
  return radius2 / max(s * (s + sqrt(d2)), 1e-36);
}

// [Hasan 2009] The sphere itself: sin = r / d, 0..1; 2, all directions, from inside.
float sphere_cone_height(float d2, float radius2) {
  float d = sqrt(d2);
  return d2 > radius2 ? radius2 / (d * (d + sqrt(d2 - radius2))) : 2.0;
}

// Uniform in the cone about `axis`; u in [0, 1)^2.
vec3 cone_direction(vec3 axis, float height, vec2 u) {
  float below = u.x * height;
  float sine = sqrt(below * (2.0 - below));
  float azimuth = 2.0 * PI * u.y;
  return frame_about(axis) * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - below);
}

// A surface that scatters the light from `view`, as a mixture of Lambert's law and a specular lobe.
struct Scatterer {
  vec3 view;    // unit
  vec3 plane;   // normal of Lambert's cosine
  vec3 normal;  // mean normal of the microfacets
  float alpha2;
  float specular;  // probability of the specular lobe, 0..1
  uint ndf;
};

// Tilt of a microfacet distributed as density times cosine, as a squared sine. [Walter 2007, Eqs. (28), (31), (35)]
// Deviation: squared sines in place of angles, which keep their digits for small alpha.
float microfacet_sin2(uint ndf, float alpha2, float u) {
  if (ndf == NDF_GGX) return alpha2 * u / (1.0 - u + alpha2 * u);
  float logarithm = log(1.0 - u);
  if (ndf == NDF_PHONG) return -expm1(alpha2 * logarithm);
  return alpha2 * logarithm / (alpha2 * logarithm - 1.0);
}

// Unit direction of scattered light; zero where a microfacet faces away from `view`. u.x both chooses the lobe and, stretched, serves it.
vec3 scatter_direction(Scatterer s, vec2 u) {
  bool mirrored = u.x < s.specular;
  float x = mirrored ? u.x / s.specular : (u.x - s.specular) / (1.0 - s.specular);
  float sin2 = clamp(mirrored ? microfacet_sin2(s.ndf, s.alpha2, min(x, 0.99999994)) : x, 0.0, 1.0);
  float sine = sqrt(sin2);
  float azimuth = 2.0 * PI * u.y;
  vec3 local = vec3(sine * cos(azimuth), sine * sin(azimuth), sqrt(1.0 - sin2));
  if (!mirrored) return frame_about(s.plane) * local;
  vec3 h = frame_about(s.normal) * local;
  float cosine = dot(s.view, h);
  return cosine > 0.0 ? 2.0 * cosine * h - s.view : vec3(0.0);
}

// Its density, 1/sr: with h = view + w a specular direction has D (h.n / |h|) / (4 view.h / |h|), and view.h = |h|^2 / 2.
float scatter_pdf(Scatterer s, vec3 w) {
  float density = (1.0 - s.specular) * max(dot(w, s.plane), 0.0) / PI;
  if (s.specular <= 0.0) return density;
  vec3 h = s.view + w;
  float hn = dot(h, s.normal);
  vec3 t = h - hn * s.normal;
  float inverse = 1.0 / max(dot(h, h), 1e-12);
  float facets = ndf_density(s.ndf, s.alpha2, dot(t, t) * inverse, hn * hn * inverse);
  return density + s.specular * facets * max(hn, 0.0) * 0.5 * inverse;
}

#endif
