#pragma once

// One function per method; see lights_methods().

#include "stages/lights/lights.h"

namespace vsgl {

// Least standard deviation of a footprint, as a fraction of the scene's radius: keeps radiance finite next to
// a light.
inline constexpr double footprint_floor = 1e-6;

inline bool has_power(const interop::Light& light) {
  const interop::vec3 &d = light.power_diffuse, &s = light.power_specular;
  return d.x + d.y + d.z + s.x + s.y + s.z > 0;
}

LightSet generate_vpl(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_vsl(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_fis_2014(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_fis_2016(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_metropolis(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_kmeans_2d(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_kmeans_3d(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_texels(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_two_vsgl(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);
LightSet generate_tree(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&);


// The lights of an environment that have power, in the samples' order.
std::vector<interop::Light> sample_environment(const scene::Environment&, const LightsParams&, gpu::Device&,
                                               Report&);
// A light a sphere.
std::vector<interop::Light> make_sphere_lights(const std::vector<scene::SphereLight>&);
// An environment's radiance integrated over all directions, W/m^2.
Vec3 environment_power(const scene::Environment&);

}  // namespace vsgl
