// Spherical harmonics of order 4: twins of libs/sh. Coefficient (l, m) is at l^2 + l + m.
#ifndef VSGL_PROXY_SH_GLSL
#define VSGL_PROXY_SH_GLSL

#include "lib/constants.glsl"
#include "proxy/sh_product.glsl"

const float SQRT_4PI = 3.5449077;

// Of a unit direction.
void sh_basis(vec3 d, out float y[16]) {
  const vec3 d2 = d * d;
  y[0] = 0.28209479;
  y[1] = 0.48860251 * d.y;
  y[2] = 0.48860251 * d.z;
  y[3] = 0.48860251 * d.x;
  y[4] = 1.0925484 * d.x * d.y;
  y[5] = 1.0925484 * d.y * d.z;
  y[6] = 0.31539157 * (3.0 * d2.z - 1.0);
  y[7] = 1.0925484 * d.x * d.z;
  y[8] = 0.54627422 * (d2.x - d2.y);
  y[9] = 0.59004359 * d.y * (3.0 * d2.x - d2.y);
  y[10] = 2.8906114 * d.x * d.y * d.z;
  y[11] = 0.45704579 * d.y * (5.0 * d2.z - 1.0);
  y[12] = 0.37317633 * d.z * (5.0 * d2.z - 3.0);
  y[13] = 0.45704579 * d.x * (5.0 * d2.z - 1.0);
  y[14] = 1.4453057 * d.z * (d2.x - d2.y);
  y[15] = 0.59004359 * d.x * (d2.x - 3.0 * d2.y);
}

float sh_norm(float f[16]) {
  float sum = 0.0;
  for (int i = 0; i < 16; ++i) sum += f[i] * f[i];
  return sqrt(sum);
}

#endif
