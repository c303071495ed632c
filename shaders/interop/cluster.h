// A cluster of lit texels as a filtered virtual point light (FVPL), and the lists of clusters that an image
// tile needs.
#ifndef VSGL_INTEROP_CLUSTER_H
#define VSGL_INTEROP_CLUSTER_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// A Light with everything that does not depend on the receiver computed beforehand; seven vec4 in a texel
// buffer. Without power all of it is 0; without specular power the lobe is a broad one, so that kernels for
// mixed clusters stay finite.
struct Cluster {
  vec3 position;           // mean, m, relative to the anchor
  float inverse_variance;  // 1 / sigma^2, 1/m^2, finite
  vec3 normal;             // mean geometric normal, unit
  float
      normal_sharpness;  // kappa of the vMF of the normals; above CLUSTER_FLAT the emission is max(cosine, 0)
  vec3 diffuse;          // power_diffuse / pi, W/sr
  float incident_masking;  // 1 + Smith's Lambda of the direction to the source
  vec3 shading_normal;     // mean, of the specular texels, unit
  float facet_turn;  // how far towards the half vector the normals turn that reflect there, 0 (parallel) to 1
  vec3 incident;     // mean direction to the source, unit
  float alpha2;   // of the widened lobe: alpha^2 + lobe_variance (distance to the receiver not yet counted)
  vec3 specular;  // power_specular / (4 cosine to the source of the shading normal), W; GGX: over pi, too
  float masking_alpha2;  // alpha^2 of the surface itself
  uint ndf;              // NDF_* of the specular emission, NDF_NONE: none
  uint children;         // index of the first of four, 0: a leaf
  uint light;            // row of lights.exr
  float reach;  // from the mean to where texels may be, m: two sigma, or further for nodes with outliers
};
VSGL_CHECK_SIZE(Cluster, 112)

// Normals spread less than this sharpness says count as parallel.
VSGL_CONST float CLUSTER_FLAT = 200.0f;
// From this squared distance on, in units of sigma^2, a cluster lights a diffuse receiver like a point.
VSGL_CONST float CLUSTER_POINT = 100.0f;
// From this one on its footprint is so narrow that none of it is behind the receiver.
VSGL_CONST float CLUSTER_MIDDLE = 16.0f;
// A specular receiver besides asks for this multiple of its lobe's sharpness (across the plane of incidence).
VSGL_CONST float CLUSTER_POINT_SPECULAR = 5.0f;

// Tiles of a cut: TILE x TILE pixels, from the top-left corner of the image; pixel (x, y) of a tile has bit y
// TILE + x of a mask.
VSGL_CONST uint TILE = 16u;
VSGL_CONST uint MASK_WORDS = 8u;

VSGL_INTEROP_END
#endif
