// [Karras 2012] The binary radix tree over sorted codes, all nodes at once. Equal codes are told apart by their places.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/tree.glsl"

layout(local_size_x = 64) in;

// Length of the common prefix of two codes; -1 beyond the ends.
int prefix(int i, int j) {
  if (j < 0 || j >= int(tree.count)) return -1;
  const uint differ = Words(tree.codes_at).at[i] ^ Words(tree.codes_at).at[j];
  return differ != 0u ? 31 - findMSB(differ) : 63 - findMSB(uint(i ^ j));
}

// The other end of the range of codes below inner node i, which begins or ends with code i.
int other_end(int i, int direction) {
  const int outside = prefix(i, i - direction);
  int reach = 2;
  while (prefix(i, i + reach * direction) > outside) reach *= 2;
  int length = 0;
  for (int step = reach / 2; step > 0; step /= 2)
    if (prefix(i, i + (length + step) * direction) > outside) length += step;
  return i + length * direction;
}

// The last code of the left child, from either end of the range.
int split(int i, int j) {
  const int shared_bits = prefix(i, j), direction = j > i ? 1 : -1;
  int offset = 0;
  for (int step = abs(j - i); step > 1;) {
    step = (step + 1) / 2;
    if (prefix(i, i + (offset + step) * direction) > shared_bits) offset += step;
  }
  return i + offset * direction + min(direction, 0);
}

void set_node(uint node, uint left, uint right, uint first, uint last) {
  Nodes(tree.nodes_at).at[node].left = left;
  Nodes(tree.nodes_at).at[node].right = right;
  Nodes(tree.nodes_at).at[node].first = first;
  Nodes(tree.nodes_at).at[node].last = last;
}

void main() {
  const int i = int(gl_GlobalInvocationID.x), end = int(tree.count) - 1;
  if (i > end) return;
  const uint cluster = Words(tree.order_at).at[i], leaf = leaf_node(uint(i));
  const Feature centre = Features(tree.centres_at).at[cluster];
  Nodes(tree.nodes_at).at[leaf].low = centre;
  Nodes(tree.nodes_at).at[leaf].high = centre;
  set_node(leaf, cluster, 0u, uint(i), uint(i));
  if (i == end) return;
  const int j = other_end(i, prefix(i, i + 1) > prefix(i, i - 1) ? 1 : -1);
  const uint first = uint(min(i, j)), last = uint(max(i, j)), middle = uint(split(i, j));
  set_node(uint(i), first == middle ? leaf_node(middle) : middle, last == middle + 1u ? leaf_node(middle + 1u) : middle + 1u,
           first, last);
}
