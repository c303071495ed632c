#include "stages/shading/cut_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interop/model.h"
#include "math/interop_vec.h"

namespace vsgl {
namespace {

using interop::Surface;

// A sample lies on a pixel's surface where the line between them leaves the pixel's tangent plane at less
// than this sine, and where the normals agree to this cosine.
constexpr double kLargestRise = 0.1;
constexpr double kSmallestAgreement = 0.9;
// Irradiance is nearly linear in the normal, so the pixel's own may differ by this much from the mean of its
// samples' where the image's error may be as much or more; below, it falls with the error.
constexpr double kLargestBend = 0.05;
// Of irradiance around an interpolated pixel, where the image's error may be kCoarse or more; below, its
// square falls with the error, as interpolation errs by the square of the contrast.
constexpr double kLargestContrast = 0.5, kCoarse = 0.1;

std::uint8_t kind_of(const Surface& s) {
  if (s.id == interop::NO_INSTANCE) return kBackground;
  const bool black = s.specular.x == 0 && s.specular.y == 0 && s.specular.z == 0;
  return static_cast<std::uint8_t>(black ? interop::NDF_NONE : s.ndf);
}

bool on_surface(const Surface& pixel, const Surface& sample) {
  const Vec3 v = to_double(sample.position) - to_double(pixel.position), n = to_double(pixel.normal);
  const double rise = dot(v, n);
  return rise * rise <= kLargestRise * kLargestRise * dot(v, v) &&
         dot(n, to_double(sample.normal)) >= kSmallestAgreement &&
         dot(to_double(pixel.shading_normal), to_double(sample.shading_normal)) >= kSmallestAgreement;
}

}  // namespace

std::vector<std::uint8_t> pixel_kinds(const GBuffer& gbuffer) {
  std::vector<std::uint8_t> kinds(gbuffer.pixels.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = kind_of(gbuffer.pixels[i]);
  return kinds;
}

HalfResolution::HalfResolution(const GBuffer& gbuffer, std::span<const std::uint8_t> kinds, double error)
    : gbuffer_(gbuffer),
      largest_bend_(std::min(kLargestBend, error)),
      largest_contrast_(kLargestContrast * std::sqrt(std::min(error / kCoarse, 1.0))),
      columns_((gbuffer.width + 1) / 2),
      rows_((gbuffer.height + 1) / 2),
      samples_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
      shaded_(kinds.size()),
      interpolated_(kinds.size()) {
#pragma omp parallel for schedule(static)
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const std::uint32_t sample = find_sample(kinds, column, row);
      samples_[static_cast<std::size_t>(row * columns_ + column)] = sample;
      if (sample != kNone) shaded_[sample] = 1;
    }
  std::size_t exact = 0;
#pragma omp parallel for schedule(static) reduction(+ : exact)
  for (std::uint32_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == kBackground || shaded_[i]) continue;
    Stencil stencil;
    const bool diffuse = kinds[i] == interop::NDF_NONE;
    interpolated_[i] = diffuse && surround(i, stencil) && fits(i, stencil);
    shaded_[i] = !interpolated_[i];
    exact += diffuse && shaded_[i];
  }
  exact_ = exact;
}

std::uint32_t HalfResolution::find_sample(std::span<const std::uint8_t> kinds, int column, int row) const {
  for (int y = 2 * row; y < std::min(2 * row + 2, gbuffer_.height); ++y)
    for (int x = 2 * column; x < std::min(2 * column + 2, gbuffer_.width); ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * gbuffer_.width + x);
      if (kinds[pixel] != kBackground) return pixel;
    }
  return kNone;
}

// False where a quad that counts has no sample.
bool HalfResolution::surround(std::uint32_t pixel, Stencil& stencil) const {
  const int x = static_cast<int>(pixel) % gbuffer_.width, y = static_cast<int>(pixel) / gbuffer_.width;
  double total = 0;
  for (int row = y / 2; row <= (y + 1) / 2; ++row)
    for (int column = x / 2; column <= (x + 1) / 2; ++column) {
      if (row == rows_ || column == columns_) return false;
      const std::uint32_t sample = samples_[static_cast<std::size_t>(row * columns_ + column)];
      if (sample == kNone) return false;
      const int dx = static_cast<int>(sample) % gbuffer_.width - x,
                dy = static_cast<int>(sample) / gbuffer_.width - y;
      const double weight = std::max(2 - std::abs(dx), 0) * std::max(2 - std::abs(dy), 0);
      if (weight == 0) return false;
      stencil.sample[stencil.count] = sample;
      stencil.weight[stencil.count++] = weight;
      total += weight;
    }
  for (int k = 0; k < stencil.count; ++k) stencil.weight[k] /= total;
  return true;
}

bool HalfResolution::fits(std::uint32_t pixel, const Stencil& stencil) const {
  const Surface& s = gbuffer_.pixels[pixel];
  Vec3 bend = -to_double(s.shading_normal);
  for (int k = 0; k < stencil.count; ++k) {
    const Surface& sample = gbuffer_.pixels[stencil.sample[k]];
    if (!on_surface(s, sample)) return false;
    bend += stencil.weight[k] * to_double(sample.shading_normal);
  }
  return dot(bend, bend) <= largest_bend_ * largest_bend_;
}

// Of the samples' luminances in the quads that surround the pixel and their neighbours (light may peak
// between two samples, but not between four), the largest over the smallest, less 1.
double HalfResolution::contrast_around(std::uint32_t pixel, std::span<const interop::vec3> irradiance) const {
  const int x = static_cast<int>(pixel) % gbuffer_.width, y = static_cast<int>(pixel) / gbuffer_.width;
  double least = std::numeric_limits<double>::max(), most = 0;
  for (int row = std::max(y / 2 - 1, 0); row <= std::min((y + 1) / 2 + 1, rows_ - 1); ++row)
    for (int column = std::max(x / 2 - 1, 0); column <= std::min((x + 1) / 2 + 1, columns_ - 1); ++column) {
      const std::uint32_t sample = samples_[static_cast<std::size_t>(row * columns_ + column)];
      if (sample == kNone) continue;
      const double value = luminance(to_double(irradiance[sample]));
      least = std::min(least, value);
      most = std::max(most, value);
    }
  return most > least ? most / least - 1 : 0;
}

std::vector<std::uint8_t> HalfResolution::interpolate(std::span<interop::vec3> irradiance) const {
  std::vector<std::uint8_t> rejected(irradiance.size());
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = 0; i < irradiance.size(); ++i) {
    if (!interpolated_[i]) continue;
    Stencil stencil;
    surround(i, stencil);
    Vec3 sum;
    for (int k = 0; k < stencil.count; ++k)
      sum += stencil.weight[k] * to_double(irradiance[stencil.sample[k]]);
    irradiance[i] = to_float(sum);
    rejected[i] = contrast_around(i, irradiance) > largest_contrast_;
  }
  return rejected;
}

}  // namespace vsgl
