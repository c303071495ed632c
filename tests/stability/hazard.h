#pragma once

#include <functional>
#include <string>
#include <vector>

#include "library_dispatch.h"
#include "shader_library.h"

// A place where float32 goes wrong: what the library does about it, on the device and in its twin, and what
// happens without (a function of shaders/test/stability/hazards.comp.glsl).

namespace vsgl::test {

// A result of a function of the shader library, by its row in shader_library_*.cpp.
struct LibraryResult {
  std::string file, call;
  std::size_t value = 0;  // of the results
};

struct Hazard {
  std::string name;
  std::vector<Row> rows;  // arguments of both forms
  LibraryResult now;
  std::uint32_t before;                     // number of the function
  std::size_t before_values, before_value;  // how many results it has, and which one is meant
  std::function<long double(Arguments&)> exact;
  Tolerance bound;     // what the library keeps, and the form before does not
  double excess = 10;  // by how much the worst error of the form before is beyond the bound, at least
};

// The functions before, by their number.
inline constexpr std::uint32_t before_ggx = 0, before_phong = 1, before_sg = 2, before_sg_factored = 3,
                               before_sg_integral = 4, before_product = 5, before_solid_angle = 6,
                               before_sharpness = 7, before_fluence = 8, before_kernel_level = 9,
                               before_filter = 10, before_asg_exponent = 11, before_cosine_mean = 12,
                               before_raw_moments = 13;

// Worst errors in units of what is allowed; infinite where a value is not finite.
struct HazardErrors {
  double device = 0, rough = 0, twin = 0, before = 0;
};
HazardErrors measure(const Hazard& hazard, gpu::Device& device);

// Results of a function of the library, or of one before, on the device: `values` a row.
std::vector<float> call_library(gpu::Device& device, const std::string& file, const std::string& call,
                                const std::vector<Row>& rows, std::size_t values, bool rough = false);
std::vector<float> call_before(gpu::Device& device, std::uint32_t number, const std::vector<Row>& rows,
                               std::size_t values);

// Measures, prints a line of the table of docs/stability.md, and expects what the hazard says.
void expect_tamed(const Hazard& hazard);

}  // namespace vsgl::test
