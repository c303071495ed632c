// The pyramid of distances over which the holes between splats are closed; included by pull, push and fill.
// Level 0 is the map itself (inverse distances); the levels above hold distances in metres. 0: nothing seen.
// Every tile has a pyramid of its own: nothing ever crosses from one light's map to another's.
layout(binding = 0, scalar) buffer Maps { uint maps[]; };
// Level 1 of all views, level 2 of all views, ...
layout(binding = 1, scalar) buffer Levels { float levels[]; };
layout(push_constant, scalar) uniform Push { SplatPush push; };

uint level_size(uint level) {
  return push.tile >> level;
}

uint level_address(uint level, uint view, uvec2 texel) {
  uint offset = 0u;
  for (uint l = 1u; l < level; ++l) offset += push.view_count * level_size(l) * level_size(l);
  uint size = level_size(level);
  return offset + (view * size + texel.y) * size + texel.x;
}

uint map_address(uint view, uvec2 texel) {
  return (view * push.tile + texel.y) * push.tile + texel.x;
}

float map_distance(uint view, uvec2 texel) {
  float inverse = uintBitsToFloat(maps[map_address(view, texel)]);
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

float distance_at(uint level, uint view, uvec2 texel) {
  return level == 0u ? map_distance(view, texel) : levels[level_address(level, view, texel)];
}

// Distances up to this are on the same surface as the nearest one: the relative span doubles with each level.
float near_limit(float nearest, uint level) {
  return nearest * (1.0 + PULL_PUSH_NEAR * float(1u << level));
}

// Mean of the nearer or the farther of four distances, whichever group weighs more (the nearer on a tie). Weight 0:
// absent.
float majority_mean(vec4 d, vec4 weight, uint level) {
  float nearest = 3.4e38;
  for (int i = 0; i < 4; ++i)
    if (weight[i] > 0.0) nearest = min(nearest, d[i]);
  vec4 is_near = vec4(lessThanEqual(d, vec4(near_limit(nearest, level))));
  vec4 near = weight * is_near, far = weight - near;
  float near_weight = dot(near, vec4(1.0)), far_weight = dot(far, vec4(1.0));
  if (far_weight > near_weight) return dot(far, d) / far_weight;
  return near_weight > 0.0 ? dot(near, d) / near_weight : 0.0;
}

// What the parents of an empty texel say about it: 0 when they see nothing, or are so coarse that the texel is open
// space and no gap between points: a parent texel may be twice as wide as a point's disk at that distance, or as
// two texels.
float pushed_distance(uint level, uint view, uvec2 texel) {
  int parent_size = int(level_size(level + 1u));
  ivec2 parent = ivec2(texel >> 1u);
  ivec2 towards = 2 * ivec2(texel & 1u) - 1;
  vec4 d = vec4(0.0), weight = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = parent + ivec2(i & 1, i >> 1) * towards;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(parent_size)))) continue;
    d[i] = distance_at(level + 1u, view, uvec2(at));
    weight[i] = d[i] > 0.0 ? vec4(9.0, 3.0, 3.0, 1.0)[i] : 0.0;
  }
  float pushed = majority_mean(d, weight, level + 1u);
  if (pushed == 0.0) return 0.0;
  vec2 e = (vec2(texel) + 0.5) * (2.0 / float(level_size(level))) - 1.0;
  float texel_angle = sqrt(hemi_octahedral_solid_angle(e, float(push.tile)));
  float disk_texels = 2.0 * push.disk_radius / (pushed * texel_angle);
  return float(2u << level) <= 2.0 * max(2.0, disk_texels) ? pushed : 0.0;
}
