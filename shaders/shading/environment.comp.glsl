#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// [Tokuyoshi 2016, Sec. 7] Lights of an environment: each is an SG of radiance from infinitely far away, with neither distance nor
// footprint.

#include "shading/common.glsl"
#include "shading/receive.glsl"
#include "shading/shadow.glsl"

// The SG whose amplitude is 1 where it comes from; it is the same everywhere.
Incoming distant_light(ShadingLight light) {
  Incoming incoming;
  incoming.axis = -light.diffuse_axis;
  incoming.sharpness = clamp(light.diffuse_sharpness, SHARPNESS_MIN, SHARPNESS_MAX);
  incoming.inverse_sharpness = 1.0 / incoming.sharpness;
  incoming.amplitude = 2.0 * PI;
  float decayed = fast_expm1(-incoming.sharpness);
  incoming.decay = 1.0 + decayed;
  incoming.phi = -decayed * incoming.inverse_sharpness;
  return incoming;
}

void add_light(Receiver r, ShadingLight light, inout Sums sums) {
  Incoming incoming = distant_light(light);
  vec2 received = light.diffuse_scale * visibility(r, light.index) * receive(r, incoming);
  if (BUMPED != 0) received *= geometric_horizon(r, incoming.axis, incoming.sharpness);
  add(sums, light, Transfer(vec2(received.x, 0.0), vec2(received.y, 0.0)));
}

#include "shading/loop.glsl"
