// Lists of the proxies whose spheres of influence touch each group of receivers, in the order of the proxies: first how many, then, at
// the places that the host has found for them, which.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/proxy.h"

layout(local_size_x = 64) in;
layout(constant_id = PROXY_FILL_ID) const uint FILL = 0u;
layout(scalar, binding = 0) readonly buffer Receivers { ProxyReceiver receivers[]; };
layout(scalar, binding = 1) readonly buffer Proxies { Proxy proxies[]; };
layout(scalar, binding = 2) buffer Starts { uint starts[]; };  // per group: the count, or where its list begins
layout(scalar, binding = 3) writeonly buffer Lists { uint lists[]; };
layout(scalar, push_constant) uniform Push { ProxyCullPush push; };

void main() {
  const uint group = gl_GlobalInvocationID.x;
  if (group >= push.groups) return;
  vec3 low = vec3(3e38), high = vec3(-3e38);
  for (uint i = group * PROXY_GROUP; i < (group + 1u) * PROXY_GROUP; ++i)
    if (receivers[i].seen != 0u) {
      low = min(low, receivers[i].position);
      high = max(high, receivers[i].position);
    }
  uint count = 0u;
  for (uint i = 0u; i < push.proxies; ++i) {
    const vec3 center = proxies[i].center, off = center - clamp(center, low, high);
    const float reach = push.reach * proxies[i].radius;
    if (dot(off, off) >= reach * reach) continue;
    if (FILL == 1u) lists[starts[group] + count] = i;
    ++count;
  }
  if (FILL == 0u) starts[group] = count;
}
