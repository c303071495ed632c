// Bindings, constants and sums of all kernels that shade with virtual lights. A kernel defines add_light() and includes shading/loop.glsl.
#ifndef VSGL_SHADING_COMMON_GLSL
#define VSGL_SHADING_COMMON_GLSL

#include "shading/receiver.glsl"

// What the uniform block holds.
#ifndef SHADING_LIGHT
#define SHADING_LIGHT ShadingLight
#endif

layout(local_size_x = SHADING_GROUP) in;

// As RECEIVER, what the scene and the parameters need.
layout(constant_id = SHADING_EMISSION_ID) const uint EMISSION = NDF_NONE;
layout(constant_id = SHADING_SHADOWS_ID) const uint SHADOWS = VISIBILITY_NONE;
layout(constant_id = SHADING_CANCEL_ID) const uint CANCEL = 0;
layout(constant_id = SHADING_PIXELS_ID) const uint PIXELS = 8;

layout(scalar, binding = 0) readonly buffer Receivers { Surface surfaces[]; };
layout(scalar, binding = 1) uniform LightBlock { SHADING_LIGHT lights[SHADING_BLOCK_LIGHTS]; };
layout(scalar, binding = 2) buffer Results { ShadingSums results[]; };
layout(scalar, binding = 3) readonly buffer Atlas { float inverse_distance[]; };
layout(scalar, binding = 4) readonly buffer Views { ShadingView views[]; };
layout(scalar, binding = 5) readonly buffer Bits { uint visibility_words[]; };  // word by word, of all receivers
layout(scalar, push_constant) uniform Push { ShadingPush push; };

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
  float y = dot(r.luminance_diffuse, light.power_diffuse) * t.diffuse.x;
  if (EMISSION != NDF_NONE) y += dot(r.luminance_diffuse, light.power_specular) * t.diffuse.y;
  if (RECEIVER == NDF_NONE) return y;
  y += dot(r.luminance_specular, light.power_diffuse) * t.specular.x;
  if (EMISSION != NDF_NONE) y += dot(r.luminance_specular, light.power_specular) * t.specular.y;
  return y;
}

#endif
