// Shades of the pixels from those of the four receivers about each.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/proxy.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = PROXY_UPSAMPLE_ID) const uint UPSAMPLE = PROXY_PLANE;
layout(scalar, binding = 0) readonly buffer Pixels { ProxyReceiver pixels[]; };        // row by row
layout(scalar, binding = 1) readonly buffer Receivers { ProxyReceiver receivers[]; };  // in their groups
layout(scalar, binding = 2) readonly buffer Slots { uint slots[]; };  // of each receiver, row by row, its place in a group
layout(scalar, binding = 3) readonly buffer Shades { ProxyShade shades[]; };
layout(scalar, binding = 4) writeonly buffer Results { ProxyPixel results[]; };
layout(scalar, push_constant) uniform Push { ProxyUpsamplePush push; };

const float DEPTH_TOLERANCE = 1e-3;  // of the distance to the camera

// [Sloan 2007, Eq. (11)] weight of a receiver besides the bilinear one, 0..1.
// Deviation: relative to the tolerance, so that weights of 1 stand for a receiver on the same surface; distances to the camera in
// place of depths; or, which is the default, distances from the pixel's tangent plane.
float similarity(ProxyReceiver pixel, ProxyReceiver receiver) {
  if (UPSAMPLE == PROXY_BILINEAR) return 1.0;
  const float depth = length(pixel.position - push.camera), tolerance = DEPTH_TOLERANCE * depth;
  const float off = UPSAMPLE == PROXY_BILATERAL ? abs(depth - length(receiver.position - push.camera))
                                                : abs(dot(receiver.position - pixel.position, pixel.normal));
  const float c = max(dot(pixel.normal, receiver.normal), 0.0), c2 = c * c, c4 = c2 * c2, c8 = c4 * c4, c16 = c8 * c8;
  return tolerance / (tolerance + off) * c16 * c16;
}

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= push.width || at.y >= push.height) return;
  const uint index = at.y * push.width + at.x;
  const ProxyReceiver pixel = pixels[index];
  ProxyPixel result = ProxyPixel(ProxyShade(vec3(0.0), vec3(0.0)), 0.0);
  // Receivers are pixels rate / 2 + i rate; beyond the outermost ones those count alone.
  const vec2 place = (vec2(at) - float(push.rate / 2u)) / float(push.rate);
  const ivec2 first = ivec2(floor(place)), last = ivec2(push.columns, push.rows) - 1;
  const vec2 part = place - vec2(first);
  for (int k = 0; k < 4 && pixel.seen != 0u; ++k) {
    const ivec2 step = ivec2(k & 1, k >> 1), corner = clamp(first + step, ivec2(0), last);
    const vec2 share = mix(1.0 - part, part, vec2(step));
    const uint slot = slots[uint(corner.y) * push.columns + uint(corner.x)];
    if (slot == PROXY_NO_SLOT) continue;
    const float weight = share.x * share.y * similarity(pixel, receivers[slot]);
    result.shade.direct += weight * shades[slot].direct;
    result.shade.indirect += weight * shades[slot].indirect;
    result.weight += weight;
  }
  const float scale = result.weight > 0.0 ? 1.0 / result.weight : 0.0;
  result.shade.direct *= scale;
  result.shade.indirect *= scale;
  results[index] = result;
}
