// The elementary functions of a device at the edge of what Vulkan's precision requirements allow (sine and cosine: of what the library
// needs, 2^-20). Where ROUGH is set, each result is pushed by the whole allowance, up or down as a hash of its bits says; elsewhere these
// are the device's own. Division keeps the device's.
layout(constant_id = 101) const bool ROUGH = false;

// `y`, moved by `ulps` (whole ones).
float rough_push(float y, float ulps) {
  int bits = floatBitsToInt(y);
  int steps = int(ulps);
  bool up = ((uint(bits) * 2654435761u) >> 31) == 0u;
  bool movable = ROUGH && abs(y) > 1e-30 && abs(y) < 1e30;
  return movable ? intBitsToFloat(bits + (up ? steps : -steps)) : y;
}
// `y`, moved by `error`.
float rough_shift(float y, float error) {
  return ROUGH ? y + (((floatBitsToUint(y) * 2654435761u) >> 31) == 0u ? error : -error) : y;
}

float rough_exp(float x) { return rough_push(exp(x), 3.0 + 2.0 * min(abs(x), 100.0)); }
float rough_exp2(float x) { return rough_push(exp2(x), 3.0 + 2.0 * min(abs(x), 140.0)); }
float rough_log(float x) { return x > 0.5 && x < 2.0 ? rough_shift(log(x), 4.76837158e-7) : rough_push(log(x), 3.0); }
float rough_log2(float x) { return x > 0.5 && x < 2.0 ? rough_shift(log2(x), 4.76837158e-7) : rough_push(log2(x), 3.0); }
float rough_inversesqrt(float x) { return rough_push(inversesqrt(x), 2.0); }
float rough_sqrt(float x) { return rough_push(sqrt(x), 5.0); }  // a division's 2.5 and an inverse square root's 2
vec2 rough_sqrt(vec2 v) { return vec2(rough_sqrt(v.x), rough_sqrt(v.y)); }
float rough_length(vec2 v) { return rough_sqrt(dot(v, v)); }
float rough_length(vec3 v) { return rough_sqrt(dot(v, v)); }
vec3 rough_normalize(vec3 v) { return v / rough_length(v); }
float rough_sin(float x) { return rough_shift(sin(x), 9.53674316e-7); }
float rough_cos(float x) { return rough_shift(cos(x), 9.53674316e-7); }
float rough_atan(float y, float x) { return rough_push(atan(y, x), 4096.0); }

#define exp rough_exp
#define exp2 rough_exp2
#define log rough_log
#define log2 rough_log2
#define inversesqrt rough_inversesqrt
#define sqrt rough_sqrt
#define length rough_length
#define normalize rough_normalize
#define sin rough_sin
#define cos rough_cos
#define atan rough_atan
