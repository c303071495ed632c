// The claims of docs/stability.md for the forms that run on the device: those of the shader library and those
// of the shading kernels, against quadrature and closed forms.

#include <gtest/gtest.h>

#include <cstdio>

#include "../unit/math/quadrature.h"
#include "extended.h"
#include "hazard.h"
#include "interop/model.h"
#include "interop/shading.h"
#include "kernel_forms.h"
#include "math/vsgl.h"
#include "specular_grid.h"
#include "stages/shading/methods.h"

namespace vsgl::test {
namespace {

// Largest |value - exact| / (relative |exact| + absolute).
double worst_of(const std::vector<float>& values, std::size_t stride, std::size_t value,
                const std::vector<double>& exact, Tolerance tolerance) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double difference = std::abs(double{values[i * stride + value]} - exact[i]);
    worst = std::max(worst, std::isfinite(difference)
                                ? difference / (tolerance.relative * std::abs(exact[i]) + tolerance.absolute)
                                : 1e30);
  }
  return worst;
}

void report(const char* name, double error, double bound) {
  std::printf("| %s | %.2g | %.2g |\n", name, bound, error);
  EXPECT_LE(error, bound) << name;
}

TEST(Bounds, SphericalGaussians) {
  gpu::Device device = make_test_device();
  std::vector<Row> sharpness = powers(1e-12, 1e12, 1.7), products;
  std::vector<double> integrals, exponents;
  for (const Row& row : sharpness) integrals.push_back(sg_integral(double{row[0]}));
  for (const double l1 : {1e-3, 1.0, 40.0, 1e4, 1e8, 1e12})
    for (const double l2 : {0.0, 0.1, 7.0, 1e3, 1e6, 1e12})
      for (int step = 0; step <= 48; ++step) {
        // From a ten-thousandth of the narrower lobe to opposite.
        const double angle = std::numbers::pi * std::pow(10, -step / 6.0);
        Row row = direction({0, 0, 1}), other = direction({std::sin(angle), 0, std::cos(angle)});
        row.push_back(static_cast<float>(l1));
        row.insert(row.end(), other.begin(), other.end());
        row.push_back(static_cast<float>(l2));
        const SgProduct exact =
            sg_product({0, 0, 1}, double{row[3]}, {other[0], other[1], other[2]}, double{row[7]});
        if (exact.exponent < -14) continue;  // too faint to be seen
        products.push_back(row);
        exponents.push_back(exact.exponent);
      }
  for (const bool rough : {false, true}) {
    const auto a = call_library(device, "sg", "sg_integral", sharpness, 1, rough);
    report("1. integral of an SG, relative", worst_of(a, 1, 0, integrals, {1, 0}), 3e-7);
    const auto p = call_library(device, "sg", "sg_product", products, 5, rough);
    report("1. exponent of a product", worst_of(p, 5, 4, exponents, {0, 1}), 5e-6);
  }
}

// The kernels take light broader than sharpness 1e-3 as if it had that: constant to a thousandth.
constexpr double kernel_fluence = 1e-3;

TEST(Bounds, FluenceOfAVsgl) {
  gpu::Device device = make_test_device();
  for (const bool point : {false, true}) {
    std::vector<Row> rows;
    std::vector<double> exact;
    for (const double d : {0.0, 1e-3, 0.05, 1.0, 20.0, 1e3})
      for (const double variance :
           point ? std::vector<double>{0} : std::vector<double>{1e-12, 1e-6, 1e-3, 0.1, 10, 1e4})
        for (const double sharpness : {0.0, 0.3, 2.2925, 30.0, 1e3, 1e4})
          for (const double angle : {0.0, 1e-3, 0.03, 0.4, 1.3, 2.8}) {
            if (point && d == 0) continue;
            const Row axis = direction({std::sin(angle), 0, std::cos(angle)});
            Row row{0, 0, static_cast<float>(-d), static_cast<float>(variance)};
            row.insert(row.end(), axis.begin(), axis.end());
            row.push_back(static_cast<float>(sharpness));
            // The conjugate form in double precision: the plain one fails beyond d^2 / variance = 1e13.
            const VsglIncoming in = vsgl_incoming({0, 0, double{row[2]}}, double{row[3]},
                                                  {axis[0], axis[1], axis[2]}, double{row[7]});
            const double head_on =
                vsgl_incoming({0, 0, double{row[2]}}, double{row[3]}, {0, 0, 1}, double{row[7]}).fluence;
            if (in.fluence < 8e-7 * head_on) continue;  // e^-14
            rows.push_back(row);
            exact.push_back(in.fluence);
          }
    ASSERT_GT(rows.size(), 50u);
    for (const bool rough : {false, true})
      report("5. light of a VSGL, relative",
             worst_of(call_library(device, "vsgl", "vsgl_incoming", rows, 5, rough), 5, 4, exact, {1, 0}),
             3e-5);
    if (!point)
      report("5. the same in the kernels",
             worst_of(call_kernel(device, kernel_incoming, rows, 5), 5, 4, exact, {1, 0}), kernel_fluence);
  }
}

