// A visible or lit surface point.
#ifndef VSGL_INTEROP_SURFACE_H
#define VSGL_INTEROP_SURFACE_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// One pixel of a G-buffer or one texel of an RSM.
struct Surface {
  vec3 position;        // m, relative to the anchor
  float alpha;          // roughness (Phong: sqrt(2/(n+2))); 1 without a specular lobe
  vec3 normal;          // geometric, unit, towards the viewer (camera or light)
  uint ndf;             // NDF_*
  vec3 shading_normal;  // unit
  uint id;              // instance, NO_INSTANCE where nothing is seen
  vec3 diffuse;         // reflectance, 0..1
  float depth;          // distance to the viewer, m
  vec3 specular;        // reflectance, 0..1
};
VSGL_CHECK_SIZE(Surface, 76)

VSGL_INTEROP_END
#endif
