// A virtual light, as vsgl-gen writes it and shade reads it.
#ifndef VSGL_INTEROP_LIGHT_H
#define VSGL_INTEROP_LIGHT_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// One light: a Gaussian footprint with two emission lobes (VSGL), and the representative surface point that
// makes it a VPL. For a VPL variance = 0 and the lobes are unused. A node of a light tree (method "tree") is
// a cluster of texels: its alpha, shading_normal and incident are those of the cluster's mean, weighted by
// the specular power (without any, by all of the power); origin and texel are the texel nearest to the mean
// position.
struct Light {
  vec3 position;            // mean, m, relative to the anchor
  float variance;           // per axis (planar), sigma^2 = E|y - mean|^2 / 2, m^2
  vec3 power_diffuse;       // W
  float diffuse_sharpness;  // of the normalised SG
  vec3 diffuse_axis;        // along emission, unit
  float specular_sharpness;
  vec3 power_specular;    // W
  float alpha;            // roughness of the representative specular lobe (Phong: sqrt(2/(n+2)))
  vec3 specular_axis;     // along emission, unit
  uint ndf;               // NDF_* of the representative specular lobe
  vec3 normal;            // geometric, unit: the side from which light leaves
  float normal_deficit;   // 1 - |mean normal|^2 over the cluster
  vec3 shading_normal;    // of the representative point, unit
  float level;            // mip level of the kernel, 0 = one texel
  vec3 incident;          // unit, towards the light source, at the representative point
  uint texel;             // row-major index of the sampled texel in its RSM layer
  vec3 origin;            // representative point on a surface (the sampled texel), m, relative to the anchor
  uint layer;             // which RSM layer (light, cube face)
  float lobe_variance;    // of the half vectors of the cluster's specular lobes, beyond those of alpha: 1 -
                          // |mean shading normal|^2 plus variance / (2 distance to the source^2); 0 for a
                          // single point. Added to alpha^2
  uint children;          // in a light tree: index of the first of four; 0: a leaf
  float shading_deficit;  // 1 - |mean shading normal|^2 over the cluster's specular texels, part of
                          // lobe_variance
};
VSGL_CHECK_SIZE(Light, 156)

VSGL_INTEROP_END
#endif
