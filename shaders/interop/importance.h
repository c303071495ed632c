// How much of the light that an RSM texel reflects reaches the image, estimated from importance that the
// camera sends out.
#ifndef VSGL_INTEROP_IMPORTANCE_H
#define VSGL_INTEROP_IMPORTANCE_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// A point that reflects: a lit texel, or a pixel of the image (a view sample).
struct Reflector {
  vec3 position;  // m, relative to the anchor
  float alpha;
  vec3 normal;          // geometric, unit
  uint ndf;             // NDF_*
  vec3 shading_normal;  // unit
  vec3 incident;        // unit: texel: towards the light source; pixel: towards the camera
  vec3 diffuse;  // texel: reflected power, W, times the Rec.709 weights; pixel: reflectance over its density
  vec3 specular;
};
VSGL_CHECK_SIZE(Reflector, 80)

// A virtual spherical Gaussian light of importance: sent by the camera, reflected by pixels of the image.
struct Importon {
  vec3 position;
  float variance;  // per axis, m^2
  vec3 diffuse_axis;
  float diffuse_sharpness;
  vec3 diffuse_peak;  // of the SG, per steradian: power over the SG's integral
  float specular_sharpness;
  vec3 specular_axis;
  vec3 specular_peak;
};
VSGL_CHECK_SIZE(Importon, 72)

// Sources in one uniform block, at most 40 KiB.
VSGL_CONST uint IMPORTANCE_BLOCK = 512u;
// Texels per invocation and invocations per group.
VSGL_CONST uint IMPORTANCE_TEXELS = 8u;
VSGL_CONST uint IMPORTANCE_GROUP = 64u;

struct ImportancePush {
  uint texels;      // lit texels in the list
  uint sources;     // in the block
  float distance2;  // floor of the squared distance of view samples, m^2
};

// Specialisation constants: NDF_* of all texels in the list and of all specular sources, NDF_NONE: no
// specular lobe, IMPORTANCE_NDF_ANY: each has its own.
VSGL_CONST uint IMPORTANCE_TEXEL_NDF_ID = 0u;
VSGL_CONST uint IMPORTANCE_SOURCE_NDF_ID = 1u;
VSGL_CONST uint IMPORTANCE_NDF_ANY = 4u;

// Moments of a G-buffer seen as a reflective shadow map whose light is the camera, a flux of 1 arriving at
// every pixel.
struct ImageMomentsPush {
  uvec2 pixels_at;   // Surface, row by row
  uvec2 moments_at;  // Moments of size x size cells
  vec3 camera;       // m, relative to the anchor
  uint width, height;
  uint size;  // cells a side
  uint cell;  // pixels a side of a cell
};
VSGL_CHECK_SIZE(ImageMomentsPush, 44)

VSGL_INTEROP_END
#endif
