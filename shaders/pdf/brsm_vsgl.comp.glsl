// [Ritschel 2011; Tokuyoshi 2014, section 3.2] bidirectional importance from virtual spherical Gaussian lights on the image: every lit
// texel is shaded by them as if it were a pixel that the light source looks at. Without visibility.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#define SOURCE Importon
#define TEXEL Texel
#include "pdf/importance.glsl"
#include "lib/vsgl.glsl"

struct Texel {
  vec3 position, normal, diffuse, specular;
  SpecularReceiver lobe;
};

Texel make_texel(Reflector r) {
  Texel texel;
  texel.position = r.position;
  texel.normal = r.normal;
  texel.diffuse = r.diffuse;
  texel.specular = r.specular;
  if (SPECULAR_TEXELS != 0u) texel.lobe = specular_receiver(r.ndf, r.alpha, r.shading_normal, r.incident);
  return texel;
}

// [Tokuyoshi 2016, section C.2] one emission lobe of the importon, reflected by the texel.
float receive(Texel texel, VsglIncoming incoming, vec3 peak) {
  float reflected = dot(texel.diffuse, peak) / PI * cosine_mean(dot(incoming.axis, texel.normal), incoming.sharpness);
  if (SPECULAR_TEXELS != 0u)
    reflected += dot(texel.specular, peak) * specular_vmf(texel.lobe, incoming.axis, incoming.sharpness);
  return incoming.fluence * reflected;
}

float importance(Texel texel, Importon importon) {
  const vec3 v = importon.position - texel.position;
  float sum = receive(texel, vsgl_incoming(v, importon.variance, importon.diffuse_axis, importon.diffuse_sharpness),
                      importon.diffuse_peak);
  if (SPECULAR_SOURCES != 0u)
    sum += receive(texel, vsgl_incoming(v, importon.variance, importon.specular_axis, importon.specular_sharpness),
                   importon.specular_peak);
  return sum;
}

#include "pdf/loop.glsl"
