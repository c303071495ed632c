// Merges a run of items, which are sorted by cluster, into one part for each cluster that it meets. The includer defines
//   uint item_owner(uint item)        1 + cluster, 0: none
//   ClusterPart item_part(uint item)
#ifndef VSGL_KMEANS_RUN_GLSL
#define VSGL_KMEANS_RUN_GLSL
#include "kmeans/part.glsl"

uint item_owner(uint item);
ClusterPart item_part(uint item);

// Part of run k and cluster c goes to k + c: a place of its own, and in the order of runs and clusters, since both only grow.
void finish_part(PartSum sum, uint run, uvec2 parts_at) {
  if (sum.owner > 0u) Parts(parts_at).at[run + sum.owner - 1u] = part_finish(sum);
}

void merge_run(uint run, uint items, uvec2 parts_at) {
  const uint begin = run * KMEANS_RUN, end = min(begin + KMEANS_RUN, items);
  PartSum sum = part_start(0u);
  for (uint item = begin; item < end; ++item) {
    const uint owner = item_owner(item);
    if (owner == 0u) continue;
    if (owner != sum.owner) {
      finish_part(sum, run, parts_at);
      sum = part_start(owner);
    }
    part_add(sum, item_part(item));
  }
  finish_part(sum, run, parts_at);
}

#endif
