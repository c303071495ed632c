// [Dachsbacher 2005] From the lit surface points of a light's view to reflected light: flux, power, position and lobes of each
// texel, the finest level of the moment pyramid.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "interop/model.h"
#include "interop/surface.h"
#include "lib/hash.glsl"
#include "lib/lobe.glsl"
#include "lib/microfacet.glsl"
#include "lib/moments.glsl"
#include "rsm/hit.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// 1: the normals of shading bend only what a ray tracer lets them bend (below); 0: as the papers have it, the shading normal
// stands for the surface.
layout(constant_id = 0) const uint CONSISTENT = 1u;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Surfaces { Surface at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer MomentsOut { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint count; };

Surface surface_at(ivec2 texel) {
  return Surfaces(BAKE.surface_at).at[uint(texel.y) * BAKE.stride + uint(texel.x)];
}

bool is_lit(View view, ivec2 texel) {
  return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(view.width, view.height))) &&
         surface_at(texel).id != NO_INSTANCE;
}

// Squared distance to the neighbour along an axis that continues the surface: the nearer of the two, unless it is more than twice
// as far as the tangent plane extends over one texel (a depth discontinuity): then 0.
float step_squared(View view, ivec2 texel, ivec2 axis, Surface s) {
  Ray ray = view_ray(view, vec2(texel) + 0.5), next = view_ray(view, vec2(texel + axis) + 0.5);
  float scale = view.kind == VIEW_DIRECTIONAL ? 1.0 : dot(s.position - view.origin, view.forward);
  vec3 across = (next.origin - ray.origin) + scale * (next.direction - ray.direction);
  vec3 in_plane = across - ray.direction * (dot(s.normal, across) / min(dot(s.normal, ray.direction), -1e-6));
  float nearest = 4.0 * dot(in_plane, in_plane);
  bool found = false;
  for (int side = -1; side <= 1; side += 2) {
    ivec2 other = texel + side * axis;
    if (!is_lit(view, other)) continue;
    vec3 d = surface_at(other).position - s.position;
    found = found || dot(d, d) <= nearest;
    nearest = min(nearest, dot(d, d));
  }
  return found ? nearest : 0.0;
}

// Ratio of reflected to incident light of a bent normal. A ray tracer weights the light that arrives by the cosine to the shading
// normal n_s, while the flux through the texel holds the cosine to the geometric normal n_g; light leaves by n_g again.
float cosine_ratio(vec3 shading_normal, vec3 geometric_normal, vec3 incident) {
  return max(dot(shading_normal, incident), 0.0) / max(dot(geometric_normal, incident), COS_MIN);
}

float kappa(vec3 shading_normal, vec3 geometric_normal, vec3 incident) {
  return min(cosine_ratio(shading_normal, geometric_normal, incident), KAPPA_MAX);
}

// Mean of kappa times the diffuse reflectance over the texel: one point in each of samples_x samples_y strata, textures at full resolution. Of a rough
// normal map some normals face away from the light, so that a mean normal would not do, and its colours may go with its normals.
vec3 reflected_diffuse(View view, ivec2 texel, Surface s, vec3 incident) {
  Triangle triangle = scene_triangle(Words(BAKE.visibility_at).at[uint(texel.y) * view.width + uint(texel.x)] - 1u);
  Material material = scene_material(triangle.instance);
  if (material.normal_texture < 0) return kappa(s.shading_normal, s.normal, incident) * s.diffuse;
  Hit hit = intersect(view, vec2(texel) + 0.5, triangle);
  NormalFrame frame = normal_frame(hit, material, s.normal);
  vec3 sum = vec3(0.0);
  for (uint j = 0u; j < view.samples_y; ++j) {
    for (uint i = 0u; i < view.samples_x; ++i) {
      vec2 jitter = point_of_bits(pcg3d(uvec3(texel, 1u + j * view.samples_x + i)).xy);
      vec2 uv = uv_at(hit, (vec2(i, j) + jitter) / vec2(view.samples_x, view.samples_y) - 0.5);
      sum += kappa(normal_at(frame, material, uv), s.normal, incident) *
             reflectance_at(material, uv, vec2(0.0), vec2(0.0)).diffuse;
    }
  }
  return sum / float(view.samples_x * view.samples_y);
}

Moments empty() {
  return moments_finish(moments_start());
}

Moments reflect_light(View view, ivec2 texel, Surface s) {
  vec3 incident = view.kind == VIEW_DIRECTIONAL ? -view.forward : normalize(view.origin - s.position);
  Moments m = empty();
  m.flux = view_flux(view, uvec2(texel));
  m.power_diffuse = m.flux * s.diffuse;
  m.power_specular = m.flux * s.specular;
  if (CONSISTENT != 0u) {
    m.power_diffuse = m.flux * reflected_diffuse(view, texel, s, incident);
    m.power_specular *= kappa(s.shading_normal, s.normal, incident);
    if (cosine_ratio(s.shading_normal, s.normal, incident) > KAPPA_MAX) atomicAdd(Counter(BAKE.clamped_at).count, 1u);
  }
  m.weight = moments_luminance(m.power_diffuse + m.power_specular);
  m.position = s.position;
  m.spread = (step_squared(view, texel, ivec2(1, 0), s) + step_squared(view, texel, ivec2(0, 1), s)) / 12.0;
  LobeMoments diffuse = lobe_encode(CONSISTENT != 0u ? s.normal : s.shading_normal, LAMBDA_DIFFUSE);
  m.diffuse_mean = diffuse.mean;
  m.diffuse_deficit = diffuse.deficit;
  if (s.ndf != NDF_NONE) {
    // [Wang 2009] The lobe of half vectors, warped to directions about the mirror direction.
    float cosine = max(dot(s.shading_normal, incident), COS_MIN);
    LobeMoments specular =
        lobe_encode(reflect(-incident, s.shading_normal), ndf_sharpness(s.ndf, s.alpha) / (4.0 * cosine));
    m.specular_mean = specular.mean;
    m.specular_deficit = specular.deficit;
  }
  m.normal_mean = s.normal;
  return m;
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.x >= BAKE.stride || texel.y >= BAKE.rows) return;
  View view = BAKE.view;
  Moments m = empty();
  if (is_lit(view, texel)) m = reflect_light(view, texel, surface_at(texel));
  MomentsOut(BAKE.moments_at).at[uint(texel.y) * BAKE.stride + uint(texel.x)] = m;
}
