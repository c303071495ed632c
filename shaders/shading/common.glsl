// Bindings, constants and the receiving pixel of all shading kernels. A kernel defines add_light() and includes shading/loop.glsl.
#ifndef VSGL_SHADING_COMMON_GLSL
#define VSGL_SHADING_COMMON_GLSL

#include "interop/light.h"
#include "interop/model.h"
#include "interop/shading.h"
#include "interop/surface.h"
#include "lib/specular_lobe.glsl"

layout(local_size_x = SHADING_GROUP) in;

// What the scene needs; the host builds one pipeline per combination that occurs.
layout(constant_id = SHADING_RECEIVER_ID) const uint RECEIVER = NDF_NONE;
layout(constant_id = SHADING_EMISSION_ID) const uint EMISSION = NDF_NONE;
layout(constant_id = SHADING_SHADOWS_ID) const uint SHADOWS = 0;
layout(constant_id = SHADING_CANCEL_ID) const uint CANCEL = 0;
layout(constant_id = SHADING_BUMPED_ID) const uint BUMPED = 0;
layout(constant_id = SHADING_ASG_ID) const uint ASG = 0;

layout(scalar, binding = 0) readonly buffer Receivers { Surface surfaces[]; };
layout(scalar, binding = 1) uniform LightBlock { ShadingLight lights[SHADING_BLOCK_LIGHTS]; };
layout(scalar, binding = 2) buffer Results { ShadingSums results[]; };
layout(scalar, binding = 3) readonly buffer Atlas { float inverse_distance[]; };
layout(scalar, binding = 4) readonly buffer Views { ShadingView views[]; };
layout(scalar, push_constant) uniform Push { ShadingPush push; };

// A pixel, with everything that does not depend on the light.
struct Receiver {
  vec3 position, normal, geometric;
  SpecularReceiver lobe;
  float slope_view;  // ggx_slope_cosine of the view
  float bandwidth;  // sharpness of its specular lobe, for bias reduction; 0 without one
  vec3 luminance_diffuse, luminance_specular;  // luminance weights times reflectances
};

// What one watt of each emission lobe becomes at the receiver, per unit of each reflectance, 1/(m^2 sr).
struct Transfer {
  vec2 diffuse;   // from the diffuse and the specular lobe
  vec2 specular;
};

struct Sums {
  vec3 diffuse, specular;
  float aside;
};

void add(inout Sums sums, ShadingLight light, Transfer t) {
  sums.diffuse += light.power_diffuse * t.diffuse.x;
  if (EMISSION != NDF_NONE) sums.diffuse += light.power_specular * t.diffuse.y;
  if (RECEIVER == NDF_NONE) return;
  sums.specular += light.power_diffuse * t.specular.x;
  if (EMISSION != NDF_NONE) sums.specular += light.power_specular * t.specular.y;
}

// Luminance of the radiance that the transfer gives.
float luminance(Receiver r, ShadingLight light, Transfer t) {
  float y = dot(r.luminance_diffuse, light.power_diffuse * t.diffuse.x + light.power_specular * t.diffuse.y);
  if (RECEIVER != NDF_NONE)
    y += dot(r.luminance_specular, light.power_diffuse * t.specular.x + light.power_specular * t.specular.y);
  return y;
}

Receiver load_receiver(uint i) {
  Surface s = surfaces[i];
  Receiver r;
  r.position = s.position;
  r.normal = s.shading_normal;
  r.geometric = s.normal;
  vec3 view = normalize(push.camera - s.position);
  uint ndf = RECEIVER == NDF_ANY ? s.ndf : RECEIVER;
  r.lobe = specular_receiver(ndf, s.alpha, s.shading_normal, view);
  r.slope_view = ggx_slope_cosine(r.lobe.alpha2, r.lobe.cos_view);
  r.bandwidth = ndf == NDF_NONE ? 0.0 : r.lobe.across;
  const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);
  r.luminance_diffuse = LUMINANCE * s.diffuse;
  r.luminance_specular = LUMINANCE * s.specular;
  return r;
}

#endif
