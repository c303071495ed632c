// The finest level of the image's moment pyramid: the G-buffer as a reflective shadow map whose light is the camera.
// Deviation: a cell holds cell x cell pixels, merged like a mip level, so that the pyramid of a large image stays small. Kernels never
// get smaller than a cell.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "interop/importance.h"
#include "interop/surface.h"
#include "lib/lobe.glsl"
#include "lib/microfacet.glsl"
#include "lib/moments.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { Surface at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Cells { Moments at[]; };
layout(push_constant, scalar) uniform Push { ImageMomentsPush push; };

bool is_seen(ivec2 p) {
  return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(push.width, push.height))) &&
         Pixels(push.pixels_at).at[p.y * push.width + p.x].id != NO_INSTANCE;
}

// Squared distance to the nearer neighbour of the same instance along an axis; 0 without one.
float step_squared(ivec2 p, ivec2 axis, Surface s) {
  float nearest = 0.0;
  for (int side = -1; side <= 1; side += 2) {
    const ivec2 q = p + side * axis;
    if (!is_seen(q)) continue;
    const Surface other = Pixels(push.pixels_at).at[q.y * push.width + q.x];
    const vec3 d = other.position - s.position;
    if (other.id == s.id && (nearest == 0.0 || dot(d, d) < nearest)) nearest = dot(d, d);
  }
  return nearest;
}

Moments reflect_importance(ivec2 p) {
  const Surface s = Pixels(push.pixels_at).at[p.y * push.width + p.x];
  const vec3 incident = normalize(push.camera - s.position);
  Moments m = moments_finish(moments_start());
  m.flux = vec3(1.0);
  m.power_diffuse = s.diffuse;
  m.power_specular = s.specular;
  m.weight = moments_luminance(s.diffuse + s.specular);
  m.position = s.position;
  m.spread = (step_squared(p, ivec2(1, 0), s) + step_squared(p, ivec2(0, 1), s)) / 12.0;
  const LobeMoments diffuse = lobe_encode(s.normal, LAMBDA_DIFFUSE);
  m.diffuse_mean = diffuse.mean;
  m.diffuse_deficit = diffuse.deficit;
  if (s.ndf != NDF_NONE) {
    const SgLobe lobe = specular_lobe(s.ndf, s.alpha, s.shading_normal, incident);
    const LobeMoments specular = lobe_encode(lobe.axis, lobe.sharpness);
    m.specular_mean = specular.mean;
    m.specular_deficit = specular.deficit;
  }
  m.normal_mean = s.normal;
  return m;
}

void main() {
  const uvec2 cell = gl_GlobalInvocationID.xy;
  if (cell.x >= push.size || cell.y >= push.size) return;
  MomentsSum sum = moments_start();
  const float share = 1.0 / float(push.cell * push.cell);
  for (uint j = 0u; j < push.cell; ++j)
    for (uint i = 0u; i < push.cell; ++i) {
      const ivec2 p = ivec2(cell * push.cell + uvec2(i, j));
      if (is_seen(p)) moments_add(sum, reflect_importance(p), share);
    }
  Cells(push.moments_at).at[cell.y * push.size + cell.x] = moments_finish(sum);
}
