// Merges runs of parts, which are sorted by cluster with gaps between.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/run.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
  uvec2 items_at;  // ClusterPart
  uvec2 parts_at;  // ClusterPart, all 0
  uint items;
};

uint item_owner(uint item) { return Parts(items_at).at[item].owner; }
ClusterPart item_part(uint item) { return Parts(items_at).at[item]; }

void main() {
  if (gl_GlobalInvocationID.x * KMEANS_RUN < items) merge_run(gl_GlobalInvocationID.x, items, parts_at);
}
