// Merging of texels and parts of clusters, in the order in which they come.
#ifndef VSGL_KMEANS_PART_GLSL
#define VSGL_KMEANS_PART_GLSL
#include "interop/kmeans.h"
#include "lib/moments.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Parts { ClusterPart at[]; };

struct PartSum {
  MomentsSum moments;
  MeanSpread place;
  float cost, nearest;
  uint texel, texels, owner;
};

PartSum part_start(uint owner) {
  return PartSum(moments_start(), mean_spread_start(), 0.0, KMEANS_FARTHEST, 0u, 0u, owner);
}

void part_add(inout PartSum a, ClusterPart b) {
  moments_add(a.moments, b.moments, 1.0);
  mean_spread_add(a.place, b.moments.weight, b.place, 0.0);
  a.cost += b.cost;
  if (b.nearest < a.nearest) a.texel = b.texel;
  a.nearest = min(a.nearest, b.nearest);
  a.texels += b.texels;
}

ClusterPart part_finish(PartSum a) {
  return ClusterPart(moments_finish(a.moments), mean_spread_mean(a.place), a.cost, a.nearest, a.texel, a.texels, a.owner);
}

#endif
