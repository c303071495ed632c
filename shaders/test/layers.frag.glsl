// Test shader: two colour attachments of different formats.
#version 450

layout(location = 0) flat in uint layer;
layout(location = 0) out uint index;
layout(location = 1) out vec4 place;

void main() {
  index = layer + 1u;
  place = vec4(gl_FragCoord.xy, gl_FragCoord.z, -1.0);
}