// Facing receivers have a closed form. Here the kernels' lights are not that broad.
TEST(Bounds, FluenceOfAFacingVsgl) {
  gpu::Device device = make_test_device();
  std::vector<Row> rows;
  std::vector<double> exact;
  for (const float d : {1e-3f, 0.3f, 1.0f, 30.0f, 1e3f})
    for (const float variance : {1e-12f, 1e-4f, 1.0f, 1e4f})
      for (const float sharpness : {0.01f, 2.2925f, 100.0f, 1e4f}) {
        rows.push_back({0, 0, d, variance, 0, 0, -1, sharpness});
        const double d2 = double{d} * double{d}, s2 = double{variance}, l = double{sharpness};
        exact.push_back(-std::expm1(-2 * (d2 / s2 + l)) / (d2 + s2 * l));
      }
  const auto worst = [&](const std::vector<float>& values) { return worst_of(values, 5, 4, exact, {1, 0}); };
  report("5. facing VSGL, relative", worst(call_library(device, "vsgl", "vsgl_incoming", rows, 5)), 1e-6);
  report("5. the same in the kernels", worst(call_kernel(device, kernel_incoming, rows, 5)), 3e-5);
}

// Clusters of up to 30 km and lobes of up to the greatest sharpness: their product, 1e21 m^2, squared is
// beyond float32.
TEST(Bounds, HugeSharpVsgl) {
  gpu::Device device = make_test_device();
  std::vector<Row> rows;
  std::vector<double> fluence, axis_x;
  for (const float d : {1.0f, 1e3f, 1e5f})
    for (const float variance : {1.0f, 1e6f, 1e9f})
      for (const double sharpness : {2.2925, 1e10, 0x1p40})
        for (const double tilt : {0.0, 0.5, 4.0}) {  // in widths of the emission lobe
          const Row axis = direction({tilt / std::sqrt(sharpness), 0, 1});
          rows.push_back({0, 0, -d, variance, axis[0], axis[1], axis[2], static_cast<float>(sharpness)});
          const VsglIncoming light = vsgl_incoming({0, 0, -double{d}}, double{variance},
                                                   {axis[0], axis[1], axis[2]}, double{rows.back().back()});
          fluence.push_back(light.fluence);
          axis_x.push_back(light.axis.x);
        }
  const auto error = [&](const std::vector<float>& values) {
    return std::max(worst_of(values, 5, 0, axis_x, {0, 1}), worst_of(values, 5, 4, fluence, {1, 0}));
  };
  constexpr double bound = 1e-3;  // a rough device rounds u by a tenth of the sharpest lobe's width
  for (const bool rough : {false, true}) {
    report("8. huge and sharp VSGL", error(call_library(device, "vsgl", "vsgl_incoming", rows, 5, rough)),
           bound);
    report("8. the same in the kernels", error(call_kernel(device, kernel_incoming, rows, 5, 0, rough)),
           bound);
  }
  EXPECT_GT(error(call_kernel(device, unscaled_incoming_form, rows, 5)), 10 * bound);
}

TEST(Bounds, ClampedCosine) {
  gpu::Device device = make_test_device();
  std::vector<Row> rows;
  std::vector<double> exact;
  for (const double l : {1e-6, 0.01, 0.3, 1.0, 2.2925, 4.0, 8.0, 16.0, 64.0, 1e3, 1e5, 1e8}) {
    const double peak = vmf_mean_above(1, l, 1);
    for (int i = 0; i <= 20; ++i) {
      const auto c = static_cast<float>(std::cos(pi * i / 20));
      rows.push_back({c, static_cast<float>(l)});
      exact.push_back(vmf_mean_above(double{c}, l, 1) / peak);
    }
  }
  const auto relative_to_peak = [&](std::vector<float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double peak = vmf_mean_above(1, double{rows[i][1]}, 1, 500);
      values[i] = static_cast<float>(double{values[i]} / peak);
    }
    return worst_of(values, 1, 0, exact, {0, 1});
  };
  for (const bool rough : {false, true}) {
    report("6. clamped cosine, of the peak",
           relative_to_peak(call_library(device, "sg", "cosine_mean", rows, 1, rough)), 1.5e-3);
    report("6. the same in the kernels",
           relative_to_peak(call_kernel(device, kernel_cosine, rows, 1, 0, rough)), 1.5e-3);
  }
}

