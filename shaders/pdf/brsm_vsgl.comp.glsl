// [Ritschel 2011; Tokuyoshi 2014, section 3.2] bidirectional importance from virtual spherical Gaussian lights on the image: every lit
// texel is shaded by them as if it were a pixel that the light source looks at. Without visibility.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#define SOURCE Importon
#define TEXEL Texel
#include "pdf/importance.glsl"
#include "kernels/fused.glsl"

struct Texel {
  vec3 position, normal, diffuse, specular;
  SpecularReceiver lobe;
  float slope_view;  // ggx_slope_cosine of the view
};

Texel make_texel(Reflector r) {
  Texel texel;
  const uint ndf = TEXEL_NDF == IMPORTANCE_NDF_ANY ? r.ndf : TEXEL_NDF;
  texel.position = r.position;
  texel.normal = r.normal;
  texel.diffuse = r.diffuse;
  texel.specular = r.specular;
  texel.lobe = specular_receiver(ndf, r.alpha, r.shading_normal, r.incident);
  texel.slope_view = ggx_slope_cosine(texel.lobe.alpha2, texel.lobe.cos_view);
  return texel;
}

// The specular lobe's answer to the normalised SG, 1/sr.
float specular_answer(Texel texel, Incoming incoming) {
  const vec3 light = specular_local(texel.lobe, incoming.axis);
  if (texel.lobe.ndf == NDF_GGX) return fast_specular_ggx(texel.lobe, light, incoming, texel.slope_view);
  return fast_specular_gaussian(texel.lobe, light, incoming);
}

// [Tokuyoshi 2016, section C.2] one emission lobe of the importon, reflected by the texel.
float receive(Texel texel, Incoming incoming, vec3 peak) {
  float sum = dot(texel.diffuse, peak) / PI * received_cosine(incoming, dot(incoming.axis, texel.normal));
  if (TEXEL_NDF != NDF_NONE)
    sum += dot(texel.specular, peak) * incoming.amplitude * incoming.phi * (1.0 + incoming.decay) * specular_answer(texel, incoming);
  return sum;
}

float importance(Texel texel, Importon importon) {
  const vec3 v = importon.position - texel.position;
  const float d2 = dot(v, v), inverse_variance = 1.0 / importon.variance;
  const vec3 u = v * inversesqrt(max(d2, 1e-36));
  float sum = receive(texel, incoming_light(u, d2, importon.variance, inverse_variance, importon.diffuse_axis, importon.diffuse_sharpness),
                      importon.diffuse_peak);
  if (SOURCE_NDF != NDF_NONE)
    sum += receive(texel, incoming_light(u, d2, importon.variance, inverse_variance, importon.specular_axis, importon.specular_sharpness),
                   importon.specular_peak);
  return sum;
}

#include "pdf/loop.glsl"
