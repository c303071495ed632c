// Sums each receiver's proxies, in the order of its group's list: logarithms of occlusion, indirect irradiance, solid angles.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/proxy.h"
#include "proxy/sh.glsl"
#include "proxy/sphere.glsl"

layout(local_size_x = PROXY_GROUP) in;
layout(constant_id = PROXY_OPERATOR_ID) const uint OPERATOR = PROXY_AVERAGED;
layout(scalar, binding = 0) readonly buffer Receivers { ProxyReceiver receivers[]; };
layout(scalar, binding = 1) readonly buffer Proxies { Proxy proxies[]; };
layout(scalar, binding = 2) readonly buffer Starts { uint starts[]; };  // one more than there are groups
layout(scalar, binding = 3) readonly buffer Lists { uint lists[]; };
layout(scalar, binding = 4) readonly buffer Table { ProxyEntry table[]; };
layout(scalar, binding = 5) readonly buffer Light { ProxyLight light; };
layout(scalar, binding = 6) writeonly buffer Sums { ProxySums sums[]; };
layout(scalar, push_constant) uniform Push { ProxyAccumulatePush push; };

#define BETWEEN(member) mix(table[entry].member, table[entry + 1u].member, part)

// Q u of the irradiance's quadratic form, in each colour: the rows' products with u.
mat3 quadratic(vec3 u) {
  return mat3(light.xx * u.x + light.xy * u.y + light.xz * u.z, light.xy * u.x + light.yy * u.y + light.yz * u.z,
              light.xz * u.x + light.yz * u.y + light.zz * u.z);
}
vec3 linear(vec3 u) { return light.x * u.x + light.y * u.y + light.z * u.z; }

// [Sloan 2007, Section 5] the polynomials for D, times sqrt(4 pi / (2l + 1)).
vec3 mean_emission(float sine) {
  const float d1 = (0.08432 * sine - 0.25073) * sine - 0.32494;
  const float d2 = ((-0.22230 * sine + 0.22502) * sine + 0.47398) * sine + 0.15950;
  return vec3(1.0, 2.0466534 * d1, 1.5853309 * d2);
}

// [Sloan 2007, Eq. (13) and (15)] radiance that stands for all of the proxy, times the cap's irradiance.
vec3 disk_irradiance(uint entry, float part, float sine, vec3 d, float cosine) {
  const vec3 bands = OPERATOR == PROXY_POINT ? vec3(1.0, -1.0, 1.0) : mean_emission(sine);
  const vec3 radiance = bands.x * light.constant + bands.y * linear(d) + bands.z * (quadratic(d) * d);
  const vec4 cap = BETWEEN(cap);
  return max(radiance, 0.0) * max(cap.x + cap.y * cosine + cap.z * (1.5 * cosine * cosine - 0.5), 0.0);
}

// [Sloan 2007, Eq. (17)] the clamped cosine's product with the exact radiance.
// Deviation: in the plane of the direction and the normal, where it takes no rotation matrices. Couplings in the order (m, band of the
// radiance, of the irradiance): 000 001 002 010 | 011 012 020 021 | 022 111 112 121 | 122 222.
vec3 exact_irradiance(uint entry, float part, vec3 d, vec3 normal, float cosine) {
  const vec4 c0 = BETWEEN(coupling0), c1 = BETWEEN(coupling1), c2 = BETWEEN(coupling2), c3 = BETWEEN(coupling3);
  const vec3 across = normal - cosine * d;
  const mat3 q = quadratic(d);
  const vec3 constant = light.constant, along = linear(d), along2 = q * d;
  const vec3 side = linear(across), side2 = q * across;
  const vec3 side22 = quadratic(across) * across + 0.5 * dot(across, across) * along2;
  const float second = 1.5 * cosine * cosine - 0.5;
  vec3 sum = c0.x * constant + c0.y * along + c0.z * along2;
  sum += cosine * (c0.w * constant + c1.x * along + c1.y * along2);
  sum += second * (c1.z * constant + c1.w * along + c2.x * along2);
  sum += c2.y * side + c2.z * side2 + cosine * (c2.w * side + c3.x * side2);
  return sum + c3.y * side22;
}

void main() {
  const uint receiver = gl_GlobalInvocationID.x, group = gl_WorkGroupID.x;
  const ProxyReceiver at = receivers[receiver];
  float log_occlusion[16] = float[16](0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
  vec3 indirect = vec3(0.0);
  float solid_angle = 0.0;
  const uint end = at.seen != 0u ? starts[group + 1u] : starts[group];
  for (uint i = starts[group]; i < end; ++i) {
    const Proxy proxy = proxies[lists[i]];
    vec3 center = proxy.center - at.position;
    float radius = proxy.radius;
    if (!sphere_above_plane(at.normal, center, radius)) continue;
    const float distance2 = dot(center, center), sine2 = min(radius * radius / distance2, 1.0), sine = sqrt(sine2);
    const float shadow = influence(sine, push.shadow_sine), lit = influence(sine, push.indirect_sine);
    if (shadow + lit == 0.0) continue;
    const vec3 d = center * inversesqrt(distance2);
    const float place = sine2 / (1.0 + sqrt(1.0 - sine2)) * float(PROXY_TABLE - 1u);
    const uint entry = min(uint(place), PROXY_TABLE - 2u);
    const float part = place - float(entry), cosine = dot(d, at.normal);
    const vec4 bands = shadow * BETWEEN(log_occlusion);
    float y[16];
    sh_basis(d, y);
    for (int k = 0; k < 16; ++k) log_occlusion[k] += bands[k < 1 ? 0 : k < 4 ? 1 : k < 9 ? 2 : 3] * y[k];
    solid_angle += shadow * BETWEEN(cap).w;
    const vec3 arriving = OPERATOR == PROXY_EXACT ? max(exact_irradiance(entry, part, d, at.normal, cosine), 0.0)
                                                  : disk_irradiance(entry, part, sine, d, cosine);
    indirect += lit * proxy.albedo * arriving;
  }
  vec4 packed[4];
  for (int k = 0; k < 4; ++k)
    packed[k] = vec4(log_occlusion[4 * k], log_occlusion[4 * k + 1], log_occlusion[4 * k + 2], log_occlusion[4 * k + 3]);
  sums[receiver] = ProxySums(packed, indirect, solid_angle);
}
