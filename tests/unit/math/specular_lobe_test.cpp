#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <vector>

#include "math/mixture_lobe.h"
#include "math/reflected_lobe.h"
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

// Adds the cases of one receiver and sharpness whose integral is above 1% of their peak.
void append_visible(std::vector<Case>& all, std::vector<Case> group) {
  double peak = 0;
  for (const Case& c : group) peak = std::max(peak, c.exact);
  for (Case& c : group) {
    c.peak = peak;
    if (c.exact > 0.01 * peak) all.push_back(c);
  }
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
        std::vector<Case> group;
        for (const Vec3 axis : test::offset_axes({-view.x, 0, view.z}, lobe, sharpness))
          group.push_back({receiver, axis, sharpness, reference.integral(axis, sharpness), 0});
        append_visible(all, std::move(group));
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

// As [Tokuyoshi 2016, C.2] prints it: coefficient and smooth term at the light's axis.
double asg_as_printed(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis), in_lobe = reflected_local(r, light);
  return specular_coefficient(r, light.z) * std::max(in_lobe.z, 0.0) *
         specular_asg_convolved(r, in_lobe, sharpness);
}

struct Form {
  const char* name;
  Method method;
};
const std::vector<Form> forms{
    {"mixture", specular_vmf_mixture}, {"blend", specular_vmf_blend}, {"ndf-filter", specular_vmf_ndf_filter},
    {"sg", specular_vmf_sg},           {"asg", specular_vmf_asg},     {"asg-asg", specular_vmf_asg_asg},
    {"asg as printed", asg_as_printed}};

// The table of docs/shading.md: each form over the whole grid and over slices of it.
void print_table(const char* ndf, const std::vector<Case>& all) {
  const auto slice = [&](auto keep) {
    std::vector<Case> some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some), keep);
    return some;
  };
  const std::vector<std::vector<Case>> slices{
      all,
      slice([](const Case& c) { return c.receiver.alpha2 < 0.011; }),
      slice([](const Case& c) { return c.receiver.alpha2 > 0.011; }),
      slice([](const Case& c) { return c.sharpness <= 1; }),
      slice([](const Case& c) { return c.sharpness > 1 && c.sharpness <= 100; }),
      slice([](const Case& c) { return c.sharpness > 100; }),
      slice([](const Case& c) { return c.receiver.cos_view > 0.49; }),
      slice([](const Case& c) { return c.receiver.cos_view < 0.26; }),
  };
  for (const Form& form : forms) {
    std::printf("| %s | `%s` |", ndf, form.name);
    for (const std::vector<Case>& some : slices) {
      const Errors e = errors(some, form.method);
      std::printf(" %.3f / %.3f |", e.median, e.absolute);
    }
    std::printf("\n");
  }
}

TEST(SpecularLobe, GgxMatchesQuadrature) {
  const std::vector<Case> all = cases(NDF_GGX, {0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1},
                                      view_degrees, light_sharpnesses);
  ASSERT_GT(all.size(), 1000u);
  print_table("GGX", all);
  const Errors blend = errors(all, specular_vmf_ggx), filtered = errors(all, specular_vmf_filtered);
  const Errors sg = errors(all, specular_vmf_sg), asg = errors(all, specular_vmf_asg);
  const Errors both = errors(all, specular_vmf_asg_asg), printed = errors(all, asg_as_printed);
  const Errors mixture = errors(all, specular_vmf_mixture);
  EXPECT_LT(mixture.median, 0.012);
  EXPECT_LT(mixture.absolute, 0.028);
  EXPECT_LT(blend.median, 0.08);
  EXPECT_LT(blend.absolute, 0.07);
  EXPECT_LT(filtered.median, 0.12);
  EXPECT_LT(filtered.absolute, 0.10);
  EXPECT_LT(sg.absolute, 0.18);
  EXPECT_LT(asg.absolute, 0.17);
  EXPECT_LT(both.absolute, 0.22);
  EXPECT_LT(printed.absolute, 0.25);
}

