#pragma once

#include <vector>

#include "artifact/artifact.h"

namespace vsgl::test {

// Indirect radiance without visibility, with every RSM texel as a point light, in double precision: what all
// methods without shadow maps approximate [Keller 1997].
struct VplSum {
  std::vector<Vec3> diffuse, specular;  // per pixel, W/(m^2 sr)
  // Pixels that see a surface and are far_from_texels(): there the sum is finite and smooth.
  std::vector<bool> compared;
  std::size_t left_out = 0;  // pixels that see a surface and are not compared
};

VplSum vpl_sum(const GBuffer& gbuffer, const Rsm& rsm);

// Whether each pixel lies farther from every lit texel than that texel's footprint; false for background.
// `points`: where texels are exact point lights, those in the pixel's own plane do not count, but specular
// lobes of both must be wider than the footprint.
std::vector<bool> far_from_texels(const GBuffer& gbuffer, const Rsm& rsm, bool points = false);

// Sum of the reflected powers of all texels, and of all lights, W, luminance.
double reflected_power(const Rsm& rsm);
double emitted_power(const Lights& lights);

// Mean luminance of an image over the mean of the sum, and relative mean squared error with epsilon 2% of the
// mean (squared), over the compared pixels.
struct Agreement {
  double mean_ratio = 0, relative_mse = 0;
};
Agreement agreement(const Indirect& image, const VplSum& truth);

}  // namespace vsgl::test
