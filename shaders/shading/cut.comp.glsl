#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Shading by a cut through a light tree: one workgroup per block of receivers, several receivers an invocation, and a loop of its own for
// each class of clusters, since lanes that disagree about a branch would pay for both sides.

#include "interop/cut_shading.h"
#include "shading/distant.glsl"
#include "shading/footprint.glsl"

layout(local_size_x_id = CUT_LANES_ID) in;

layout(constant_id = SHADING_EMISSION_ID) const uint EMISSION = NDF_NONE;
layout(constant_id = SHADING_PIXELS_ID) const uint PIXELS = 8;  // receivers an invocation: CUT_BLOCK over the invocations
layout(constant_id = CUT_MASKED_ID) const uint MASKED = 0;

layout(scalar, binding = 0) readonly buffer Receivers { Surface surfaces[]; };
layout(scalar, binding = 1) readonly buffer Blocks { CutBlock blocks[]; };
layout(binding = 2) uniform samplerBuffer clusters;
layout(binding = 3) uniform usamplerBuffer items;
layout(scalar, binding = 4) writeonly buffer Results { CutSums results[]; };
layout(scalar, push_constant) uniform Push { CutPush push; };

struct Item {
  uint cluster;
  uvec2 mask;  // shifted: bit 0 of a word belongs to the first of this invocation's receivers there
};

Item load_item(uint i) {
  uvec4 texel = texelFetch(items, int(i));
  return Item(texel.x, texel.yz >> gl_LocalInvocationIndex);
}

// Whether receiver j of this invocation sees the item's cluster: 0 or 1.
float visibility(Item item, uint j) {
  if (MASKED == 0) return 1.0;
  uint place = j * gl_WorkGroupSize.x;
  return float((item.mask[place / 32] >> (place % 32)) & 1u);
}

// The first three texels are all that a cluster without specular emission has.
Cluster load_diffuse(uint index) {
  int first = int(CLUSTER_TEXELS * index);
  vec4 position = texelFetch(clusters, first);
  vec4 normal = texelFetch(clusters, first + 1);
  vec4 diffuse = texelFetch(clusters, first + 2);
  Cluster c;
  c.position = position.xyz;
  c.inverse_variance = position.w;
  c.normal = normal.xyz;
  c.normal_sharpness = normal.w;
  c.diffuse = diffuse.xyz;
  c.incident_masking = diffuse.w;
  return c;
}

Cluster load_cluster(uint index) {
  Cluster c = load_diffuse(index);
  if (EMISSION == NDF_NONE) return c;
  int first = int(CLUSTER_TEXELS * index);
  vec4 shading_normal = texelFetch(clusters, first + 3);
  vec4 incident = texelFetch(clusters, first + 4);
  vec4 specular = texelFetch(clusters, first + 5);
  c.shading_normal = shading_normal.xyz;
  c.facet_turn = shading_normal.w;
  c.incident = incident.xyz;
  c.alpha2 = incident.w;
  c.specular = specular.xyz;
  c.masking_alpha2 = specular.w;
  c.ndf = EMISSION == NDF_ANY ? floatBitsToUint(texelFetch(clusters, first + 6).x) : EMISSION;
  return c;
}

struct Sums {
  vec3 diffuse, specular;
};

void add(inout Sums sums, vec3 emission, vec2 received) {
  sums.diffuse += received.x * emission;
  if (RECEIVER != NDF_NONE) sums.specular += received.y * emission;
}

// Far away, of parallel normals, without specular emission. A diffuse receiver takes neither a root nor a direction: its emission, its
// reflection and 1 / d2 are cosines over d2^2.
void add_plain(Receiver r, Cluster c, float seen, inout Sums sums) {
  vec3 v = c.position - r.position;
  float d2 = dot(v, v);
  if (RECEIVER == NDF_NONE) {
    float above = BUMPED == 0 || dot(r.geometric, v) > 0.0 ? seen : 0.0;
    float inverse_d2 = 1.0 / d2;
    float leaving = max(-dot(v, c.normal), 0.0), arriving = max(dot(v, r.normal), 0.0);
    // fvpl_plane() times d
    float bend = arriving * (4.0 - 12.0 * leaving * leaving * inverse_d2) - 4.0 * dot(c.normal, r.normal) * leaving;
    bend *= inverse_d2 * (1.0 / c.inverse_variance);
    float sum = arriving + abs(bend);
    float cosines = leaving * arriving * ((sum + bend) / max(sum, 1e-20));
    sums.diffuse += (above * INVERSE_PI * cosines * inverse_d2 * inverse_d2) * c.diffuse;
    return;
  }
  float inverse_d = inversesqrt(d2);
  float inverse_d2 = inverse_d * inverse_d;
  vec3 u = v * inverse_d;
  float inverse_sharpness = inverse_d2 / c.inverse_variance;
  add(sums, (seen * inverse_d2) * fvpl_emission_diffuse(c, u), distant_reflection(r, c, u, inverse_sharpness));
}

