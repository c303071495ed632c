#include "math/specular_lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "quadrature.h"

namespace vsgl {
namespace {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;
using test::pi;
using Method = double (*)(const SpecularReceiver&, Vec3, double);

struct Case {
  SpecularReceiver receiver;
  Vec3 axis;
  double sharpness;
  double exact;
  double peak;  // of the exact values over the offsets
};

// Lights up to 4 combined lobe widths off the mirror direction, in the plane of incidence, across it and
// between.
std::vector<Vec3> offset_axes(Vec3 mirror, double width) {
  std::vector<Vec3> axes{mirror};
  const Vec3 across{0, 1, 0}, within = cross(mirror, across);
  for (const double offset : {0.5, 1.0, 2.0, 4.0}) {
    const double angle = std::min(offset * width, 0.75 * pi);
    for (const Vec3 side : {within, -within, across, normalise(within + across)})
      axes.push_back(std::cos(angle) * mirror + std::sin(angle) * side);
  }
  return axes;
}

std::vector<Case> cases(std::uint32_t ndf, const std::vector<double>& alphas,
                        const std::vector<double>& degrees, const std::vector<double>& sharpnesses) {
  std::vector<Case> all;
  for (const double alpha : alphas)
    for (const double angle : degrees) {
      const Vec3 view{std::sin(angle * pi / 180), 0, std::cos(angle * pi / 180)};
      const SpecularReceiver receiver = specular_receiver(ndf, alpha, {0, 0, 1}, view);
      const test::SpecularReference reference(ndf, alpha, view);
      const double lobe = receiver.across * receiver.cos_view;
      for (const double sharpness : sharpnesses) {
        const double width = std::min(std::sqrt(1 / std::max(sharpness, 0.5) + 1 / std::max(lobe, 0.5)), 1.0);
        std::vector<Case> group;
        double peak = 0;
        for (const Vec3 axis : offset_axes({-view.x, 0, view.z}, width)) {
          group.push_back({receiver, axis, sharpness, reference.integral(axis, sharpness), 0});
          peak = std::max(peak, group.back().exact);
        }
        for (Case& c : group) {
          c.peak = peak;
          if (c.exact > 0.01 * peak) all.push_back(c);
        }
      }
    }
  return all;
}

struct Errors {
  double median;    // relative
  double absolute;  // mean over the peak
};

Errors errors(const std::vector<Case>& all, Method method) {
  std::vector<double> relative;
  double sum = 0;
  for (const Case& c : all) {
    const double difference = std::abs(method(c.receiver, c.axis, c.sharpness) - c.exact);
    relative.push_back(difference / c.exact);
    sum += std::min(difference / c.peak, 10.0);
  }
  std::nth_element(relative.begin(), relative.begin() + relative.size() / 2, relative.end());
  return {relative[relative.size() / 2], sum / static_cast<double>(all.size())};
}

const std::vector<double> view_degrees{0, 30, 60, 75, 85, 89};
const std::vector<double> light_sharpnesses{0, 1, 4, 16, 100, 1e3, 1e4, 1e6, 1e8};

TEST(SpecularLobe, GgxMatchesQuadrature) {
  const std::vector<Case> all = cases(NDF_GGX, {0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1},
                                      view_degrees, light_sharpnesses);
  ASSERT_GT(all.size(), 1000u);
  const Errors blend = errors(all, specular_vmf_ggx), filtered = errors(all, specular_vmf_filtered);
  const Errors asg = errors(all, specular_vmf_asg), product = errors(all, specular_vmf_asg_product);
  EXPECT_LT(blend.median, 0.08);
  EXPECT_LT(blend.absolute, 0.07);
  EXPECT_LT(filtered.median, 0.12);
  EXPECT_LT(filtered.absolute, 0.10);
  EXPECT_LT(asg.absolute, 0.25);
  EXPECT_LT(product.absolute, asg.absolute);
  std::printf(
      "GGX: median, mean over peak: blend %.4f %.4f, filtered %.4f %.4f, asg %.4f %.4f, asg product %.4f "
      "%.4f\n",
      blend.median, blend.absolute, filtered.median, filtered.absolute, asg.median, asg.absolute,
      product.median, product.absolute);
}

TEST(SpecularLobe, BeckmannAndPhongMatchQuadrature) {
  for (const std::uint32_t ndf : {NDF_BECKMANN, NDF_PHONG}) {
    const std::vector<Case> all =
        cases(ndf, {0.01, 0.1, 0.2, 0.5, 0.8}, {0, 30, 60, 85}, {0, 1, 16, 100, 1e4, 1e6});
    const Errors gaussian = errors(all, specular_vmf), filtered = errors(all, specular_vmf_filtered);
    const Errors asg = errors(all, specular_vmf_asg);
    EXPECT_LT(gaussian.median, 0.035);
    EXPECT_LT(gaussian.absolute, 0.075);
    EXPECT_LT(gaussian.absolute, filtered.absolute);
    EXPECT_LT(gaussian.absolute, asg.absolute);
    std::printf("NDF %u: gaussian %.4f %.4f, filtered %.4f %.4f, asg %.4f %.4f\n", ndf, gaussian.median,
                gaussian.absolute, filtered.median, filtered.absolute, asg.median, asg.absolute);
  }
}

TEST(SpecularLobe, TendsToTheBrdfAsTheLightSharpens) {
  const Vec3 n = normalise(Vec3{0.3, -0.2, 1}), view = normalise(Vec3{0.9, 0.2, 0.7});
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double alpha : {0.05, 0.4, 1.0}) {
      const SpecularReceiver r = specular_receiver(ndf, alpha, n, view);
      const Vec3 mirror = specular_lobe(ndf, alpha, n, view).axis;
      for (const Vec3 offset : {Vec3{}, Vec3{0.02, 0.03, 0}, Vec3{-0.2, 0.3, 0.1}}) {
        const Vec3 light = normalise(mirror + alpha * offset);
        EXPECT_NEAR(specular_vmf(r, light, 1e10) / specular_brdf_cos(ndf, alpha, n, view, light), 1, 2e-3);
      }
    }
}

TEST(SpecularLobe, IsFiniteForDegenerateInput) {
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double alpha : {1e-3, 0.5, 1.0})
      for (const Vec3 view :
           {Vec3{0, 0, 1}, normalise(Vec3{1, 0, 1e-4}), normalise(Vec3{1, 0, -0.1}), Vec3{0, 0, -1}})
        for (const double sharpness : {0.0, 1e-9, 1.0, 1e6, sharpness_max})
          for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, -view})
            for (const Method method :
                 {specular_vmf, specular_vmf_filtered, specular_vmf_asg, specular_vmf_asg_product}) {
              const double value = method(specular_receiver(ndf, alpha, {0, 0, 1}, view), axis, sharpness);
              EXPECT_TRUE(std::isfinite(value) && value >= 0) << ndf << " " << alpha << " " << sharpness;
            }
}

}  // namespace
}  // namespace vsgl
