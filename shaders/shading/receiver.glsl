// The pixel that receives light, with everything that does not depend on the light.
#ifndef VSGL_SHADING_RECEIVER_GLSL
#define VSGL_SHADING_RECEIVER_GLSL

#include "interop/model.h"
#include "interop/shading.h"
#include "interop/surface.h"
#include "lib/specular_lobe.glsl"

// What the scene needs; the host builds one pipeline per combination that occurs.
layout(constant_id = SHADING_RECEIVER_ID) const uint RECEIVER = NDF_NONE;
layout(constant_id = SHADING_BUMPED_ID) const uint BUMPED = 0;

// Multiplying is cheaper than dividing by a constant, which compilers must not replace.
const float INVERSE_PI = 0.318309886;

struct Receiver {
  uint place;        // in the list of receivers
  vec3 position, normal, geometric;
  SpecularReceiver lobe;
  float slope_view;  // ggx_slope_cosine of the view
  float bandwidth;   // sharpness of its specular lobe, for bias reduction; 0 without one
  vec3 luminance_diffuse, luminance_specular;  // luminance weights times reflectances
};

Receiver make_receiver(uint place, Surface s, vec3 camera) {
  Receiver r;
  r.place = place;
  r.position = s.position;
  r.normal = s.shading_normal;
  r.geometric = s.normal;
  uint ndf = RECEIVER == NDF_ANY ? s.ndf : RECEIVER;
  r.lobe = specular_receiver(ndf, s.alpha, s.shading_normal, normalize(camera - s.position));
  r.slope_view = ggx_slope_cosine(r.lobe.alpha2, r.lobe.cos_view);
  r.bandwidth = ndf == NDF_NONE ? 0.0 : r.lobe.across;
  const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);
  r.luminance_diffuse = LUMINANCE * s.diffuse;
  r.luminance_specular = LUMINANCE * s.specular;
  return r;
}

#endif
