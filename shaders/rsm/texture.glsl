// Trilinear filtering of repeating textures, in full precision: the same on every device, and for any number of textures.
#ifndef VSGL_RSM_TEXTURE_GLSL
#define VSGL_RSM_TEXTURE_GLSL

#include "rsm/scene.glsl"

// IEC 61966-2-1.
vec3 srgb_decode(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Remainder in 0..size-1, of negative numbers too.
int wrap(int x, int size) {
  int r = x % size;
  return r < 0 ? r + size : r;
}

// One texel, linear. `first`: index of the level's first texel.
vec4 texel(Texture t, uint first, ivec2 size, ivec2 p) {
  uint index = first + uint(wrap(p.y, size.y) * size.x + wrap(p.x, size.x));
  vec4 c = unpackUnorm4x8(Words(t.texels_at).at[index]);
  return t.srgb != 0u ? vec4(srgb_decode(c.rgb), c.a) : c;
}

vec4 texture_bilinear(Texture t, uint level, vec2 uv) {
  uint first = 0u;
  ivec2 size = ivec2(t.width, t.height);
  for (uint l = 0u; l < level; ++l) {
    first += uint(size.x * size.y);
    size = max(size / 2, ivec2(1));
  }
  vec2 position = (uv - floor(uv)) * vec2(size) - 0.5;
  ivec2 p = ivec2(floor(position));
  vec2 f = position - vec2(p);
  vec4 top = mix(texel(t, first, size, p), texel(t, first, size, p + ivec2(1, 0)), f.x);
  vec4 bottom = mix(texel(t, first, size, p + ivec2(0, 1)), texel(t, first, size, p + ivec2(1, 1)), f.x);
  return mix(top, bottom, f.y);
}

// `du`, `dv`: change of uv over one pixel in x and in y.
vec4 texture_trilinear(int index, vec2 uv, vec2 du, vec2 dv) {
  Texture t = scene_texture(index);
  vec2 size = vec2(t.width, t.height);
  float texels = max(length(du * size), length(dv * size));
  float top = float(t.levels - 1u);
  float level = texels > 1.0 ? min(log2(texels), top) : 0.0;
  uint fine = uint(level);
  vec4 c = texture_bilinear(t, fine, uv);
  float f = level - float(fine);
  return f > 0.0 ? mix(c, texture_bilinear(t, fine + 1u, uv), f) : c;
}

#endif
