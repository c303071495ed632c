// Resolves visible triangles to surface points: exact positions by intersecting the texel's ray with the triangle's plane,
// materials, normals.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "interop/model.h"
#include "interop/surface.h"
#include "rsm/texture.glsl"
#include "rsm/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Surfaces { Surface at[]; };

// Everything interpolated where the ray meets the triangle.
struct Hit {
  vec3 position, geometric_normal, normal;
  vec4 tangent;
  vec2 uv, du, dv;  // du, dv: change over one texel in x and in y
};

// Barycentric coordinates (of corners b and c) of an offset in the plane of edges ab and ac with normal n = cross(ab, ac).
vec2 plane_coordinates(vec3 offset, vec3 ab, vec3 ac, vec3 n) {
  return vec2(dot(cross(offset, ac), n), dot(cross(ab, offset), n)) / dot(n, n);
}

Hit intersect(View view, vec2 texel_centre, Vertex a, Vertex b, Vertex c) {
  vec3 ab = b.position - a.position, ac = c.position - a.position;
  vec3 n = cross(ab, ac);
  vec3 unit = normalize(n);
  Ray ray = view_ray(view, texel_centre);
  // An edge-on triangle may be drawn although the ray misses it by a fraction of a texel: keep the point inside.
  float slope = dot(unit, ray.direction);
  slope = (slope < 0.0 ? -1.0 : 1.0) * max(abs(slope), 1e-6 * length(ray.direction));
  float t = dot(unit, a.position - ray.origin) / slope;
  vec2 bc = plane_coordinates(ray.origin + t * ray.direction - a.position, ab, ac, n);
  vec3 weights = max(vec3(1.0 - bc.x - bc.y, bc), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;

  Hit hit;
  hit.position = a.position + weights.y * ab + weights.z * ac;
  hit.geometric_normal = unit;
  hit.normal = weights.x * a.normal + weights.y * b.normal + weights.z * c.normal;
  hit.tangent = weights.x * a.tangent + weights.y * b.tangent + weights.z * c.tangent;
  hit.uv = weights.x * a.uv + weights.y * b.uv + weights.z * c.uv;
  float scale = view.kind == VIEW_DIRECTIONAL ? 1.0 : max(t, 0.0);
  vec3 right = scale * 2.0 * view.extent_x / float(view.width) * view.right;
  vec3 down = -scale * 2.0 * view.extent_y / float(view.height) * view.up;
  vec2 dx = plane_coordinates(right - ray.direction * (dot(unit, right) / slope), ab, ac, n);
  vec2 dy = plane_coordinates(down - ray.direction * (dot(unit, down) / slope), ab, ac, n);
  hit.du = dx.x * (b.uv - a.uv) + dx.y * (c.uv - a.uv);
  hit.dv = dy.x * (b.uv - a.uv) + dy.y * (c.uv - a.uv);
  return hit;
}

// Relative, of a unit normal rounded to 8-bit texels: it must not pass for a spread.
const float LENGTH_ERROR = 1.0 / 255.0;

// A mean normal, and the variance of the normals that it stands for, per axis.
struct MeanNormal {
  vec3 direction;
  float variance;
};

// Vertex normal bent by the normal map, on the side of `facing`. [Toksvig 2005] The shorter the mean m of a map's unit normals, the
// wider they spread: their variance is (1 - |m|) / |m|, times the square of the map's scale.
MeanNormal shading_normal(Hit hit, Material material, vec3 facing) {
  float variance = 0.0;
  vec3 n = dot(hit.normal, hit.normal) > 1e-12 ? normalize(hit.normal) : hit.geometric_normal;
  float side = dot(n, facing) < 0.0 ? -1.0 : 1.0;
  vec3 t = hit.tangent.xyz - dot(hit.tangent.xyz, n) * n;
  if (material.normal_texture >= 0 && dot(t, t) > 1e-12) {
    t = normalize(t);
    vec3 b = (hit.tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, t);
    vec3 m = 2.0 * texture_trilinear(material.normal_texture, hit.uv, hit.du, hit.dv).xyz - 1.0;
    variance = max(1.0 / max(length(m), 1e-3) - 1.0 - LENGTH_ERROR, 0.0) * material.normal_scale * material.normal_scale;
    m.xy *= material.normal_scale;
    vec3 bent = m.x * t + m.y * b + m.z * n;
    if (dot(bent, bent) > 1e-12) n = normalize(bent);
  }
  return MeanNormal(side * n, variance);
}

void set_reflectance(inout Surface s, Hit hit, Material material) {
  vec3 base = material.base_color;
  float metallic = material.metallic;
  float alpha = material.alpha;
  if (material.base_color_texture >= 0) {
    base *= texture_trilinear(material.base_color_texture, hit.uv, hit.du, hit.dv).rgb;
  }
  if (material.metallic_roughness_texture >= 0) {
    vec2 roughness_metal = texture_trilinear(material.metallic_roughness_texture, hit.uv, hit.du, hit.dv).gb;
    metallic *= roughness_metal.y;
    alpha *= roughness_metal.x * roughness_metal.x;
  }
  s.diffuse = base * (1.0 - metallic);
  s.specular = mix(material.specular, base, metallic);
  bool glossy = any(greaterThan(s.specular, vec3(0.0)));
  s.ndf = glossy ? material.ndf : NDF_NONE;
  s.alpha = glossy ? max(alpha, ALPHA_MIN) : 1.0;
}

// What a surface of many normals reflects [Toksvig 2005]. Lambert's cosine becomes the mean of n . w: the mean normal's length 1 / (1 + v)
// remains. The slopes' variance adds to that of the microfacets, which is alpha^2 / 2 per axis (exactly for Beckmann).
void spread_normals(inout Surface s, float variance) {
  s.diffuse /= 1.0 + variance;
  if (s.ndf != NDF_NONE) s.alpha = min(sqrt(s.alpha * s.alpha + 2.0 * variance), 1.0);
}

Surface resolve(View view, uvec2 texel, uint triangle_index) {
  Triangle triangle = scene_triangle(triangle_index);
  Hit hit = intersect(view, vec2(texel) + 0.5, scene_vertex(triangle.a), scene_vertex(triangle.b),
                      scene_vertex(triangle.c));
  Material material = scene_material(triangle.instance);
  vec3 from_view = view.kind == VIEW_DIRECTIONAL ? view.forward : hit.position - view.origin;
  Surface s;
  s.position = hit.position;
  s.normal = dot(hit.geometric_normal, from_view) > 0.0 ? -hit.geometric_normal : hit.geometric_normal;
  MeanNormal shading = shading_normal(hit, material, s.normal);
  s.shading_normal = shading.direction;
  s.depth = view.kind == VIEW_DIRECTIONAL ? dot(hit.position - view.origin, view.forward) : length(from_view);
  s.id = triangle.instance;
  set_reflectance(s, hit, material);
  spread_normals(s, shading.variance);
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