TEST(SpecularLobe, BeckmannAndPhongMatchQuadrature) {
  for (const std::uint32_t ndf : {NDF_BECKMANN, NDF_PHONG}) {
    const std::vector<Case> all =
        cases(ndf, {0.01, 0.1, 0.2, 0.5, 0.8}, {0, 30, 60, 85}, {0, 1, 16, 100, 1e4, 1e6});
    print_table(ndf == NDF_BECKMANN ? "Beckmann" : "Phong", all);
    const Errors gaussian = errors(all, specular_vmf_blend), filtered = errors(all, specular_vmf_filtered);
    const Errors projected = errors(all, specular_vmf_ndf_filter);
    const Errors mixture = errors(all, specular_vmf_mixture);
    EXPECT_LT(mixture.median, 0.005);
    EXPECT_LT(mixture.absolute, 0.03);
    EXPECT_LT(gaussian.median, 0.035);
    EXPECT_LT(gaussian.absolute, 0.075);
    EXPECT_LT(gaussian.absolute, filtered.absolute);
    EXPECT_LT(projected.absolute, filtered.absolute);
    EXPECT_LT(errors(all, specular_vmf_asg).absolute, 0.15);
    EXPECT_LT(errors(all, specular_vmf_sg).absolute, 0.16);
    EXPECT_LT(errors(all, specular_vmf_asg_asg).absolute, 0.24);
  }
}

// Random surfaces, views and lights, none of which the constants were chosen by.
std::vector<Case> random_cases(std::uint32_t ndf, int groups) {
  std::mt19937_64 generator(ndf);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(generator() >> 11) * 0x1p-53);
  };
  std::vector<Case> all;
  for (int i = 0; i < groups; ++i) {
    const double alpha = std::pow(10, uniform(-3, 0)), angle = uniform(0, 89) * pi / 180;
    const double sharpness = std::pow(10, uniform(-1, 6));
    const Vec3 view{std::sin(angle), 0, std::cos(angle)}, mirror{-view.x, 0, view.z}, across{0, 1, 0};
    const SpecularReceiver receiver = specular_receiver(ndf, alpha, {0, 0, 1}, view);
    const test::SpecularReference reference(ndf, alpha, view);
    const double lobe = receiver.across * receiver.cos_view;
    const double width = std::min(std::sqrt(1 / std::max(sharpness, 0.5) + 1 / std::max(lobe, 0.5)), 1.0);
    std::vector<Case> group;
    for (int k = 0; k < 9; ++k) {
      const double offset = std::min(uniform(0, 4) * width, 0.75 * pi), side = uniform(0, 2 * pi);
      const Vec3 axis = std::cos(offset) * mirror +
                        std::sin(offset) * (std::cos(side) * cross(mirror, across) + std::sin(side) * across);
      group.push_back({receiver, axis, sharpness, reference.integral(axis, sharpness), 0});
    }
    append_visible(all, std::move(group));
  }
  return all;
}

TEST(SpecularLobe, MixtureIsSeveralTimesAsAccurateAsTheBlendOnRandomCases) {
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG}) {
    const std::vector<Case> all = random_cases(ndf, 150);
    const Errors mixture = errors(all, specular_vmf_mixture), blend = errors(all, specular_vmf_blend);
    EXPECT_LT(mixture.absolute, 0.02) << ndf;
    EXPECT_LT(mixture.median, 0.015) << ndf;
    EXPECT_LT(mixture.absolute, 0.5 * blend.absolute) << ndf;
  }
}

// Axes all around.
std::vector<Vec3> sphere_axes(int count) {
  std::vector<Vec3> axes;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, s = std::sqrt(1 - z * z), turn = 2 * pi * 0.618034 * i;
    axes.push_back({s * std::cos(turn), s * std::sin(turn), z});
  }
  return axes;
}

// Light of sharpness 0 has an axis in name only.
TEST(SpecularLobe, MixtureOfLightFromEverywhereHasNoAxis) {
  for (const std::uint32_t ndf : {NDF_GGX, NDF_BECKMANN, NDF_PHONG})
    for (const double alpha : {0.01, 0.1, 0.5, 0.9, 0.99, 1.0})
      for (const double angle : {0.0, 0.8, 1.4}) {
        const SpecularReceiver r =
            specular_receiver(ndf, alpha, {0, 0, 1}, {std::sin(angle), 0, std::cos(angle)});
        const double value = specular_vmf_mixture(r, {0, 0, 1}, 0);
        for (const Vec3 axis : sphere_axes(40))
          EXPECT_NEAR(specular_vmf_mixture(r, axis, 0) / value, 1, 0.02)
              << ndf << " " << alpha << " " << angle;
      }
}