// Rows of the grid with the normal that the library's functions take.
std::vector<Row> with_normal(std::vector<Row> rows) {
  for (Row& row : rows) row.insert(row.begin() + 2, {0, 0, 1});
  return rows;
}

TEST(Bounds, SpecularGgx) {
  gpu::Device device = make_test_device();
  const SpecularGrid grid = specular_grid(interop::NDF_GGX,
                                          {{0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1},
                                           {0, 30, 60, 75, 85, 89},
                                           {0, 1, 4, 16, 100, 1e3, 1e4, 1e6, 1e8}},
                                          32);
  const auto expect = [&](const std::string& name, const std::vector<float>& values, double median,
                          double mean) {
    const GridErrors errors = grid_errors(grid, values);
    std::printf("| 7. %s | %.2f / %.2f | %.3f / %.3f |\n", name.c_str(), median, mean, errors.median,
                errors.mean);
    EXPECT_LE(errors.median, median) << name;
    EXPECT_LE(errors.mean, mean) << name;
  };
  const std::vector<Row> rows = with_normal(grid.rows);
  for (const bool rough : {false, true}) {
    const auto of_library = [&](const char* call) {
      return call_library(device, "specular_lobe", call, rows, 1, rough);
    };
    const auto of_kernel = [&](std::uint32_t lobe) {
      return call_kernel(device, kernel_specular, grid.rows, 1, lobe, rough);
    };
    expect("auto in the kernels", of_kernel(interop::SPECULAR_LOBE_AUTO), 0.08, 0.07);
    expect("blend", of_library("specular_vmf_ggx"), 0.08, 0.07);
    expect("blend in the kernels", of_kernel(interop::SPECULAR_LOBE_BLEND), 0.08, 0.07);
    expect("filtered density", of_library("specular_vmf_filtered"), 0.12, 0.10);
    expect("filtered density in the kernels", of_kernel(interop::SPECULAR_LOBE_NDF_FILTER), 0.12, 0.10);
  }
}

// The whole path of the shading kernels from a light to the pixel, in the corners of every argument.
TEST(Bounds, DegenerateInput) {
  gpu::Device device = make_test_device();
  const std::vector<Row> receivers = combinations(
      {words({interop::NDF_GGX, interop::NDF_BECKMANN, interop::NDF_PHONG}),
       numbers({1e-3, 0.5, 1}),
       {direction({0, 0, 1}), direction({1, 0, 1e-4}), direction({1, 0, -0.2}), direction({0, 0, -1})}});
  std::vector<Row> offsets{{0, 0, 0}, {1e-20f, 0, 0}};
  for (const float d : {1e-10f, 1.0f, 1e5f})
    for (const Vec3 u : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}})
      offsets.push_back({d * static_cast<float>(u.x), 0, d * static_cast<float>(u.z)});
  const std::vector<Row> lights =
      combinations({offsets,
                    numbers({1e-12, 1, 1e9}),
                    {direction({0, 0, 1}), direction({0, 0, -1}), direction({-1, 0, 0})},
                    numbers({0, 1e-6, 2.2925, 1e4, 1e10, 0x1p40})});
  const std::vector<Row> rows = combinations({receivers, lights});
  for (const SpecularLobe& lobe : specular_lobes())
    for (const bool rough : {false, true}) {
      const std::vector<float> radiance = call_kernel(device, kernel_receive, rows, 2, lobe.kind, rough);
      std::size_t bad = 0, example = 0;
      for (std::size_t i = 0; i < radiance.size(); ++i)
        if (!(radiance[i] >= 0) || !std::isfinite(radiance[i])) ++bad, example = i / 2;
      EXPECT_EQ(bad, 0u) << lobe.name << ": " << radiance[2 * example] << " " << radiance[2 * example + 1]
                         << " of " << testing::PrintToString(rows[example]);
    }
  const std::vector<float> empty = call_library(device, "moments", "moments_merge", {Row(104, 0.0f)}, 26);
  for (const float x : empty) EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace vsgl::test
