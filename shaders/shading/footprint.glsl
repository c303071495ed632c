// Reflection of a cluster's footprint, near or far.
#ifndef VSGL_SHADING_FOOTPRINT_GLSL
#define VSGL_SHADING_FOOTPRINT_GLSL

#include "kernels/fvpl.glsl"
#include "shading/receive.glsl"

// (diffuse, specular) radiance per unit of the cluster's radiant intensity and of each reflectance, 1/m^2.
vec2 receive_footprint(Receiver r, Cluster c, FvplView view) {
  Incoming light = fvpl_incoming(view, c.inverse_variance);
  vec2 received = receive(r, light);
  float cosine = PI * received.x / (light.amplitude * light.phi * (1.0 + light.decay));
  received.x *= fvpl_plane(c, view.u, r.normal, cosine, light.inverse_sharpness, 1.0);
  return received;
}

#endif
