#pragma once

// The rival of the shading benchmark: method vsgl for diffuse or GGX pixels and lights, in C++ for one pixel
// a vector lane.

#include <array>
#include <vector>

#include "artifact/artifact.h"
#include "interop/shading.h"

namespace vsgl::bench {

// Receivers by component, padded to whole chunks.
struct NativeReceivers {
  static constexpr int kChunk = 32;
  std::size_t count = 0;  // of pixels
  std::array<std::vector<float>, 3> position, normal, tangent, bitangent, luminance_diffuse,
      luminance_specular;
  std::vector<float> sin_view, cos_view, alpha2, across, mirror_tangent, mirror_normal, slope_view;
};
NativeReceivers make_native_receivers(const GBuffer& gbuffer);

// Sums without reflectances: diffuse and specular RGB and the cancelled luminance.
struct NativeSums {
  std::array<std::vector<float>, 7> channels;
};

// Two builds of the same source, for vectors of 256 and 512 bits. `threshold`: a_cbr.
namespace width256 {
void shade(const NativeReceivers& receivers, const std::vector<interop::ShadingLight>& lights, bool glossy,
           float threshold, NativeSums& out);
}
namespace width512 {
void shade(const NativeReceivers& receivers, const std::vector<interop::ShadingLight>& lights, bool glossy,
           float threshold, NativeSums& out);
}

}  // namespace vsgl::bench
