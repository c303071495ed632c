#include "hazard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "spirv/test/stability/hazards.comp.glsl.h"

namespace vsgl::test {
namespace {

struct Found {
  const LibraryFile& file;
  std::uint32_t number;
};

Found find(const std::string& file, const std::string& call) {
  static const std::vector<LibraryFile> files = library_files();
  for (const LibraryFile& f : files)
    for (std::uint32_t i = 0; f.name == file && i < f.calls.size(); ++i)
      if (f.calls[i].name == call) return {f, i};
  throw std::logic_error("no library call " + file + ": " + call);
}

double error_of(double value, long double exact, const Tolerance& bound) {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  const auto difference = static_cast<double>(std::abs(value - exact));
  return difference == 0
             ? 0
             : difference / (bound.relative * static_cast<double>(std::abs(exact)) + bound.absolute);
}

}  // namespace

std::vector<float> call_library(gpu::Device& device, const std::string& file, const std::string& call,
                                const std::vector<Row>& rows, std::size_t values, bool rough) {
  const Found found = find(file, call);
  return call_on_device(device, found.file.spirv, found.number, rows, values, found.file.appendix,
                        {.rough = rough});
}

std::vector<float> call_before(gpu::Device& device, std::uint32_t number, const std::vector<Row>& rows,
                               std::size_t values) {
  return call_on_device(device, hazards_comp_spv, number, rows, values);
}

HazardErrors measure(const Hazard& hazard, gpu::Device& device) {
  const LibraryCall& call = [&]() -> const LibraryCall& {
    const Found found = find(hazard.now.file, hazard.now.call);
    return found.file.calls[found.number];
  }();
  std::vector<Values> twins;
  for (const Row& row : hazard.rows) {
    Arguments arguments{row};
    twins.push_back(call.twin(arguments));
  }
  const std::size_t values = twins[0].size();
  const auto now = [&](bool rough) {
    return call_library(device, hazard.now.file, hazard.now.call, hazard.rows, values, rough);
  };
  const std::vector<float> device_values = now(false), rough_values = now(true),
                           before_values =
                               call_before(device, hazard.before, hazard.rows, hazard.before_values);
  HazardErrors worst;
  for (std::size_t i = 0; i < hazard.rows.size(); ++i) {
    Arguments arguments{hazard.rows[i]};
    const long double exact = hazard.exact(arguments);
    const auto raise = [&](double& error, double value) {
      error = std::max(error, error_of(value, exact, hazard.bound));
    };
    raise(worst.twin, twins[i][hazard.now.value].value);
    raise(worst.device, double{device_values[i * values + hazard.now.value]});
    raise(worst.rough, double{rough_values[i * values + hazard.now.value]});
    raise(worst.before, double{before_values[i * hazard.before_values + hazard.before_value]});
  }
  return worst;
}

void expect_tamed(const Hazard& hazard) {
  ASSERT_FALSE(hazard.rows.empty()) << hazard.name;
  gpu::Device device = make_test_device();
  const HazardErrors worst = measure(hazard, device);
  // In units of the error itself where there is one kind of bound.
  const double unit = std::max(hazard.bound.relative, hazard.bound.absolute);
  std::printf("| %s | %.0e | %.1e | %.1e | %.1e | %.1e |\n", hazard.name.c_str(), unit, worst.twin * unit,
              worst.device * unit, worst.rough * unit, worst.before * unit);
  EXPECT_LE(worst.twin, 1) << hazard.name;
  EXPECT_LE(worst.device, 1) << hazard.name;
  EXPECT_LE(worst.rough, 1) << hazard.name;
  EXPECT_GE(worst.before, hazard.excess) << hazard.name << ": the form before meets the bound as well";
}

}  // namespace vsgl::test
