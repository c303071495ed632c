// Splatting of one point into the imperfect shadow map of a view; included by the shaders that differ in where points
// come from. They declare `push`, a SplatPush.
// Deviation: a point is drawn as the disk it stands for, so that surfaces seen at a slant do not swell: it covers the
// texels whose centre rays meet the disk, at the distances where they do, and always the texel that holds its centre.
// (In a room with 8192 points a light, square splats of the best size leave 1.5 times the error.)
layout(binding = 0, scalar) readonly buffer Views { SplatView views[]; };
// Float bits of inverse distances: they order like uints.
layout(binding = 1, scalar) buffer Maps { uint maps[]; };

// Whether the point, d metres from the view's origin, belongs to the surface that emits.
bool is_own_surface(SplatView view, vec3 position, float d) {
  return d < view.own_radius && abs(dot(position - view.surface, view.axis)) < 0.5 * push.disk_radius;
}

// v, n: the point's position and normal in the view's frame. d = |v|.
void splat(uint first_texel, vec3 v, vec3 n, float d, float radius, float near_distance) {
  int tile = int(push.tile);
  vec2 e = hemi_octahedral_encode(v);
  vec2 place = (0.5 * e + 0.5) * float(tile);
  float texel_width = d * sqrt(hemi_octahedral_solid_angle(e, float(tile)));  // m, at the point
  // The search square fits a disk seen face on, at the mean width of a texel here.
  float reach = clamp(radius / texel_width, 0.0, 0.5 * float(SPLAT_MAX_WIDTH));
  ivec2 own = clamp(ivec2(place), 0, tile - 1);
  ivec2 first = clamp(ivec2(ceil(place - reach - 0.5)), ivec2(0), own);
  ivec2 last = clamp(ivec2(floor(place + reach - 0.5)), own, ivec2(tile - 1));
  float height = dot(v, n);
  // Where the centre's texel lies off the disk, its plane is followed, but not beyond a tangent of 4.
  float slack = max(radius, 4.0 * texel_width);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      vec3 w = hemi_octahedral_decode((vec2(x, y) + 0.5) * (2.0 / float(tile)) - 1.0);
      float inverse = abs(height) > 1e-6 * d ? dot(w, n) / height : 1.0 / d;
      vec3 off_centre = w - inverse * v;  // times the distance
      bool on_disk = dot(off_centre, off_centre) <= radius * radius * inverse * inverse;
      if (!on_disk && ivec2(x, y) != own) continue;
      inverse = clamp(inverse, 1.0 / (d + slack), 1.0 / max(d - slack, near_distance));
      atomicMax(maps[first_texel + uint(y * tile + x)], floatBitsToUint(inverse));
    }
}

// Splats the point into the map at `first_texel` unless the view does not see it. `frame`: about the view's axis.
void splat_point(uint first_texel, SplatView view, mat3 frame, SplatPoint point) {
  vec3 v = point.position - view.origin;
  float d = length(v);
  bool occludes = point.radius > 0.0 && dot(v, view.axis) > 0.0 && d >= view.near_distance &&
                  !is_own_surface(view, point.position, d);
  if (!occludes) return;
  splat(first_texel, v * frame, point.normal * frame, d, push.splat_scale * point.radius, view.near_distance);
}
