// Texels as points, and their distances. The includer's push constants hold a Texels `texels`.
#ifndef VSGL_KMEANS_TEXELS_GLSL
#define VSGL_KMEANS_TEXELS_GLSL
#include "interop/kmeans.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TexelMoments { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Features { Feature at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

// 0: normals have no weight, all `facing` are 0.
layout(constant_id = 0) const uint FACING = 1u;

Moments texel_moments(uint texel) { return TexelMoments(texels.moments_at).at[texel]; }

// `precise` here and below: no step is contracted, so that every device finds the same centre to be the nearest.
Feature texel_feature(uint texel, vec3 position, vec3 normal) {
  precise vec3 place, facing;
  if (texels.space == KMEANS_3D) {
    place = position * texels.scale;
  } else {
    const uint side = texels.size, row = texel / side;
    place = vec3(vec2(texel % side, row % side) + 0.5, float(row / side)) *
            vec3(vec2(1.0 / float(side)), texels.layer_step);
  }
  facing = normal * texels.normal_scale;
  return Feature(place, facing);
}

// Squared distance to a box; to a point where low = high. Every step is monotone: no point in a box is nearer than the box, in floats, too.
float distance_squared(Feature f, Feature low, Feature high) {
  const vec3 d = max(max(low.place - f.place, f.place - high.place), vec3(0.0));
  precise float sum = d.x * d.x + d.y * d.y + d.z * d.z;
  if (FACING != 0u) {
    const vec3 e = max(max(low.facing - f.facing, f.facing - high.facing), vec3(0.0));
    sum += e.x * e.x + e.y * e.y + e.z * e.z;
  }
  return sum;
}

#endif
