// Gives every texel that reflects to its nearest centre; of equally near ones to the first.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kmeans.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push {
  Texels texels;
  uvec2 nodes_at;  // CentreNode: the tree over the centres
  uvec2 keys_at;   // uint per texel: its cluster, to sort by
  uvec2 moved_at;  // uint: texels whose cluster has changed
};
#include "kmeans/texels.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Nodes { CentreNode at[]; };

// Levels of the tree: 30 bits of codes and 20 of places, and some to spare.
const int STACK = 64;

float node_distance(Feature f, uint node) {
  return distance_squared(f, Nodes(nodes_at).at[node].low, Nodes(nodes_at).at[node].high);
}

// Depth first, the nearer child first. Nodes as far as the best centre count: it may not be the first of its distance.
uint nearest_centre(Feature f) {
  uint stack_nodes[STACK];
  float stack_distances[STACK];
  stack_nodes[0] = 0u;
  stack_distances[0] = 0.0;
  int depth = 1;
  float best = KMEANS_FARTHEST;
  uint cluster = texels.clusters;
  while (depth > 0) {
    --depth;
    const uint node = stack_nodes[depth];
    const float at = stack_distances[depth];
    if (at > best) continue;
    const uint left = Nodes(nodes_at).at[node].left;
    if (node >= texels.clusters - 1u) {
      const float d = node_distance(f, node);
      if (d < best || (d == best && left < cluster)) cluster = left;
      best = min(best, d);
      continue;
    }
    const uint right = Nodes(nodes_at).at[node].right;
    const float to_left = node_distance(f, left), to_right = node_distance(f, right);
    const bool left_first = to_left <= to_right;
    stack_nodes[depth] = left_first ? right : left;
    stack_distances[depth] = left_first ? to_right : to_left;
    stack_nodes[depth + 1] = left_first ? left : right;
    stack_distances[depth + 1] = min(to_left, to_right);
    depth += 2;
  }
  return cluster;
}

void main() {
  const uvec3 at = gl_GlobalInvocationID;
  if (at.x >= texels.size || at.y >= texels.size) return;
  const uint texel = (at.z * texels.size + at.y) * texels.size + at.x;
  const Moments m = texel_moments(texel);
  uint cluster = texels.clusters;
  if (m.weight > 0.0) cluster = nearest_centre(texel_feature(texel, m.position, m.normal_mean));
  if (cluster != Words(texels.clusters_at).at[texel]) atomicAdd(Words(moved_at).at[0], 1u);
  Words(texels.clusters_at).at[texel] = cluster;
  Words(keys_at).at[texel] = cluster;
  Words(texels.order_at).at[texel] = texel;
}