// The same with specular emission.
void add_glossy(Receiver r, Cluster c, float seen, inout Sums sums) {
  vec3 v = c.position - r.position;
  float inverse_d = inversesqrt(dot(v, v));
  float inverse_d2 = inverse_d * inverse_d;
  vec3 u = v * inverse_d;
  float inverse_sharpness = inverse_d2 / c.inverse_variance;
  add(sums, (seen * inverse_d2) * fast_fvpl_emission_flat(c.ndf, c, u, inverse_d2), distant_reflection(r, c, u, inverse_sharpness));
}

float above_horizon(Receiver r, Cluster c, vec3 v) {
  return BUMPED == 0 ? 1.0 : geometric_horizon(r, v, c.inverse_variance);
}

vec3 emission_of(Cluster c, vec3 u, float inverse_d2) {
  return fast_fvpl_emission(EMISSION == NDF_NONE ? NDF_NONE : c.ndf, c, u, inverse_d2);
}

// A footprint none of which is behind a diffuse receiver.
void add_middle(Receiver r, Cluster c, float seen, inout Sums sums) {
  vec3 v = c.position - r.position;
  float inverse_d = inversesqrt(dot(v, v));
  float inverse_d2 = inverse_d * inverse_d;
  vec3 u = v * inverse_d;
  float cosine = narrow_cosine(dot(u, r.normal), inverse_d * inversesqrt(c.inverse_variance));
  cosine *= fvpl_plane(c, u, r.normal, cosine, inverse_d2 * (1.0 / c.inverse_variance), 1.0);
  sums.diffuse += (seen * above_horizon(r, c, v) * INVERSE_PI * inverse_d2 * cosine) * emission_of(c, u, inverse_d2);
}

// Any.
void add_near(Receiver r, Cluster c, float seen, inout Sums sums) {
  vec3 v = c.position - r.position;
  FvplView view = fvpl_view(v, c.inverse_variance);
  add(sums, (seen * above_horizon(r, c, v)) * emission_of(c, view.u, view.inverse_d2), receive_footprint(r, c, view));
}

void main() {
  CutBlock block = blocks[gl_WorkGroupID.x];
  Receiver receivers[PIXELS];
  Sums sums[PIXELS];
  [[unroll]] for (uint j = 0; j < PIXELS; ++j) {
    uint place = block.receiver + min(gl_LocalInvocationIndex + j * gl_WorkGroupSize.x, block.receivers - 1);
    receivers[j] = make_receiver(place, surfaces[place], push.camera);
    sums[j] = Sums(vec3(0.0), vec3(0.0));
  }
  for (uint i = block.plain; i < block.glossy; ++i) {
    Item item = load_item(i);
    Cluster c = load_diffuse(item.cluster);
    [[unroll]] for (uint j = 0; j < PIXELS; ++j) add_plain(receivers[j], c, visibility(item, j), sums[j]);
  }
  if (EMISSION != NDF_NONE) {
    for (uint i = block.glossy; i < block.middle; ++i) {
      Item item = load_item(i);
      Cluster c = load_cluster(item.cluster);
      [[unroll]] for (uint j = 0; j < PIXELS; ++j) add_glossy(receivers[j], c, visibility(item, j), sums[j]);
    }
  }
  if (RECEIVER == NDF_NONE) {
    for (uint i = block.middle; i < block.near; ++i) {
      Item item = load_item(i);
      Cluster c = load_cluster(item.cluster);
      [[unroll]] for (uint j = 0; j < PIXELS; ++j) add_middle(receivers[j], c, visibility(item, j), sums[j]);
    }
  }
  for (uint i = block.near; i < block.end; ++i) {
    Item item = load_item(i);
    Cluster c = load_cluster(item.cluster);
    [[unroll]] for (uint j = 0; j < PIXELS; ++j) add_near(receivers[j], c, visibility(item, j), sums[j]);
  }
  [[unroll]] for (uint j = 0; j < PIXELS; ++j) {
    uint k = gl_LocalInvocationIndex + j * gl_WorkGroupSize.x;
    if (k < block.receivers) results[block.receiver + k] = CutSums(sums[j].diffuse, sums[j].specular);
  }
}
