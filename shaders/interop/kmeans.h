// Clusters of texels about centres: what the steps of libs/kmeans exchange. Members named `..._at` are device
// addresses (low and high word), for GLSL's buffer_reference.
#ifndef VSGL_INTEROP_KMEANS_H
#define VSGL_INTEROP_KMEANS_H
#include "interop/interop.h"
#include "interop/moments.h"

VSGL_INTEROP_BEGIN

// One pass of a radix sort of pairs (key, value), by four bits of the keys.
struct SortPush {
  uvec2 keys_at, values_at;
  uvec2 sorted_keys_at, sorted_values_at;
  uvec2 counts_at;  // uint per digit and block: its keys; later where they begin
  uint count, shift;
};
VSGL_CHECK_SIZE(SortPush, 48)
VSGL_CONST uint SORT_DIGITS = 16u;
VSGL_CONST uint SORT_DIGIT_BITS = 4u;
VSGL_CONST uint SORT_BLOCK = 1024u;  // keys of one workgroup

// A texel, or the centre of a cluster, as a point of the space in which distances are taken.
struct Feature {
  vec3 place;  // KMEANS_2D: column and row over the layer's side, and where its layer lies; KMEANS_3D:
               // position over the scene's radius
  vec3 facing;  // mean normal times the root of the normals' weight
};
VSGL_CHECK_SIZE(Feature, 24)

// A node of the binary radix tree over n centres: n - 1 inner nodes, the root first, then n leaves.
struct CentreNode {
  Feature low, high;  // bounds of the centres below; of a leaf both are its centre
  uint left, right;   // children; left of a leaf: its cluster
  uint first, last;   // leaf below, from 0
};
VSGL_CHECK_SIZE(CentreNode, 64)

// Bounds of CENTRE_BLOCK^k leaves in a row, for k = 1, 2, ...
struct CentreBlock {
  Feature low, high;
};
VSGL_CHECK_SIZE(CentreBlock, 48)
VSGL_CONST uint CENTRE_BLOCK = 8u;

struct CentreTree {
  uvec2 centres_at;  // Feature per cluster
  uvec2 extent_at;   // vec3 lowest, highest place of the centres
  uvec2 codes_at;    // uint: Morton codes, to be sorted, or sorted
  uvec2 order_at;    // uint: clusters, to be sorted, or in the order of their codes
  uvec2 nodes_at;    // CentreNode
  uvec2 blocks_at;   // CentreBlock: those of CENTRE_BLOCK leaves, then larger ones
  uint count;
  uint step;  // of blocks.comp.glsl: the k of the blocks that it makes
};
VSGL_CHECK_SIZE(CentreTree, 56)

VSGL_CONST uint KMEANS_2D = 0u;
VSGL_CONST uint KMEANS_3D = 1u;

// The texels of all layers, one layer after another, their clusters and the space of their features.
struct Texels {
  uvec2 moments_at;   // Moments of each texel
  uvec2 clusters_at;  // uint per texel: its cluster; `clusters` where nothing reflects
  uvec2 order_at;     // uint per texel: texels, to be sorted, or in the order of their clusters
  uint clusters;
  uint size, layers;   // texels a side of a layer
  uint space;          // KMEANS_2D, KMEANS_3D
  float scale;         // KMEANS_3D: of positions, 1/m
  float layer_step;    // KMEANS_2D: between layers, more than any distance within one
  float normal_scale;  // root of the normals' weight
};
VSGL_CHECK_SIZE(Texels, 52)

// What some texels add to their cluster.
struct ClusterPart {
  Moments moments;  // powers and weight are sums
  vec3 place;       // mean by weight
  float cost;       // sum of weight times squared distance to the centre, W
  float nearest;    // least squared distance to the centre,
  uint texel;       // and the first texel at that distance
  uint texels;
  uint owner;  // 1 + cluster; 0: nothing here
};
VSGL_CHECK_SIZE(ClusterPart, 136)

// Texels or parts that one invocation merges.
VSGL_CONST uint KMEANS_RUN = 32u;

// Beyond all squared distances.
VSGL_CONST float KMEANS_FARTHEST = 3e38f;

VSGL_INTEROP_END
#endif
