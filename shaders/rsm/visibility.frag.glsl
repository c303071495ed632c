// Notes which triangle a pixel sees; cut-out materials have holes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "rsm/texture.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint triangle_index;
layout(location = 0) out uint seen;

void main() {
  vec2 du = dFdx(uv), dv = dFdy(uv);
  Material material = scene_material(scene_triangle(triangle_index).instance);
  if (material.alpha_cutoff > 0.0 && material.base_color_texture >= 0) {
    if (texture_trilinear(material.base_color_texture, uv, du, dv).a < material.alpha_cutoff) discard;
  }
  seen = triangle_index + 1u;
}
