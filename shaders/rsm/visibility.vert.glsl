// Draws all triangles of the scene, three vertices each.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "rsm/scene.glsl"
#include "rsm/view.glsl"

layout(location = 0) out vec2 uv;
layout(location = 1) flat out uint triangle_index;

void main() {
  triangle_index = uint(gl_VertexIndex) / 3u;
  Triangle t = scene_triangle(triangle_index);
  uint corner = uint(gl_VertexIndex) % 3u;
  Vertex v = scene_vertex(corner == 0u ? t.a : corner == 1u ? t.b : t.c);
  uv = v.uv;
  gl_Position = view_clip(BAKE.view, v.position);
}
