// Soft global illumination from sphere proxies: what the passes of proxy-gi exchange with their host code.
#ifndef VSGL_INTEROP_PROXY_H
#define VSGL_INTEROP_PROXY_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

VSGL_CONST uint PROXY_EXPOSURES = 5u;
struct Proxy {
  vec3 center;  // m, relative to the anchor
  float radius;
  vec3 albedo;                     // over pi: radiance per irradiance
  float exposed[PROXY_EXPOSURES];  // share that counts, 0..1, at distances of 2^i radii
};
VSGL_CHECK_SIZE(Proxy, 48)

// A point that receives light. Receivers come in groups of PROXY_GROUP that lie near one another.
struct ProxyReceiver {
  vec3 position;  // m, relative to the anchor
  uint seen;      // 0: an empty place in its group
  vec3 normal;    // unit
};
VSGL_CHECK_SIZE(ProxyReceiver, 28)
VSGL_CONST uint PROXY_GROUP = 64u;

// Sums over the proxies.
struct ProxySums {
  vec4 log_occlusion[4];  // SH of order 4
  vec3 indirect;          // irradiance, not yet normalised
  float covering;         // side by side: irradiance of an even sky of radiance 1, or solid angle, sr
};
VSGL_CHECK_SIZE(ProxySums, 80)

// Irradiances, W/m^2.
struct ProxyShade {
  vec3 direct, indirect;
};
VSGL_CHECK_SIZE(ProxyShade, 24)

// What depends on a proxy's half angle alone, at 1 - cos(angle) = i / (PROXY_TABLE - 1).
struct ProxyEntry {
  vec4 log_occlusion;  // bands, times sqrt(4 pi / (2l + 1))
  vec4 cap;            // bands 0..2 of the cap times those of the clamped cosine; solid angle, sr
  vec4 coupling0, coupling1, coupling2, coupling3;  // of the exact operator, by |m|, radiance, irradiance
};
VSGL_CHECK_SIZE(ProxyEntry, 96)
VSGL_CONST uint PROXY_TABLE = 256u;

// The environment's irradiance over a sphere as a + linear . d + d^T Q d, where d is the direction: order 3.
struct ProxyLight {
  vec3 constant;
  vec3 x, y, z;
  vec3 xx, yy, zz, xy, yz, xz;  // Q is symmetric, without trace
};
VSGL_CHECK_SIZE(ProxyLight, 120)

// Of the exponential.
struct ProxyFit {
  vec2 factors;  // of HYB, at norms of i / (PROXY_FITS - 1) of the largest
};
VSGL_CHECK_SIZE(ProxyFit, 8)
VSGL_CONST uint PROXY_FITS = 17u;
VSGL_CONST uint PROXY_MAX_SQUARINGS = 16u;

struct ProxyCullPush {
  uint groups, proxies;
  float reach;  // of a sphere of influence, in radii
};
VSGL_CHECK_SIZE(ProxyCullPush, 12)

struct ProxyAccumulatePush {
  float shadow_sine, indirect_sine;  // least sines of half angles that count
};
VSGL_CHECK_SIZE(ProxyAccumulatePush, 8)

struct ProxyUpsamplePush {
  vec3 camera;  // relative to the anchor, m
  uint width;   // of the image, pixels
  uint height;
  uint rate;     // pixels a side that one receiver stands for
  uint columns;  // receivers a row
  uint rows;
};
VSGL_CHECK_SIZE(ProxyUpsamplePush, 32)

// Of a pixel, from receivers.
struct ProxyPixel {
  ProxyShade shade;
  float weight;  // sum of the weights, 0..1: 0 where no receiver suits
};
VSGL_CHECK_SIZE(ProxyPixel, 28)
VSGL_CONST uint PROXY_NO_SLOT = 0xFFFFFFFFu;

// Specialisation constants.
VSGL_CONST uint PROXY_FILL_ID = 0u;           // cull: 0 counts, 1 lists
VSGL_CONST uint PROXY_OPERATOR_ID = 1u;       // accumulate: PROXY_POINT..
VSGL_CONST uint PROXY_EXP_ID = 2u;            // exponentiate: PROXY_SECOND_ORDER..
VSGL_CONST uint PROXY_UPSAMPLE_ID = 3u;       // upsample: PROXY_BILINEAR..
VSGL_CONST uint PROXY_NORMALISATION_ID = 4u;  // accumulate, exponentiate: PROXY_COSINE..
VSGL_CONST uint PROXY_POINT = 0u;
VSGL_CONST uint PROXY_AVERAGED = 1u;
VSGL_CONST uint PROXY_EXACT = 2u;
VSGL_CONST uint PROXY_COSINE = 0u;
VSGL_CONST uint PROXY_SOLID_ANGLE = 1u;
VSGL_CONST uint PROXY_SECOND_ORDER = 0u;
VSGL_CONST uint PROXY_HYB = 1u;
VSGL_CONST uint PROXY_BILINEAR = 0u;
VSGL_CONST uint PROXY_BILATERAL = 1u;
VSGL_CONST uint PROXY_PLANE = 2u;

VSGL_INTEROP_END
#endif
