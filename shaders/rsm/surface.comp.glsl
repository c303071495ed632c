// Resolves visible triangles to surface points: exact positions by intersecting the texel's ray with the triangle's plane,
// materials, normals.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "interop/model.h"
#include "interop/surface.h"
#include "lib/hash.glsl"
#include "rsm/hit.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Surfaces { Surface at[]; };

// Relative, of a unit normal rounded to 8-bit texels: it must not pass for a spread.
const float LENGTH_ERROR = 1.0 / 255.0;

// The mean of the normals that a map has within the texel, and what the surface reflects with all of them. [Toksvig 2005] The shorter the mean m of
// a map's unit normals, the wider they spread: their variance per axis is (1 - |m|) / |m|, times the square of the map's scale. Lambert's cosine
// becomes the mean of n . w: the mean normal's length 1 / (1 + v) remains. The slopes' variance adds to that of the microfacets, which is
// alpha^2 / 2 per axis (exactly for Beckmann).
void filter_normals(inout Surface s, Hit hit, Material material) {
  NormalFrame frame = normal_frame(hit, material, s.normal);
  s.shading_normal = frame.normal;
  if (!is_mapped(frame)) return;
  vec3 texel = texture_trilinear(material.normal_texture, hit.uv, hit.du, hit.dv).xyz;
  float variance = max(1.0 / max(length(2.0 * texel - 1.0), 1e-3) - 1.0 - LENGTH_ERROR, 0.0);
  variance *= material.normal_scale * material.normal_scale;
  s.shading_normal = bent_normal(frame, material.normal_scale, texel);
  s.diffuse /= 1.0 + variance;
  if (s.ndf != NDF_NONE) s.alpha = min(sqrt(s.alpha * s.alpha + 2.0 * variance), 1.0);
}

// One of the many normals, at random: an RSM's texels are lights that are summed, and what no mean direction and spread can tell of a
// rough map (lobes that leave below the horizon, normals that face away) comes out right in the sum.
void draw_normal(inout Surface s, uvec2 texel, Hit hit, Material material) {
  vec2 offset = point_of_bits(pcg3d(uvec3(texel, 0u)).xy) - 0.5;
  s.shading_normal = normal_at(normal_frame(hit, material, s.normal), material, uv_at(hit, offset));
}

Surface resolve(View view, uvec2 texel, uint triangle_index) {
  Triangle triangle = scene_triangle(triangle_index);
  Hit hit = intersect(view, vec2(texel) + 0.5, triangle);
  Material material = scene_material(triangle.instance);
  vec3 from_view = view.kind == VIEW_DIRECTIONAL ? view.forward : hit.position - view.origin;
  Surface s;
  s.position = hit.position;
  s.normal = dot(hit.geometric_normal, from_view) > 0.0 ? -hit.geometric_normal : hit.geometric_normal;
  s.depth = view.kind == VIEW_DIRECTIONAL ? dot(hit.position - view.origin, view.forward) : length(from_view);
  s.id = triangle.instance;
  Reflectance r = reflectance_at(material, hit.uv, hit.du, hit.dv);
  bool glossy = any(greaterThan(r.specular, vec3(0.0)));
  s.diffuse = r.diffuse;
  s.specular = r.specular;
  s.ndf = glossy ? material.ndf : NDF_NONE;
  s.alpha = glossy ? max(r.alpha, ALPHA_MIN) : 1.0;
  if (view.kind == VIEW_CAMERA) {
    filter_normals(s, hit, material);
  } else {
    draw_normal(s, texel, hit, material);
  }
  return s;
}

// Nothing there: everything 0, no instance, no NDF.
Surface nothing() {
  return Surface(vec3(0.0), 1.0, vec3(0.0), NDF_NONE, vec3(0.0), NO_INSTANCE, vec3(0.0), 0.0, vec3(0.0));
}

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  if (texel.x >= BAKE.stride || texel.y >= BAKE.rows) return;
  View view = BAKE.view;
  uint seen = 0u;
  if (texel.x < view.width && texel.y < view.height) {
    seen = Words(BAKE.visibility_at).at[texel.y * view.width + texel.x];
    // Outside a spot's cone nothing is lit.
    if (view.kind == VIEW_SPOT && view_flux(view, texel) == vec3(0.0)) seen = 0u;
  }
  Surface s = nothing();
  if (seen != 0u) s = resolve(view, texel, seen - 1u);
  Surfaces(BAKE.surface_at).at[texel.y * BAKE.stride + texel.x] = s;
}
