#include "gpu/raster.h"

#include <gtest/gtest.h>

#include "../expect_error.h"
#include "gpu/environment.h"
#include "interop/interop.h"
#include "spirv/test/layers.frag.glsl.h"
#include "spirv/test/layers.vert.glsl.h"

namespace vsgl::gpu {
namespace {

using test::expect_error;

constexpr std::uint32_t kWidth = 40, kHeight = 24;
const std::vector<VkFormat> kFormats{VK_FORMAT_R32_UINT, VK_FORMAT_R32G32B32A32_SFLOAT};

struct Drawn {
  std::vector<std::uint32_t> index;
  std::vector<interop::vec4> place;
};

Drawn draw(Device& device, std::array<float, 4> depths, std::uint32_t vertices) {
  RasterTarget target(device, kWidth, kHeight, kFormats);
  RasterPipeline pipeline(device, layers_vert_spv, layers_frag_spv, kFormats, sizeof(depths));
  pipeline.draw(target, vertices, std::as_bytes(std::span(depths)));
  Buffer index(device, kWidth * kHeight * sizeof(std::uint32_t));
  Buffer place(device, kWidth * kHeight * sizeof(interop::vec4));
  target.read(0, index);
  target.read(1, place);
  return {index.download<std::uint32_t>(kWidth * kHeight), place.download<interop::vec4>(kWidth * kHeight)};
}

TEST(Raster, NearestWinsAndRowsStartAtTheTop) {
  Device device({});
  const Drawn drawn = draw(device, {0.25f, 0.75f, 0.5f, 0}, 9);
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float below = (static_cast<float>(y) + 0.5f) / kHeight - (static_cast<float>(x) + 0.5f) / kWidth;
      if (std::abs(below) < 1e-3f) continue;  // on the edge
      const std::size_t i = y * kWidth + x;
      ASSERT_EQ(drawn.index[i], below > 0 ? 2u : 0u) << x << "," << y;
      ASSERT_EQ(drawn.place[i].x, below > 0 ? static_cast<float>(x) + 0.5f : 0);
      ASSERT_EQ(drawn.place[i].y, below > 0 ? static_cast<float>(y) + 0.5f : 0);
      ASSERT_EQ(drawn.place[i].z, below > 0 ? 0.75f : 0);
    }
  }
}

TEST(Raster, OfEqualDepthsTheFirstWins) {
  Device device({});
  EXPECT_EQ(draw(device, {0.5f, 0.5f, 0.5f, 0}, 9).index[(kHeight - 1) * kWidth], 1u);
}

TEST(Raster, DrawingNothingClears) {
  Device device({});
  EXPECT_EQ(draw(device, {}, 0).index, std::vector<std::uint32_t>(kWidth * kHeight, 0u));
}

TEST(Raster, ATargetIsClearedBeforeEachDraw) {
  Device device({});
  RasterTarget target(device, kWidth, kHeight, kFormats);
  RasterPipeline pipeline(device, layers_vert_spv, layers_frag_spv, kFormats, 16);
  Buffer index(device, kWidth * kHeight * sizeof(std::uint32_t));
  for (const std::uint32_t expected : {3u, 1u}) {  // the second draw is farther away than the first
    const std::array<float, 4> depths{0.1f, 0.2f, 0.3f, 0};
    pipeline.draw(target, 3 * expected, std::as_bytes(std::span(depths)));
    target.read(0, index);
    EXPECT_EQ(index.download<std::uint32_t>(kWidth * kHeight)[(kHeight - 1) * kWidth], expected);
  }
}

TEST(Raster, WrongUseIsAnError) {
  Device device({});
  RasterTarget target(device, 4, 4, {VK_FORMAT_R32_UINT});
  RasterPipeline pipeline(device, layers_vert_spv, layers_frag_spv, kFormats, 16);
  const std::array<float, 4> depths{};
  expect_error(ErrorCode::internal, {"attachments"},
               [&] { pipeline.draw(target, 9, std::as_bytes(std::span(depths))); });
}

TEST(Raster, ImagesBeyondTheLimitAreRefused) {
  Device device({});
  const std::uint32_t beyond = device.limits().maxImageDimension2D + 1;
  expect_error(ErrorCode::device_limit, {std::to_string(beyond)},
               [&] { RasterTarget(device, beyond, 1, kFormats); });
}

// lavapipe crashes when it draws 512 bits wide.
TEST(Raster, WideDevicesAreRefused) {
  ScopedEnvironment user;
  user.set("LP_NATIVE_VECTOR_WIDTH", "512");
  Device device({});
  if (device.info().vector_bits <= 256) GTEST_SKIP() << "the CPU has no 512-bit vectors";
  expect_error(ErrorCode::device_limit, {"LP_NATIVE_VECTOR_WIDTH"},
               [&] { RasterTarget(device, 4, 4, kFormats); });
}

}  // namespace
}  // namespace vsgl::gpu
