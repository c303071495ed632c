#pragma once

// The light of clusters at a tile's samples, unshadowed, for the choice of a cut. Luminances in float32, one
// sample a vector lane; the same bytes on every processor.

#include <array>

#include "artifact/artifact.h"
#include "cluster/traverse.h"
#include "interop/cluster.h"

namespace vsgl {

struct alignas(64) Lanes {
  std::array<float, kTileSamples> lane{};
  float& operator[](std::size_t i) { return lane[i]; }
  float operator[](std::size_t i) const { return lane[i]; }
};
using Lanes3 = std::array<Lanes, 3>;

// What evaluation needs of the samples. A sample that is not there repeats one that is.
struct SampleReceivers {
  Lanes3 position, normal;   // the shading normal
  Lanes3 diffuse, specular;  // reflectance times the weights of luminance; diffuse: over pi
  Lanes3 tangent, bitangent;
  Lanes sin_view, cos_view, alpha2;
  Lanes across;                          // ndf_sharpness / (4 cos_view^2); 0 without a specular lobe
  Lanes mirror_tangent, mirror_normal;   // reflection at the dominant normal, times the lobe's sharpness
  Lanes slope_view, view_lambda, phong;  // phong: 1 where the NDF is Phong's, or 0
  Lanes gaussian;                        // 1 where the NDF is Beckmann's or Phong's, or 0
  bool has_specular = false, has_gaussian = false;
};
// `samples.present` is not 0.
SampleReceivers sample_receivers(const GBuffer& gbuffer, const TileSamples& samples);

struct ClusterLight {
  Lanes value;  // luminance of the radiance towards the camera, W/(m^2 sr)
  Lanes bound;  // of the diffuse part, if it stood at the best place and angle within its reach
};
void evaluate(const interop::Cluster& cluster, const SampleReceivers& receivers, ClusterLight& light);

// The most light, about, that a specular cluster may send to within `reach` (m) of each sample: as luminance,
// W/(m^2 sr). Its mean does not tell, where narrow lobes of emission and reflection meet on some of its
// texels alone. Both lobes are taken as if they had their peaks as near as directions to the cluster turn
// within its reach, and by the share of the cluster that they can cover, which is at least
// `least_share`. All surfaces count as GGX. The cluster emits specular light.
void evaluate_glint(const interop::Cluster& cluster, const SampleReceivers& receivers, const Lanes& reach,
                    float least_share, Lanes& light);

}  // namespace vsgl
