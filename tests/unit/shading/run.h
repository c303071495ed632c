#pragma once

#include <gtest/gtest.h>

#include "oracle.h"
#include "stages/shading/shading.h"

namespace vsgl::test {

inline gpu::Device& shared_device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

inline Indirect shade_box(const GBuffer& gbuffer, const Lights& lights, const ShadingParams& params,
                          const Visibility* visibility = nullptr) {
  Report report;
  return shade(gbuffer, lights, visibility, params, shared_device(), report);
}

inline Vec3 specular_of(const Indirect& image, std::size_t i) {
  return image.specular.empty() ? Vec3{} : to_double(image.specular[i]);
}

// Largest difference of any channel from the oracle's, over the largest value of that layer in the image.
template <class Oracle>
void expect_near_oracle(const Indirect& image, Oracle oracle, double tolerance) {
  double peak_diffuse = 0, peak_specular = 0, error_diffuse = 0, error_specular = 0;
  for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
    const Radiance expected = oracle(i);
    peak_diffuse = std::max(peak_diffuse, length(expected.diffuse));
    peak_specular = std::max(peak_specular, length(expected.specular));
    error_diffuse = std::max(error_diffuse, length(to_double(image.diffuse[i]) - expected.diffuse));
    error_specular = std::max(error_specular, length(specular_of(image, i) - expected.specular));
  }
  ASSERT_GT(peak_diffuse, 0);
  EXPECT_LE(error_diffuse / peak_diffuse, tolerance);
  if (!image.specular.empty()) {
    ASSERT_GT(peak_specular, 0);
    EXPECT_LE(error_specular / peak_specular, tolerance);
  }
}

}  // namespace vsgl::test
