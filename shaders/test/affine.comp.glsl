// Test shader: result[i] = scale * value[i] + OFFSET.
#version 450

layout(local_size_x = 64) in;
layout(constant_id = 0) const float OFFSET = 0.0;

layout(binding = 0, std430) readonly buffer Values { float value[]; };
layout(binding = 1, std430) writeonly buffer Results { float result[]; };
layout(push_constant) uniform Push {
  float scale;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) result[i] = scale * value[i] + OFFSET;
}
