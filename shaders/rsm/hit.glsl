// Where the ray through a texel meets the triangle that it sees; normals and reflectance there.
#ifndef VSGL_RSM_HIT_GLSL
#define VSGL_RSM_HIT_GLSL

#include "rsm/texture.glsl"
#include "rsm/view.glsl"

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

Hit intersect(View view, vec2 texel_centre, Triangle triangle) {
  Vertex a = scene_vertex(triangle.a), b = scene_vertex(triangle.b), c = scene_vertex(triangle.c);
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

// The vertex normal on the side of `facing`, and what a normal map bends it by: tangent and bitangent are 0 where there is no map.
struct NormalFrame {
  vec3 tangent, bitangent, normal;
};

NormalFrame normal_frame(Hit hit, Material material, vec3 facing) {
  vec3 n = dot(hit.normal, hit.normal) > 1e-12 ? normalize(hit.normal) : hit.geometric_normal;
  float side = dot(n, facing) < 0.0 ? -1.0 : 1.0;
  vec3 t = hit.tangent.xyz - dot(hit.tangent.xyz, n) * n;
  if (material.normal_texture < 0 || dot(t, t) <= 1e-12) return NormalFrame(vec3(0.0), vec3(0.0), side * n);
  t = side * normalize(t);
  float handedness = hit.tangent.w < 0.0 ? -1.0 : 1.0;
  return NormalFrame(t, side * handedness * cross(n, t), side * n);
}

bool is_mapped(NormalFrame frame) {
  return frame.tangent != vec3(0.0);
}

// The normal bent by a texel of the map, unit; the vertex normal where the texel says nothing.
vec3 bent_normal(NormalFrame frame, float scale, vec3 texel) {
  vec3 m = (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
  vec3 bent = m.x * frame.tangent + m.y * frame.bitangent + m.z * frame.normal;
  return dot(bent, bent) > 1e-12 ? normalize(bent) : frame.normal;
}

// Texture coordinates at an offset from the texel's centre, in texels.
vec2 uv_at(Hit hit, vec2 offset) {
  return hit.uv + offset.x * hit.du + offset.y * hit.dv;
}

// The shading normal at a point, at the full resolution of the map.
vec3 normal_at(NormalFrame frame, Material material, vec2 uv) {
  if (!is_mapped(frame)) return frame.normal;
  return bent_normal(frame, material.normal_scale, texture_bilinear(scene_texture(material.normal_texture), 0u, uv).xyz);
}

struct Reflectance {
  vec3 diffuse, specular;
  float alpha;
};

// Of a material, filtered over du and dv (0: full resolution).
Reflectance reflectance_at(Material material, vec2 uv, vec2 du, vec2 dv) {
  vec3 base = material.base_color;
  float metallic = material.metallic;
  float alpha = material.alpha;
  if (material.base_color_texture >= 0) base *= texture_trilinear(material.base_color_texture, uv, du, dv).rgb;
  if (material.metallic_roughness_texture >= 0) {
    vec2 roughness_metal = texture_trilinear(material.metallic_roughness_texture, uv, du, dv).gb;
    metallic *= roughness_metal.y;
    alpha *= roughness_metal.x * roughness_metal.x;
  }
  return Reflectance(base * (1.0 - metallic), mix(material.specular, base, metallic), alpha);
}

#endif
