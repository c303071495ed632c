// Sums each receiver's proxies, in the order of its group's list: logarithms of occlusion, indirect irradiance, and how much they cover.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/proxy.h"
#include "proxy/sh.glsl"
#include "proxy/sphere.glsl"

layout(local_size_x = PROXY_GROUP) in;
layout(constant_id = PROXY_OPERATOR_ID) const uint OPERATOR = PROXY_AVERAGED;
layout(constant_id = PROXY_NORMALISATION_ID) const uint NORMALISATION = PROXY_COSINE;
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

// [Sloan 2007, Section 5] D, times sqrt(4 pi / (2l + 1)); see libs/sh/emission.h. a, c: sine and cosine of the half angle.
vec3 mean_emission(float a, float c) {
  const float inverse = 1.0 / (1.0 + c);
  return vec3(1.0, -(1.0 + a + c + a * inverse) / 3.0, 0.1 * (3.0 + 3.0 * inverse - c - c * c + 4.0 * a * (1.0 + c)));
}

// Irradiance of a cap of radiance 1.
float cap_irradiance(vec4 cap, float cosine) {
  return max(cap.x + cap.y * cosine + cap.z * (1.5 * cosine * cosine - 0.5), 0.0);
}

// [Sloan 2007, Eq. (13) and (15)] radiance that stands for all of the proxy.
vec3 disk_radiance(float sine, vec3 d) {
  const vec3 bands = OPERATOR == PROXY_POINT ? vec3(1.0, -1.0, 1.0) : mean_emission(sine, sqrt(max(1.0 - sine * sine, 0.0)));
  const vec3 radiance = bands.x * light.constant + bands.y * linear(d) + bands.z * (quadratic(d) * d);
  return max(radiance, 0.0);
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
  return max(sum + c3.y * side22, 0.0);
}

// Share of the proxy that counts: between the distances that are stated.
float exposure(uint proxy, float sine2) {
  const float place = clamp(-0.5 * log2(sine2), 0.0, float(PROXY_EXPOSURES - 1u));
  const uint level = min(uint(place), PROXY_EXPOSURES - 2u);
  return mix(proxies[proxy].exposed[level], proxies[proxy].exposed[level + 1u], place - float(level));
}

void main() {
  const uint receiver = gl_GlobalInvocationID.x, group = gl_WorkGroupID.x;
  const ProxyReceiver at = receivers[receiver];
  float log_occlusion[16] = float[16](0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
  vec3 indirect = vec3(0.0);
  float covering = 0.0;
  const uint end = at.seen != 0u ? starts[group + 1u] : starts[group];
  for (uint i = starts[group]; i < end; ++i) {
    const uint proxy = lists[i];
    vec3 center = proxies[proxy].center - at.position;
    float radius = proxies[proxy].radius;
    if (!sphere_above_plane(at.normal, center, radius)) continue;
    const float distance2 = dot(center, center), sine2 = min(radius * radius / distance2, 1.0), sine = sqrt(sine2);
    const float exposed = exposure(proxy, sine2);
    const float shadow = exposed * influence(sine, push.shadow_sine), lit = exposed * influence(sine, push.indirect_sine);
    if (shadow + lit == 0.0) continue;
    const vec3 d = center * inversesqrt(distance2);
    const float place = sine2 / (1.0 + sqrt(1.0 - sine2)) * float(PROXY_TABLE - 1u);
    const uint entry = min(uint(place), PROXY_TABLE - 2u);
    const float part = place - float(entry), cosine = dot(d, at.normal);
    const vec4 bands = shadow * BETWEEN(log_occlusion);
    float y[16];
    sh_basis(d, y);
    for (int k = 0; k < 16; ++k) log_occlusion[k] += bands[k < 1 ? 0 : k < 4 ? 1 : k < 9 ? 2 : 3] * y[k];
    const vec4 cap = BETWEEN(cap);
    const float even = cap_irradiance(cap, cosine);
    covering += NORMALISATION == PROXY_COSINE ? lit * even : shadow * cap.w;
    const vec3 arriving = OPERATOR == PROXY_EXACT ? exact_irradiance(entry, part, d, at.normal, cosine) : even * disk_radiance(sine, d);
    indirect += lit * proxies[proxy].albedo * arriving;
  }
  vec4 packed[4];
  for (int k = 0; k < 4; ++k)
    packed[k] = vec4(log_occlusion[4 * k], log_occlusion[4 * k + 1], log_occlusion[4 * k + 2], log_occlusion[4 * k + 3]);
  sums[receiver] = ProxySums(packed, indirect, covering);
}
