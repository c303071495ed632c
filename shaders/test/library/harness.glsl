// Dispatches one function of shaders/lib over a list of arguments: each invocation takes the words of its row, calls the function whose
// number is FUNCTION and puts the results. tests/analytic/shader_library.h is the other side.
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(constant_id = 100) const uint FUNCTION = 0u;
layout(scalar, binding = 0) readonly buffer Arguments { float arguments[]; };
layout(scalar, binding = 1) buffer Results { float results[]; };
layout(push_constant) uniform Push {
  uint rows, argument_stride, result_stride;
};

uint next_argument, next_result;

float take() { return arguments[next_argument++]; }
vec2 take2() { float x = take(); return vec2(x, take()); }
vec3 take3() { vec2 xy = take2(); return vec3(xy, take()); }
uint take_uint() { return floatBitsToUint(take()); }
int take_int() { return floatBitsToInt(take()); }
void put(float x) { results[next_result++] = x; }
void put(vec2 v) { put(v.x); put(v.y); }
void put(vec3 v) { put(v.xy); put(v.z); }
void put(uint x) { put(uintBitsToFloat(x)); }
void put(int x) { put(intBitsToFloat(x)); }

#include "test/library/rough.glsl"

// Calls function FUNCTION.
void call();

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  next_argument = row * argument_stride;
  next_result = row * result_stride;
  call();
}
