#include "library_dispatch.h"

#include <cstdlib>

namespace vsgl::test {
namespace {

// Of shaders/test/library/harness.glsl.
constexpr std::uint32_t kFunctionId = 100, kRoughId = 101;
struct Push {
  std::uint32_t rows, argument_stride, result_stride;
};

}  // namespace

gpu::Device make_test_device() {
  const char* name = std::getenv("VSGL_TEST_DEVICE");
  return gpu::Device({.device = name ? name : "auto"});
}

std::vector<float> call_on_device(gpu::Device& device, std::span<const std::uint32_t> spirv,
                                  std::uint32_t number, std::span<const std::vector<float>> rows,
                                  std::size_t stride, std::span<const float> appendix,
                                  const CallOptions& options) {
  std::vector<float> arguments;
  for (const std::vector<float>& row : rows) arguments.insert(arguments.end(), row.begin(), row.end());
  arguments.insert(arguments.end(), appendix.begin(), appendix.end());
  gpu::Buffer in = gpu::Buffer::from(device, arguments);
  gpu::Buffer out(device, rows.size() * stride * sizeof(float));
  gpu::SpecializationConstants constants = options.constants;
  constants[kFunctionId] = number;
  constants[kRoughId] = options.rough ? 1 : 0;
  const gpu::ComputePipeline pipeline(device, spirv, {gpu::Binding::storage, gpu::Binding::storage},
                                      sizeof(Push), constants);
  const Push push{static_cast<std::uint32_t>(rows.size()), static_cast<std::uint32_t>(rows[0].size()),
                  static_cast<std::uint32_t>(stride)};
  Report report;
  gpu::Commands commands(device);
  commands.dispatch("call", pipeline, {in, out}, push, {gpu::groups_for(rows.size(), 64), 1, 1});
  commands.submit(report);
  return out.download<float>(rows.size() * stride);
}

}  // namespace vsgl::test
