// The loop of all kernels that sum importance. Eight texels an invocation hide the load of each source.

void main() {
  const uint first = gl_WorkGroupID.x * (IMPORTANCE_GROUP * IMPORTANCE_TEXELS) + gl_LocalInvocationID.x;
  TEXEL lit[IMPORTANCE_TEXELS];
  float sum[IMPORTANCE_TEXELS];
  [[unroll]] for (uint j = 0; j < IMPORTANCE_TEXELS; ++j) {
    lit[j] = make_texel(texels[min(first + j * IMPORTANCE_GROUP, push.texels - 1u)]);
    sum[j] = 0.0;
  }
  for (uint i = 0; i < push.sources; ++i) {
    const SOURCE source = sources[i];
    [[unroll]] for (uint j = 0; j < IMPORTANCE_TEXELS; ++j) sum[j] += importance(lit[j], source);
  }
  [[unroll]] for (uint j = 0; j < IMPORTANCE_TEXELS; ++j) {
    const uint k = first + j * IMPORTANCE_GROUP;
    if (k < push.texels) sums[k] += sum[j];
  }
}
