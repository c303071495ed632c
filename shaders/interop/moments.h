// Statistics of a set of reflecting surface points: the payload of the moment pyramids of RSM and G-buffer.
#ifndef VSGL_INTEROP_MOMENTS_H
#define VSGL_INTEROP_MOMENTS_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// Powers are plain averages per texel (watts per texel, RGB); the other members are means weighted by
// `weight` (position, spread, normal), Y(power_diffuse) (diffuse lobe) or Y(power_specular) (specular lobe),
// Y = Rec.709 luminance. A lobe's `mean` is its mean direction, length r in 0..1; `deficit` is 1 - r^2, kept
// apart so that sharp lobes keep their digits.
struct Moments {
  vec3 flux;            // incident, W
  vec3 power_diffuse;   // flux * diffuse reflectance, W
  vec3 power_specular;  // flux * specular reflectance, W
  float weight;         // Y(power_diffuse + power_specular)
  vec3 position;        // mean, m, relative to the anchor
  float spread;         // E|y - mean|^2, m^2, over all three axes
  vec3 diffuse_mean;    // axis points along emission
  float diffuse_deficit;
  vec3 specular_mean;
  float specular_deficit;
  vec3 normal_mean;  // of the geometric normal
  float normal_deficit;
};
VSGL_CHECK_SIZE(Moments, 104)

// Push constants of one step of their pyramid: device addresses of both levels; `size` texels a side of the
// coarser one.
struct MergePush {
  uvec2 fine_at, coarse_at;
  uint size;
};
VSGL_CHECK_SIZE(MergePush, 20)

VSGL_INTEROP_END
#endif
