#pragma once

// Which pixels of an image are shaded by themselves, and from which of those the irradiance of the others is
// interpolated.

#include <cstdint>
#include <span>
#include <vector>

#include "artifact/artifact.h"

namespace vsgl {

// How a pixel reflects: NDF_* of its specular lobe (NDF_NONE: diffuse only), or kBackground.
inline constexpr std::uint8_t kBackground = 255;
std::vector<std::uint8_t> pixel_kinds(const GBuffer& gbuffer);

// Diffuse irradiance at half resolution. The sample of each 2x2 quad is its first pixel that sees something.
// A pixel without specular lobe that is no sample takes the bilinear interpolation of the samples around it,
// where these lie on its surface and have on average its shading normal; elsewhere it is shaded by itself, as
// are samples and specular pixels.
class HalfResolution {
 public:
  // error: that the image may have, relative.
  HalfResolution(const GBuffer& gbuffer, std::span<const std::uint8_t> kinds, double error);

  // 1: the pixel is shaded by itself.
  const std::vector<std::uint8_t>& shaded() const { return shaded_; }
  // Pixels that are neither samples nor specular, but shaded.
  std::size_t exact_pixels() const { return exact_; }

  // Sets the irradiance of all pixels that are interpolated, but for those whose samples differ by more than
  // the error allows: these are marked in the result (1), to be shaded after all.
  std::vector<std::uint8_t> interpolate(std::span<interop::vec3> irradiance) const;

 private:
  // Samples that surround a pixel, with their bilinear weights.
  struct Stencil {
    int count = 0;
    std::uint32_t sample[4];
    double weight[4];  // sum 1
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::uint32_t find_sample(std::span<const std::uint8_t> kinds, int column, int row) const;
  bool surround(std::uint32_t pixel, Stencil& stencil) const;
  double contrast_around(std::uint32_t pixel, std::span<const interop::vec3> irradiance) const;
  bool fits(std::uint32_t pixel, const Stencil& stencil) const;

  const GBuffer& gbuffer_;
  double largest_bend_, largest_contrast_;
  int columns_, rows_;                  // of quads
  std::vector<std::uint32_t> samples_;  // pixel of each quad, kNone: it sees nothing
  std::vector<std::uint8_t> shaded_, interpolated_;
  std::size_t exact_ = 0;
};

}  // namespace vsgl
