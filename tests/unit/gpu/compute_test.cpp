#include "gpu/compute.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <numeric>

#include "base/error.h"
#include "interop/interop.h"
#include "spirv/test/affine.comp.glsl.h"
#include "spirv/test/gather.comp.glsl.h"

namespace vsgl::gpu {
namespace {

struct AffinePush {
  float scale;
  std::uint32_t count;
};

ComputePipeline affine(Device& device, float offset) {
  return ComputePipeline(device, affine_comp_spv, {Binding::storage, Binding::storage}, sizeof(AffinePush),
                         {{0, std::bit_cast<std::uint32_t>(offset)}});
}

std::vector<float> ramp(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  return values;
}

ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Buffer, ReturnsWhatWasWritten) {
  Device device({});
  const std::vector<float> values = ramp(1000);
  Buffer buffer = Buffer::from(device, values);
  EXPECT_EQ(buffer.download<float>(1000), values);
  const std::array<float, 2> patch{-1, -2};
  buffer.write(8, std::as_bytes(std::span(patch)));
  EXPECT_EQ(buffer.download<float>(5), (std::vector<float>{0, 1, -1, -2, 4}));
  buffer.clear();
  EXPECT_EQ(buffer.download<float>(1000), std::vector<float>(1000, 0.0f));
}

TEST(Buffer, MovesAndEmptyBuffers) {
  Device device({});
  Buffer first = Buffer::from(device, ramp(4));
  Buffer second = std::move(first);
  EXPECT_EQ(second.download<float>(4), ramp(4));
  second = Buffer(device, 0);
  EXPECT_EQ(second.size(), 16u);
}

TEST(Buffer, AccessPastTheEndIsAnError) {
  Device device({});
  Buffer buffer(device, 64);
  EXPECT_EQ(code_of([&] { buffer.download<float>(17); }), ErrorCode::internal);
}

TEST(Buffer, TooLargeIsAMemoryError) {
  Device device({});
  EXPECT_EQ(code_of([&] { Buffer(device, device.max_allocation() + 4); }), ErrorCode::memory);
}

TEST(Commands, DispatchWithConstantsAndPush) {
  Device device({});
  constexpr std::uint32_t kCount = 1000;
  Buffer values = Buffer::from(device, ramp(kCount));
  Buffer results(device, kCount * sizeof(float));
  const ComputePipeline pipeline = affine(device, 0.5f);
  Report report;
  Commands commands(device);
  commands.dispatch("affine", pipeline, {values, results}, AffinePush{3, kCount},
                    {groups_for(kCount, 64), 1, 1});
  commands.submit(report);
  const std::vector<float> out = results.download<float>(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(out[i], 3 * static_cast<float>(i) + 0.5f) << i;
  const auto phases = report.to_json().dump();
  EXPECT_NE(phases.find("affine"), std::string::npos) << "no device time was reported: " << phases;
}

TEST(Commands, EachDispatchSeesTheOnesBefore) {
  Device device({});
  constexpr std::uint32_t kCount = 1 << 16;
  Buffer a = Buffer::from(device, std::vector<float>(kCount, 1.0f));
  Buffer b(device, kCount * sizeof(float));
  const ComputePipeline pipeline = affine(device, 1);
  Report report;
  Commands commands(device);
  for (int i = 0; i < 10; ++i) {  // x -> x + 2 per round
    commands.dispatch("there", pipeline, {a, b}, AffinePush{1, kCount}, {groups_for(kCount, 64), 1, 1});
    commands.dispatch("back", pipeline, {b, a}, AffinePush{1, kCount}, {groups_for(kCount, 64), 1, 1});
  }
  commands.submit(report);
  EXPECT_EQ(a.download<float>(kCount), std::vector<float>(kCount, 21.0f));
  commands.dispatch("again", pipeline, {a, b}, AffinePush{1, kCount}, {groups_for(kCount, 64), 1, 1});
  commands.submit(report);
  EXPECT_EQ(b.download<float>(kCount), std::vector<float>(kCount, 22.0f));
}

TEST(Commands, MoreTimestampsThanOnePoolHolds) {
  Device device({});
  Buffer a = Buffer::from(device, std::vector<float>(64, 0.0f));
  const ComputePipeline pipeline = affine(device, 0);
  Report report;
  Commands commands(device);
  for (int i = 0; i < 600; ++i) {
    commands.dispatch(i % 2 == 0 ? "even" : "odd", pipeline, {a, a}, AffinePush{1, 64}, {1, 1, 1});
  }
  commands.submit(report);
  EXPECT_NE(report.to_json().dump().find("odd"), std::string::npos);
}

TEST(Commands, RangesOfABuffer) {
  Device device({});
  Buffer values = Buffer::from(device, ramp(256));
  Buffer results(device, 256 * sizeof(float));
  results.clear();
  const ComputePipeline pipeline = affine(device, 0);
  Report report;
  Commands commands(device);
  commands.dispatch("affine", pipeline, {{values, 256, 256}, {results, 512, 256}}, AffinePush{1, 64},
                    {1, 1, 1});
  commands.submit(report);
  const std::vector<float> out = results.download<float>(256);
  EXPECT_EQ(out[127], 0);
  EXPECT_EQ(out[128], 64);
  EXPECT_EQ(out[191], 127);
  EXPECT_EQ(out[192], 0);
}

TEST(Commands, UniformAndTexelBuffers) {
  Device device({});
  const std::vector<interop::vec4> texels{{1, 2, 3, 4}, {5, 6, 7, 8}, {0, 0, 0, 1}};
  Buffer texel_buffer = Buffer::from(device, texels);
  Buffer indices = Buffer::from(device, std::vector<std::uint32_t>{2, 0, 1, 1});
  Buffer weights = Buffer::from(device, std::vector<float>{1, 10, 100, 1000});
  Buffer sums(device, 4 * sizeof(float));
  const ComputePipeline pipeline(
      device, gather_comp_spv,
      {Binding::texel_rgba32f, Binding::texel_r32ui, Binding::uniform, Binding::storage});
  Report report;
  Commands commands(device);
  commands.dispatch("gather", pipeline, {texel_buffer, indices, weights, sums}, {}, {1, 1, 1});
  commands.submit(report);
  EXPECT_EQ(sums.download<float>(4), (std::vector<float>{1000, 4321, 8765, 8765}));
}

TEST(Commands, WrongUseIsAnError) {
  Device device({});
  Buffer buffer(device, 64);
  const ComputePipeline pipeline = affine(device, 0);
  Commands commands(device);
  const AffinePush push{1, 1};
  EXPECT_EQ(code_of([&] {
              commands.dispatch("x", pipeline, {buffer}, push, {1, 1, 1});
            }),
            ErrorCode::internal);
  EXPECT_EQ(code_of([&] {
              commands.dispatch("x", pipeline, {buffer, buffer}, 1.0f, {1, 1, 1});
            }),
            ErrorCode::internal);
  EXPECT_EQ(code_of([&] {
              commands.dispatch("x", pipeline, {buffer, {buffer, 32, 64}}, push, {1, 1, 1});
            }),
            ErrorCode::internal);
  EXPECT_EQ(code_of([&] {
              commands.dispatch("x", pipeline, {buffer, buffer}, push, {1u << 20, 1, 1});
            }),
            ErrorCode::device_limit);
  Buffer large(device, device.limits().maxStorageBufferRange + 16);
  EXPECT_EQ(code_of([&] {
              commands.dispatch("x", pipeline, {large, buffer}, push, {1, 1, 1});
            }),
            ErrorCode::device_limit);
}

TEST(Commands, SameBytesOnAnyThreadCountAndWidth) {
  constexpr std::uint32_t kCount = 1 << 18;
  std::vector<std::vector<float>> outputs;
  for (const DeviceOptions& options :
       {DeviceOptions{.threads = 1}, DeviceOptions{.threads = 2}, DeviceOptions{.compute_only = true}}) {
    Device device(options);
    std::vector<float> values = ramp(kCount);
    for (float& value : values) value = 0.1f + value * 1.7e-3f;
    Buffer in = Buffer::from(device, values);
    Buffer out(device, kCount * sizeof(float));
    const ComputePipeline pipeline = affine(device, 0.3f);
    Report report;
    Commands commands(device);
    commands.dispatch("affine", pipeline, {in, out}, AffinePush{0.7f, kCount},
                      {groups_for(kCount, 64), 1, 1});
    commands.submit(report);
    outputs.push_back(out.download<float>(kCount));
  }
  EXPECT_EQ(outputs[0], outputs[1]);
  EXPECT_EQ(outputs[0], outputs[2]);
}

TEST(ComputePipeline, IsBuiltOncePerShaderAndConstants) {
  Device device({});
  const ComputePipeline first = affine(device, 1);
  EXPECT_EQ(device.pipelines_built(), 1u);
  const ComputePipeline same = affine(device, 1);
  EXPECT_EQ(device.pipelines_built(), 1u);
  const ComputePipeline other = affine(device, 2);
  EXPECT_EQ(device.pipelines_built(), 2u);
  const ComputePipeline without(device, affine_comp_spv, {Binding::storage, Binding::storage},
                                sizeof(AffinePush));
  EXPECT_EQ(device.pipelines_built(), 3u);

  Buffer values = Buffer::from(device, ramp(4)), results(device, 16);
  const auto run = [&](const ComputePipeline& pipeline) {
    Report report;
    Commands commands(device);
    commands.dispatch("affine", pipeline, {values, results}, AffinePush{1, 4}, {1, 1, 1});
    commands.submit(report);
    return results.download<float>(4);
  };
  EXPECT_EQ(run(same), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(run(other), (std::vector<float>{2, 3, 4, 5}));
  EXPECT_EQ(run(without), ramp(4));
}

TEST(Commands, TimeEachLabelOnTheDevice) {
  Device device({});
  const ComputePipeline pipeline = affine(device, 0);
  constexpr std::uint32_t kCount = 1 << 21;
  Buffer values = Buffer::from(device, ramp(kCount)), results(device, kCount * sizeof(float));
  Report report;
  const auto start = std::chrono::steady_clock::now();
  Commands commands(device);
  for (const char* label : {"small", "large"}) {
    const std::uint32_t count = label[0] == 's' ? 64 : kCount;
    for (int k = 0; k < 20; ++k)
      commands.dispatch(label, pipeline, {values, results}, AffinePush{1, count},
                        {groups_for(count, 64), 1, 1});
  }
  commands.submit(report);
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto phases = report.to_json()["phases"];
  ASSERT_EQ(phases.size(), 2u);
  const double small = phases[0]["device_s"], large = phases[1]["device_s"];
  EXPECT_GT(small, 0);
  EXPECT_GT(large, 5 * small);
  EXPECT_GT(small + large, elapsed / 2);  // waiting is most of it
  EXPECT_LE(small + large, elapsed);
}

TEST(Commands, CountTheDispatchesOfEachLabel) {
  Device device({});
  const ComputePipeline pipeline = affine(device, 0);
  Buffer values = Buffer::from(device, ramp(64)), results(device, 64 * sizeof(float));
  Report report;
  for (int run = 0; run < 2; ++run) {
    Commands commands(device);
    for (const char* label : {"one", "two", "two", "one"})
      commands.dispatch(label, pipeline, {values, results}, AffinePush{1, 64}, {1, 1, 1});
    commands.submit(report);
  }
  EXPECT_EQ(report.to_json()["counts"].dump(), R"({"dispatches":{"one":4,"two":4}})");
}

}  // namespace
}  // namespace vsgl::gpu
