// The exponential of each receiver's sum of logarithms, and the light that it lets through.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/proxy.h"
#include "proxy/sh.glsl"

layout(local_size_x = PROXY_GROUP) in;
layout(constant_id = PROXY_EXP_ID) const uint EXPONENTIAL = PROXY_SECOND_ORDER;
layout(constant_id = PROXY_NORMALISATION_ID) const uint NORMALISATION = PROXY_COSINE;
layout(scalar, binding = 0) readonly buffer Receivers { ProxyReceiver receivers[]; };
layout(scalar, binding = 1) buffer Sums { ProxySums sums[]; };  // occlusions take the logarithms' place
layout(scalar, binding = 2) readonly buffer Light { vec3 light[16]; };
layout(scalar, binding = 3) readonly buffer Fits { ProxyFit fits[]; };
layout(scalar, binding = 4) writeonly buffer Shades { ProxyShade shades[]; };

// [Ren 2006] the start of HYB: a + b x.
void start_linear(inout float x[16], float norm) {
  const float place = norm * (4.0 * float(PROXY_FITS - 1u));
  const uint entry = min(uint(place), PROXY_FITS - 2u);
  const vec2 factors = mix(fits[entry].factors, fits[entry + 1u].factors, place - float(entry));
  for (int i = 0; i < 16; ++i) x[i] *= factors.y;
  x[0] += factors.x * SQRT_4PI;
}

// 1 + x + x*x/2.
void start_second_order(inout float x[16]) {
  float square[16];
  sh_product(x, x, square);
  for (int i = 0; i < 16; ++i) x[i] += 0.5 * square[i];
  x[0] += SQRT_4PI;
}

// exp(f); see libs/sh/exponential.h.
void sh_exp(inout float f[16]) {
  const float factor = exp(f[0] / SQRT_4PI);
  f[0] = 0.0;
  float norm = sh_norm(f), scale = 1.0;
  uint squarings = 0u;
  const float limit = EXPONENTIAL == PROXY_HYB ? 0.25 : 0.5;
  while (norm * scale > limit && squarings < PROXY_MAX_SQUARINGS) {
    scale *= 0.5;
    ++squarings;
  }
  for (int i = 0; i < 16; ++i) f[i] *= scale;
  if (EXPONENTIAL == PROXY_HYB)
    start_linear(f, norm * scale);
  else
    start_second_order(f);
  for (uint n = 0u; n < squarings; ++n) {
    float square[16];
    sh_product(f, f, square);
    f = square;
  }
  for (int i = 0; i < 16; ++i) f[i] *= factor;
}

// The clamped cosine about the normal, whose band 3 is 0.
void sh_cosine(vec3 normal, out float h[16]) {
  sh_basis(normal, h);
  for (int i = 0; i < 16; ++i) h[i] *= i < 1 ? PI : i < 4 ? 2.0 / 3.0 * PI : i < 9 ? 0.25 * PI : 0.0;
}

void main() {
  const uint receiver = gl_GlobalInvocationID.x;
  const ProxyReceiver at = receivers[receiver];
  if (at.seen == 0u) {
    shades[receiver] = ProxyShade(vec3(0.0), vec3(0.0));
    return;
  }
  const ProxySums sum = sums[receiver];
  float occlusion[16];
  for (int i = 0; i < 16; ++i) occlusion[i] = sum.log_occlusion[i / 4][i % 4];
  sh_exp(occlusion);
  for (int i = 0; i < 4; ++i)
    sums[receiver].log_occlusion[i] =
        vec4(occlusion[4 * i], occlusion[4 * i + 1], occlusion[4 * i + 2], occlusion[4 * i + 3]);
  // [Sloan 2007, Eq. (10)] H . (O * L) as L . (O * H).
  float cosine[16], seen[16];
  sh_cosine(at.normal, cosine);
  sh_product(occlusion, cosine, seen);
  vec3 direct = vec3(0.0);
  for (int i = 0; i < 16; ++i) direct += seen[i] * light[i];
  // What is left of an even sky: blockers take light, though products that are cut off may say otherwise.
  const float open = seen[0] * SQRT_4PI;
  direct *= PI / max(open, PI);
  // [Sloan 2007, Eq. (12)] by solid angles.
  // Deviation: or by irradiances of an even sky, so that the proxies never give more than they hide.
  const float covered = NORMALISATION == PROXY_COSINE ? clamp(PI - open, 0.0, PI) : (SQRT_4PI - occlusion[0]) * SQRT_4PI;
  const float share = sum.covering > 0.0 ? clamp(covered / sum.covering, 0.0, 1.0) : 1.0;
  shades[receiver] = ProxyShade(direct, share * sum.indirect);
}