// Light so broad that the horizon cuts it whatever its axis.
TEST(SpecularLobe, MixtureOfBroadLightOnRoughSurfacesMatchesQuadrature) {
  const std::pair<std::uint32_t, double> bounds[] = {
      {NDF_GGX, 0.115}, {NDF_BECKMANN, 0.1}, {NDF_PHONG, 0.115}};
  for (const auto& [ndf, bound] : bounds) {
    std::vector<Case> all;
    for (const double alpha : {0.3, 0.5, 0.7, 0.9})
      for (const double angle : {0.0, 0.8, 1.3, 1.47}) {
        const Vec3 view{std::sin(angle), 0, std::cos(angle)};
        const SpecularReceiver r = specular_receiver(ndf, alpha, {0, 0, 1}, view);
        const test::SpecularReference reference(ndf, alpha, view);
        for (const double sharpness : {0.0, 0.1, 0.3, 0.6}) {
          const std::size_t first = all.size();
          double peak = 0;
          for (const Vec3 axis : sphere_axes(12)) {
            all.push_back({r, axis, sharpness, reference.integral(axis, sharpness), 0});
            peak = std::max(peak, all.back().exact);
          }
          for (std::size_t i = first; i < all.size(); ++i) all[i].peak = peak;
        }
      }
    EXPECT_LT(errors(all, specular_vmf_mixture).absolute, bound) << ndf;
  }
}

// Sharp lights on a surface seen at a grazing angle: the reflected lobe is far from round.
TEST(SpecularLobe, IsElongatedAtGrazingAngles) {
  for (const std::uint32_t ndf : {NDF_BECKMANN, NDF_PHONG}) {
    std::vector<Case> all = cases(ndf, {0.03, 0.1}, {80, 85}, {1e3, 1e4});
    const double round = errors(all, specular_vmf_sg).median;
    EXPECT_GT(round, 0.1);
    for (const Method method : {specular_vmf_asg, specular_vmf_asg_asg, specular_vmf_ndf_filter,
                                specular_vmf_blend, specular_vmf_mixture})
      EXPECT_LT(errors(all, method).median, 0.5 * round);
  }
}

// The exponent and the axis of the product are least eigenvalue and eigenvector: no direction has a smaller
// exponent, and there the exponents of both ASGs add up to it. The integral is that of exact quadrature.
TEST(ReflectedLobe, ProductOfAsgsMatchesQuadrature) {
  for (const Vec3 light : {Vec3{0, 0, 1}, normalise(Vec3{0.1, 0.2, 1}), normalise(Vec3{0.6, -0.1, 0.7})})
    for (const double eta_x : {20.0, 400.0})
      for (const double nu : {8.0, 100.0}) {
        const double eta_y = 20;
        const AsgProduct p = asg_product(light, eta_x, eta_y, nu);
        const auto exponent = [&](Vec3 w) {
          const double c = dot(w, light);
          return eta_x * w.x * w.x + eta_y * w.y * w.y + nu * (1 - c * c);
        };
        EXPECT_NEAR(exponent(p.axis), p.exponent, 1e-6);
        for (const Vec3 step : {Vec3{1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{-1e-3, 1e-3, 0}})
          EXPECT_GE(exponent(normalise(p.axis + step)), p.exponent);
        double sum = 0;
        const int rows = 300, columns = 300;
        for (int i = 0; i < rows; ++i)
          for (int j = 0; j < columns; ++j) {
            const double u = (i + 0.5) / rows, z = 1 - u * u, angle = 2 * pi * (j + 0.5) / columns;
            const double s = std::sqrt(1 - z * z);
            const Vec3 w{s * std::cos(angle), s * std::sin(angle), z};
            sum += 2 * u * z * std::max(dot(w, light), 0.0) * std::exp(-exponent(w));
          }
        const double exact = sum * 2 * pi / (rows * columns);
        EXPECT_NEAR(p.integral * std::exp(-p.exponent) / exact, 1, 0.04)
            << light.x << " " << eta_x << " " << nu;
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
        for (const Method method : {specular_vmf_blend, specular_vmf_mixture})
          EXPECT_NEAR(method(r, light, 1e10) / specular_brdf_cos(ndf, alpha, n, view, light), 1, 2e-3);
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
                 {specular_vmf_mixture, specular_vmf_blend, specular_vmf_filtered, specular_vmf_ndf_filter,
                  specular_vmf_sg, specular_vmf_asg, specular_vmf_asg_asg}) {
              const double value = method(specular_receiver(ndf, alpha, {0, 0, 1}, view), axis, sharpness);
              EXPECT_TRUE(std::isfinite(value) && value >= 0) << ndf << " " << alpha << " " << sharpness;
            }
}

}  // namespace
}  // namespace vsgl
