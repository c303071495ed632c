// Test shader: three triangles over the lower left half of the view, at the depths of the push constants.
#version 450

layout(location = 0) flat out uint layer;
layout(push_constant) uniform Push { vec4 depths; };

void main() {
  layer = uint(gl_VertexIndex) / 3u;
  const vec2 corners[3] = vec2[](vec2(-1.0, -1.0), vec2(-1.0, 1.0), vec2(1.0, 1.0));
  gl_Position = vec4(corners[gl_VertexIndex % 3], depths[layer], 1.0);
}
