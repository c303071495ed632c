// What the kernel that shades by a cut exchanges with its host code.
#ifndef VSGL_INTEROP_CUT_SHADING_H
#define VSGL_INTEROP_CUT_SHADING_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// Most receivers of a block, all of one tile; a mask of two words.
VSGL_CONST uint CUT_BLOCK = 64u;

// One workgroup: receivers that share a list of clusters, sorted by what their evaluation needs.
struct CutBlock {
  uint receiver;   // first in the list of receivers
  uint receivers;  // how many, 1..CUT_BLOCK
  uint plain;      // first item: far from all receivers, of parallel normals, without specular emission
  uint glossy;     // from here on: the same with specular emission
  uint middle;     // from here on: narrow footprints (CLUSTER_MIDDLE), for diffuse receivers
  uint near;       // from here on: all others
  uint end;
};
VSGL_CHECK_SIZE(CutBlock, 28)

// An item of a list: index of the cluster, and where visibility is known a mask of two words: bit k % 32 of word
// k / 32 is set where receiver k of the block sees it. Words of each, a texel.
VSGL_CONST uint CUT_ITEM = 1u;
VSGL_CONST uint CUT_MASKED_ITEM = 4u;

// Texels (vec4) of a Cluster.
VSGL_CONST uint CLUSTER_TEXELS = 7u;

// Sums of one receiver, without its reflectances.
struct CutSums {
  vec3 diffuse;   // irradiance / pi
  vec3 specular;  // radiance / specular reflectance
};
VSGL_CHECK_SIZE(CutSums, 24)

struct CutPush {
  vec3 camera;  // relative to the anchor, m
};
VSGL_CHECK_SIZE(CutPush, 12)

// Specialisation constants besides those of interop/shading.h (receiver, emission, bumped, pixels).
VSGL_CONST uint CUT_LANES_ID = 7u;   // invocations of a group, a divisor of 32
VSGL_CONST uint CUT_MASKED_ID = 8u;  // 1: items have masks

VSGL_INTEROP_END
#endif
