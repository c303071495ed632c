#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/compute.h"

// Calls functions of test shaders (shaders/test/library/harness.glsl) on the device.

namespace vsgl::test {

// The device that tests of arithmetic run on: lavapipe, or what VSGL_TEST_DEVICE names (gpu, or part of a
// device's name).
gpu::Device make_test_device();

// How the call is compiled. Rough: with elementary functions at the edge of what Vulkan allows
// (shaders/test/library/rough.glsl).
struct CallOptions {
  bool rough = false;
  gpu::SpecializationConstants constants{};  // further ones of the shader's own
};

// Results of function `number`: `stride` words for each row of `arguments`, which holds `rows` rows of equal
// length and, behind them, `appendix`.
std::vector<float> call_on_device(gpu::Device& device, std::span<const std::uint32_t> spirv,
                                  std::uint32_t number, std::span<const std::vector<float>> rows,
                                  std::size_t stride, std::span<const float> appendix = {},
                                  const CallOptions& options = {});

}  // namespace vsgl::test
