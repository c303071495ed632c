// Merges the last parts of each cluster: its light, its cost and its new centre. Clusters without texels keep their centre and
// give a light of zeros.
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
  uvec2 parts_at;    // ClusterPart of the last merge
  uvec2 centres_at;  // Feature per cluster
  uvec2 lights_at;   // Light per cluster, all 0
  uvec2 costs_at;    // float per cluster, all 0, W
  uint merges;       // how often runs were merged, sum.comp.glsl included
  float variance_floor;  // m^2
  uint lobe_filter;      // LOBE_*: how the lobes of the moments are encoded
};
#include "kmeans/part.glsl"
#include "kmeans/texels.glsl"
#include "pyramid/light.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Lights { Light at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Floats { float at[]; };

// Where the texels of this cluster and of later ones begin.
uint first_texel(uint cluster) {
  uint begin = 0u, end = texels.layers * texels.size * texels.size;
  while (begin < end) {
    const uint middle = (begin + end) / 2u;
    if (Words(keys_at).at[middle] < cluster) {
      begin = middle + 1u;
    } else {
      end = middle;
    }
  }
  return begin;
}

ClusterPart merge_parts(uint cluster, uint first, uint last) {
  for (uint merge = 0u; merge < merges; ++merge) {
    first = first / KMEANS_RUN + cluster;
    last = last / KMEANS_RUN + cluster;
  }
  PartSum sum = part_start(cluster + 1u);
  for (uint part = first; part <= last; ++part) part_add(sum, Parts(parts_at).at[part]);
  return part_finish(sum);
}

Light make_light(ClusterPart part) {
  Light light;
  if (lobe_filter == LOBE_NONE) take_lobes(part.moments, texel_moments(part.texel));
  set_moments(light, part.moments, 1.0, variance_floor, lobe_filter);
  // The mip level whose texels are as large.
  light.level = 0.5 * log2(float(part.texels));
  light.texel = part.texel % (texels.size * texels.size);
  light.layer = part.texel / (texels.size * texels.size);
  light.alpha = 0.0;
  light.ndf = 0u;
  light.shading_normal = light.incident = light.origin = vec3(0.0);
  light.lobe_variance = light.shading_deficit = 0.0;
  light.children = 0u;
  return light;
}

void main() {
  const uint cluster = gl_GlobalInvocationID.x;
  if (cluster >= texels.clusters) return;
  const uint first = first_texel(cluster), next = first_texel(cluster + 1u);
  if (first == next) return;
  const ClusterPart part = merge_parts(cluster, first, next - 1u);
  Lights(lights_at).at[cluster] = make_light(part);
  Floats(costs_at).at[cluster] = part.cost;
  precise vec3 facing = part.moments.normal_mean * texels.normal_scale;
  Features(centres_at).at[cluster] = Feature(part.place, facing);
}
