// Merges runs of texels, sorted by cluster.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kmeans.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
  Texels texels;
  uvec2 keys_at;     // uint: the texels' clusters, sorted
  uvec2 centres_at;  // Feature per cluster
  uvec2 parts_at;    // ClusterPart, all 0
};
#include "kmeans/texels.glsl"
#include "kmeans/run.glsl"

uint item_owner(uint item) {
  const uint cluster = Words(keys_at).at[item];
  return cluster < texels.clusters ? cluster + 1u : 0u;
}

ClusterPart item_part(uint item) {
  const uint texel = Words(texels.order_at).at[item];
  ClusterPart part;
  part.moments = texel_moments(texel);
  const Feature feature = texel_feature(texel, part.moments.position, part.moments.normal_mean);
  const Feature centre = Features(centres_at).at[Words(keys_at).at[item]];
  part.place = feature.place;
  part.nearest = distance_squared(feature, centre, centre);
  part.cost = part.moments.weight * part.nearest;
  part.texel = texel;
  part.texels = 1u;
  return part;
}

void main() {
  const uint items = texels.layers * texels.size * texels.size;
  if (gl_GlobalInvocationID.x * KMEANS_RUN < items) merge_run(gl_GlobalInvocationID.x, items, parts_at);
}
