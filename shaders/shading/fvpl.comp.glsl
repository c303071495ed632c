#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Filtered virtual point lights: clusters with their mean BRDF, seen as Gaussian footprints.

#include "interop/cluster.h"
#define SHADING_LIGHT Cluster
#include "shading/common.glsl"
#include "shading/footprint.glsl"
#include "shading/shadow.glsl"

void add_light(Receiver r, Cluster light, inout Sums sums) {
  vec3 v = light.position - r.position;
  FvplView view = fvpl_view(v, light.inverse_variance);
  float lit = visibility(r, light.light);
  if (BUMPED != 0) lit *= geometric_horizon(r, v, light.inverse_variance);
  uint ndf = EMISSION == NDF_ANY ? light.ndf : EMISSION;
  vec3 emission = lit * fast_fvpl_emission(ndf, light, view.u, view.inverse_d2);
  vec2 reflection = receive_footprint(r, light, view);
  sums.diffuse += reflection.x * emission;
  if (RECEIVER != NDF_NONE) sums.specular += reflection.y * emission;
}

#include "shading/loop.glsl"
