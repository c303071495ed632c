#include <gtest/gtest.h>

#include "../synthetic_room.h"
#include "pyramid/kernels.h"

namespace vsgl {
namespace {

using interop::Kernel;
using interop::Light;
using interop::Moments;

DoubleMoments to_double(const Moments& m) {
  DoubleMoments out;
  out.flux = test::to_double(m.flux);
  out.power_diffuse = test::to_double(m.power_diffuse);
  out.power_specular = test::to_double(m.power_specular);
  out.weight = m.weight;
  out.position = test::to_double(m.position);
  out.spread = m.spread;
  out.diffuse_mean = test::to_double(m.diffuse_mean);
  out.diffuse_deficit = m.diffuse_deficit;
  out.specular_mean = test::to_double(m.specular_mean);
  out.specular_deficit = m.specular_deficit;
  out.normal_mean = test::to_double(m.normal_mean);
  out.normal_deficit = m.normal_deficit;
  return out;
}

// The eight trilinear taps at the kernel, clamped to the edge.
DoubleMoments filter(const std::vector<Moments>& pyramid, int size, const Kernel& kernel) {
  std::vector<DoubleMoments> taps;
  std::vector<double> shares;
  const int finer = std::min(static_cast<int>(kernel.level), pyramid_levels(size) - 1);
  for (int up = 0; up < 2; ++up) {
    const int level = std::min(finer + up, pyramid_levels(size) - 1), side = size >> level;
    const double blend = static_cast<double>(kernel.level) - finer, of_level = up == 0 ? 1 - blend : blend;
    const double x = static_cast<double>(kernel.centre.x) * side - 0.5,
                 y = static_cast<double>(kernel.centre.y) * side - 0.5;
    for (int k = 0; k < 4; ++k) {
      const double i = std::floor(x) + (k & 1), j = std::floor(y) + (k >> 1);
      const auto row = static_cast<std::size_t>(std::clamp(j, 0.0, side - 1.0));
      const auto column = static_cast<std::size_t>(std::clamp(i, 0.0, side - 1.0));
      taps.push_back(
          to_double(pyramid[pyramid_offset(size, level) + row * static_cast<std::size_t>(side) + column]));
      shares.push_back(of_level * (1 - std::abs(x - i)) * (1 - std::abs(y - j)));
    }
  }
  return merge_moments(taps, shares);
}

TEST(Filter, AgreesWithTheTwin) {
  gpu::Device device({.compute_only = true});
  Report report;
  const Rsm rsm = test::room_rsm(128, 2);
  const Pdf pdf = test::flux_pdf(rsm);
  const std::vector<DensityPyramid> densities = {{128, pdf.layers[0].pyramid}, {128, pdf.layers[1].pyramid}};
  const std::vector<std::span<const Moments>> moments = {rsm.layers[0].pyramid, rsm.layers[1].pyramid};
  const auto kernels = draw_kernels(densities, {}, device, report);
  const auto lights = filter_moments(kernels, moments, rsm.size, 1e-9, device, report);
  ASSERT_EQ(lights.size(), kernels.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& l = lights[i];
    const DoubleMoments m = filter(rsm.layers[kernels[i].layer].pyramid, rsm.size, kernels[i]);
    const double scale = kernels[i].power_scale;
    EXPECT_EQ(l.layer, kernels[i].layer);
    EXPECT_NEAR(double(l.variance) / (0.5 * m.spread), 1, 1e-4);
    EXPECT_NEAR(length(test::to_double(l.position) - m.position), 0, 1e-5);
    EXPECT_NEAR(length(test::to_double(l.power_diffuse) - m.power_diffuse * scale), 0,
                1e-5 * length(m.power_diffuse) * scale);
    EXPECT_NEAR(length(test::to_double(l.power_specular) - m.power_specular * scale), 0,
                1e-5 * length(m.power_specular) * scale);
    EXPECT_NEAR(l.normal_deficit, m.normal_deficit, 1e-5);
    const SgLobe diffuse = lobe_decode({m.diffuse_mean, m.diffuse_deficit});
    EXPECT_NEAR(double(l.diffuse_sharpness) / diffuse.sharpness, 1, 1e-4);
    EXPECT_NEAR(length(test::to_double(l.diffuse_axis) - diffuse.axis), 0, 1e-4);
    if (m.power_specular == Vec3{}) {
      EXPECT_EQ(test::to_double(l.specular_axis), Vec3{});
      continue;
    }
    const SgLobe specular = lobe_decode({m.specular_mean, m.specular_deficit});
    EXPECT_NEAR(double(l.specular_sharpness) / specular.sharpness, 1, 1e-4);
    EXPECT_NEAR(length(test::to_double(l.specular_axis) - specular.axis), 0, 1e-4);
  }
}

TEST(Filter, FloorsTheVariance) {
  gpu::Device device({.compute_only = true});
  Report report;
  const Rsm rsm = test::room_rsm(16);
  const Pdf pdf = test::flux_pdf(rsm);
  const std::vector<DensityPyramid> densities = {{16, pdf.layers[0].pyramid}};
  const std::vector<std::span<const Moments>> moments = {rsm.layers[0].pyramid};
  for (const Light& l :
       filter_moments(draw_kernels(densities, {}, device, report), moments, 16, 100.0, device, report))
    EXPECT_EQ(l.variance, 100);
}

}  // namespace
}  // namespace vsgl
