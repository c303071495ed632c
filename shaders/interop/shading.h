// What the shading kernels of `shade` exchange with their host code.
#ifndef VSGL_INTEROP_SHADING_H
#define VSGL_INTEROP_SHADING_H
#include "interop/geometry.h"
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// A light with everything that does not depend on the pixel computed beforehand.
struct ShadingLight {
  vec3 position;      // mean, m, relative to the anchor; VPL: the representative point
  float variance;     // per axis, m^2, > 0
  vec3 diffuse_axis;  // along emission
  float diffuse_sharpness;
  vec3 power_diffuse;   // W
  float diffuse_scale;  // 1 / A(diffuse_sharpness): power times this is the SG's peak, W/sr
  vec3 specular_axis;
  float specular_sharpness;
  vec3 power_specular;   // W
  float specular_scale;  // 1 / A(specular_sharpness); disk formulation: also over the cosine of its axis
  vec3 normal;           // geometric, of the mean surface
  float bandwidth;       // sharpest emission lobe, for bias reduction
  vec3 shading_normal;   // of the representative point
  float alpha;
  vec3 incident;       // towards the light source
  float cos_incident;  // incident . shading_normal, at least 1e-4
  uint ndf;            // NDF_* of the representative surface
  uint index;          // of the light in lights.exr: its tile in the shadow atlas, its visibility bit
  float inverse_variance;
};
VSGL_CHECK_SIZE(ShadingLight, 140)

// Lights (or Clusters, which are smaller) in one uniform block of 64 KiB; the host fills less where the
// device's limit is lower.
VSGL_CONST uint SHADING_BLOCK_LIGHTS = 468u;

// Sums of one receiver, without its reflectances.
struct ShadingSums {
  vec3 diffuse;   // irradiance / pi
  float aside;    // luminance of the radiance that cancelled lights gave; VPL: that the clamp took away
  vec3 specular;  // radiance / specular reflectance
  float padding;
};
VSGL_CHECK_SIZE(ShadingSums, 32)

// Virtual spherical lights: how the integral over a light's cone is sampled.
struct VslSampling {
  uint samples;     // directions a technique draws in a hemisphere; narrower cones take fewer
  uint techniques;  // sum of VSL_*
  uint sphere;      // 1: cone of the sphere, 0: of the disk
  uint seed;
};
VSGL_CHECK_SIZE(VslSampling, 16)
VSGL_CONST uint VSL_CONE = 1u;      // uniform in the cone
VSGL_CONST uint VSL_RECEIVER = 2u;  // the BRDF of the pixel
VSGL_CONST uint VSL_LIGHT = 4u;     // the BRDF of the light

struct ShadingPush {
  vec3 camera;            // relative to the anchor, m
  uint receivers;         // in the list
  uint lights;            // in the block
  float cancel_scale;     // 2 / a_cbr
  float clamp_distance2;  // VPL: floor of the squared distance, m^2
  uint tile;              // shadow map texels a side
  uint columns;           // tiles a row of the atlas
  float disk_bias;        // m
  float normal_offset;    // texels
  float slope_bias;       // texels per tangent
  float relative_bias;
  uint first_row;   // of the atlas: light `index` has its map in tile row index / columns - first_row
  uint first_word;  // of the block's lights: light `index` has bit index % 32 of word index / 32 - first_word
  VslSampling vsl;
};
VSGL_CHECK_SIZE(ShadingPush, 76)

// Kinds of visibility.
VSGL_CONST uint VISIBILITY_NONE = 0u;
VSGL_CONST uint VISIBILITY_MAPS = 1u;
VSGL_CONST uint VISIBILITY_BITS = 2u;

// How the receiver's specular lobe and the light's spherical Gaussian are multiplied and integrated.
VSGL_CONST uint SPECULAR_LOBE_AUTO = 0u;        // the most accurate form: mixture
VSGL_CONST uint SPECULAR_LOBE_SG = 1u;          // lobe and light as SGs
VSGL_CONST uint SPECULAR_LOBE_ASG = 2u;         // lobe as an anisotropic SG
VSGL_CONST uint SPECULAR_LOBE_ASG_ASG = 3u;     // lobe and light as anisotropic SGs
VSGL_CONST uint SPECULAR_LOBE_NDF_FILTER = 4u;  // the light filters the density of normals
VSGL_CONST uint SPECULAR_LOBE_BLEND = 5u;       // filtered density, blended into the BRDF
VSGL_CONST uint SPECULAR_LOBE_MIXTURE = 6u;     // peak of the product, the density as a mixture of Gaussians

// Where a light's shadow map looks: hemisphere about `axis`.
struct ShadingView {
  vec3 origin;  // m, relative to the anchor
  vec3 axis;    // unit
};
VSGL_CHECK_SIZE(ShadingView, 24)

struct DirectPush {
  View view;       // the layer's
  vec3 camera;     // relative to the anchor, m
  uint receivers;  // in the list
  uint stride;     // texels a row of the layer
};
VSGL_CHECK_SIZE(DirectPush, 120)

// Specialisation constants of the shading kernels.
VSGL_CONST uint SHADING_RECEIVER_ID =
    0u;  // NDF_* of the receivers, NDF_NONE: diffuse only, NDF_ANY: read per pixel
VSGL_CONST uint SHADING_EMISSION_ID = 1u;  // NDF_* of the lights, likewise
VSGL_CONST uint SHADING_SHADOWS_ID = 2u;   // VISIBILITY_*
VSGL_CONST uint SHADING_CANCEL_ID = 3u;    // 1: consistent bias reduction
VSGL_CONST uint SHADING_BUMPED_ID = 4u;    // 1: shading normals differ from geometric ones
VSGL_CONST uint SHADING_LOBE_ID = 5u;      // SPECULAR_LOBE_*
VSGL_CONST uint SHADING_PIXELS_ID = 6u;    // pixels per invocation
VSGL_CONST uint NDF_ANY = 4u;

// Invocations per group.
VSGL_CONST uint SHADING_GROUP = 64u;

VSGL_INTEROP_END
#endif
