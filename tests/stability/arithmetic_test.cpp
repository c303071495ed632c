// The device's own arithmetic: how far its elementary functions are from the true values, and that this is no
// more than the tolerances of the shader library allow for.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "library_dispatch.h"
#include "shader_library.h"
#include "spirv/test/stability/arithmetic.comp.glsl.h"

namespace vsgl::test {
namespace {

// Distance of the float32 numbers around x.
double ulp(long double x) {
  return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
}

struct Elementary {
  std::string name;
  std::uint32_t number;  // of arithmetic.comp.glsl
  std::vector<Row> rows;
  std::function<long double(long double, long double, long double)> exact;
  // Largest error, absolute. Vulkan's precision requirements, but for sine and cosine, which it leaves at
  // 2^-11.
  std::function<double(const Row&, long double)> allowed;
  bool emulated = true;  // by rough.glsl
};

auto ulps(double count) {
  return [count](const Row&, long double exact) { return count * ulp(exact); };
}
auto absolute(double error) {
  return [error](const Row&, long double) { return error; };
}
double exponential(const Row& row, long double exact) {
  return (3 + 2 * std::abs(double{row[0]})) * ulp(exact);
}
double logarithm(const Row& row, long double exact) {
  return row[0] > 0.5f && row[0] < 2 ? 0x1p-21 : 3 * ulp(exact);
}
// A product and a sum, rounded apart or at once.
double multiply_add(const Row& row, long double exact) {
  return 0.5 * ulp(static_cast<long double>(row[0]) * row[1]) + 0.5 * ulp(exact);
}

std::vector<Row> line(double low, double high, int count, double y = 1, double z = 0) {
  std::vector<Row> rows;
  for (int i = 0; i < count; ++i)
    rows.push_back({static_cast<float>(low + (high - low) * (i + 0.37) / count), static_cast<float>(y),
                    static_cast<float>(z)});
  return rows;
}
// Over all magnitudes from 2^-100 to 2^100.
std::vector<Row> magnitudes(double y = 1) {
  std::vector<Row> rows;
  for (int i = 0; i < 2000; ++i)
    rows.push_back({static_cast<float>(std::exp2(-100 + 0.1 * i) * 1.0371), static_cast<float>(y), 0});
  return rows;
}
std::vector<Row> triples() {
  std::vector<Row> rows;
  for (int i = 0; i < 2000; ++i) {
    const float x = 1.3f + 0.001f * static_cast<float>(i);
    rows.push_back({x, 0.7f / x, -0.7f + 1e-4f * static_cast<float>(i % 7)});  // most of it cancels
  }
  return rows;
}

std::vector<Elementary> elementary_functions() {
  constexpr double pi = std::numbers::pi;
  using L = long double;
  return {
      {"exp", 0, line(-87, 88, 3000), [](L x, L, L) { return std::exp(x); }, exponential},
      {"exp2", 1, line(-126, 127, 3000), [](L x, L, L) { return std::exp2(x); }, exponential},
      {"log", 2, magnitudes(), [](L x, L, L) { return std::log(x); }, logarithm},
      {"log, near 1", 2, line(0.5, 2, 2000), [](L x, L, L) { return std::log(x); }, logarithm},
      {"log2", 3, magnitudes(), [](L x, L, L) { return std::log2(x); }, logarithm},
      {"sqrt", 4, magnitudes(), [](L x, L, L) { return std::sqrt(x); }, ulps(5)},
      {"inversesqrt", 5, magnitudes(), [](L x, L, L) { return 1 / std::sqrt(x); }, ulps(2)},
      {"division", 6, magnitudes(3.7), [](L x, L y, L) { return x / y; }, ulps(2.5), false},
      {"pow", 7, line(1e-3, 8, 2000, 2.3), [](L x, L y, L) { return std::pow(x, y); },
       [](const Row& row, L exact) {  // exp2(y log2 x), each to its own precision
         const double power = double{row[1]} * std::log2(double{row[0]});
         return (3 + 2 * std::abs(power) + std::abs(power) * 4) * ulp(exact) +
                double{row[1]} * 0x1p-21 * std::numbers::ln2 * static_cast<double>(exact);
       },
       false},
      {"sin", 8, line(-pi, 2 * pi, 3000), [](L x, L, L) { return std::sin(x); }, absolute(0x1p-20)},
      {"cos", 9, line(-pi, 2 * pi, 3000), [](L x, L, L) { return std::cos(x); }, absolute(0x1p-20)},
      {"atan(y, x)", 10, line(-40, 40, 3000, 1.7), [](L x, L y, L) { return std::atan2(x, y); }, ulps(4096)},
      {"acos", 11, line(-1, 1, 3000), [](L x, L, L) { return std::acos(x); }, absolute(1e-3), false},
      {"x * y + z", 12, triples(), [](L x, L y, L z) { return x * y + z; }, multiply_add, false},
      {"fma", 13, triples(), [](L x, L y, L z) { return x * y + z; }, multiply_add, false},
      {"ldexp", 14, line(0.1, 7, 500, 23), [](L x, L y, L) { return std::ldexp(x, static_cast<int>(y)); },
       absolute(0), false},
  };
}

struct Worst {
  double ulps = 0, absolute = 0, of_allowed = 0;
};

Worst worst_of(const Elementary& function, gpu::Device& device, bool rough) {
  const std::vector<float> values =
      call_on_device(device, arithmetic_comp_spv, function.number, function.rows, 1, {}, {.rough = rough});
  Worst worst;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Row& row = function.rows[i];
    const long double exact = function.exact(row[0], row[1], row[2]);
    const auto error = static_cast<double>(std::abs(values[i] - exact));
    const double allowed = function.allowed(row, exact);
    worst.ulps = std::max(worst.ulps, error / ulp(exact));
    worst.absolute = std::max(worst.absolute, error);
    worst.of_allowed = std::max(worst.of_allowed, !std::isfinite(error) ? 1e9
                                                  : error == 0          ? 0
                                                                        : error / allowed);
  }
  return worst;
}

TEST(DeviceArithmetic, ElementaryFunctionsKeepTheirPrecision) {
  gpu::Device device = make_test_device();
  std::printf("%s\n| function | ulp | absolute | of what is allowed |\n", device.info().name.c_str());
  for (const Elementary& function : elementary_functions()) {
    const Worst worst = worst_of(function, device, false);
    std::printf("| %s | %.3g | %.2g | %.2g |\n", function.name.c_str(), worst.ulps, worst.absolute,
                worst.of_allowed);
    EXPECT_LE(worst.of_allowed, 1) << function.name;
  }
}

// rough.glsl goes to the edge, and not far beyond: by what the device errs itself.
TEST(DeviceArithmetic, TheRoughDeviceIsAtTheEdge) {
  gpu::Device device = make_test_device();
  for (const Elementary& function : elementary_functions()) {
    if (!function.emulated) continue;
    const double own = worst_of(function, device, false).of_allowed;
    const double rough = worst_of(function, device, true).of_allowed;
    EXPECT_GT(rough, 0.9) << function.name;
    EXPECT_LE(rough, 1.05 + own) << function.name;
  }
}

}  // namespace
}  // namespace vsgl::test
