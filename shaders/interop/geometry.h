// A scene on the device and a view of it, for baking G-buffers and reflective shadow maps. Members named
// `..._at` are device addresses (low and high word), for GLSL's buffer_reference.
#ifndef VSGL_INTEROP_GEOMETRY_H
#define VSGL_INTEROP_GEOMETRY_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

struct Vertex {
  vec3 position;  // m, relative to the anchor
  vec3 normal;    // unit
  vec4 tangent;   // unit, w = handedness: bitangent = w cross(normal, tangent)
  vec2 uv;
};
VSGL_CHECK_SIZE(Vertex, 48)

struct Triangle {
  uint a, b, c;  // vertices
  uint instance;
};
VSGL_CHECK_SIZE(Triangle, 16)

// scene::Material; textures are indices, negative: none.
struct Material {
  vec3 base_color;
  float metallic;
  vec3 specular;
  float alpha;
  uint ndf;
  float alpha_cutoff;
  float normal_scale;
  int base_color_texture;
  int metallic_roughness_texture;
  int normal_texture;
};
VSGL_CHECK_SIZE(Material, 56)

// 8-bit RGBA texels of all mip levels, finest first; level l is max(1, width >> l) x max(1, height >> l).
struct Texture {
  uvec2 texels_at;
  uint width, height, levels;
  uint srgb;  // 1: colours are sRGB-encoded
};
VSGL_CHECK_SIZE(Texture, 24)

struct Geometry {
  uvec2 vertices_at, triangles_at;
  uvec2 instance_materials_at;  // uint per instance
  uvec2 materials_at, textures_at;
};
VSGL_CHECK_SIZE(Geometry, 40)

VSGL_CONST uint VIEW_CAMERA = 0u;
VSGL_CONST uint VIEW_SPOT = 1u;
VSGL_CONST uint VIEW_DIRECTIONAL = 2u;
VSGL_CONST uint VIEW_POINT = 3u;

// A camera or a light as a view of width x height texels, row 0 at the top. Directional lights look along
// parallel rays.
struct View {
  vec3 origin;  // eye; directional: centre of the near plane
  uint kind;    // VIEW_*
  vec3 right;
  float extent_x;  // tangent of the half angle; directional: half width, m
  vec3 up;
  float extent_y;
  vec3 forward;
  float near_far;  // distance of the near plane, m; directional: of the far plane
  vec3 intensity;  // W/sr; directional: W/m^2
  float cos_inner, cos_outer;
  uint width, height;
  uint samples_x, samples_y;  // points across a texel and down it at which the intensity is taken
};
VSGL_CHECK_SIZE(View, 100)

// What one bake reads and writes. Outputs have `stride` texels a row and `stride` rows at least; those
// outside the view are empty.
struct Bake {
  Geometry geometry;
  View view;
  uvec2 visibility_at;  // uint per texel of the view: 1 + triangle, 0: nothing
  uvec2 surface_at;     // Surface per texel
  uvec2 moments_at;     // Moments per texel
  uvec2 clamped_at;     // uint: texels whose kappa was clamped
  uint stride, rows;
};
VSGL_CHECK_SIZE(Bake, 180)

// Push constants of drawing and baking.
struct BakePush {
  uvec2 bake_at;
};

// Largest correction of a texel's power for the normal map, see shaders/rsm/moments.comp.glsl.
VSGL_CONST float KAPPA_MAX = 8.0f;

VSGL_INTEROP_END
#endif
