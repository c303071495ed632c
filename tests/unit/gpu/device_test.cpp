#include "gpu/device.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "gpu/environment.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {
namespace {

TEST(Device, AutoTakesTheCpu) {
  const Device device({});
  EXPECT_EQ(device.info().type, "cpu");
  EXPECT_NE(device.info().name.find("llvmpipe"), std::string::npos);
  EXPECT_GT(device.info().vector_bits, 0);
  EXPECT_GT(device.info().subgroup_size, 0u);
  EXPECT_EQ(device.timestamp_period(), 0);
}

TEST(Device, PartOfANameChooses) {
  const Device device({.device = "llvmpipe"});
  EXPECT_EQ(device.info().type, "cpu");
}

TEST(Device, AnUnknownNameListsWhatIsThere) {
  try {
    const Device device({.device = "no-such-device"});
    FAIL() << "a device that does not exist was opened";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::no_device);
    EXPECT_NE(std::string(error.what()).find("no-such-device"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("llvmpipe"), std::string::npos) << error.what();
  }
}

TEST(Device, AnEmptyNameMatchesNothing) {
  EXPECT_THROW(Device({.device = ""}), Error);
}

TEST(Device, ComputeOnlyIsWideWhereTheCpuAllowsIt) {
  const Device device({.compute_only = true});
#if defined(__x86_64__)
  if (std::getenv("LP_NATIVE_VECTOR_WIDTH") == nullptr && __builtin_cpu_supports("avx512f")) {
    EXPECT_EQ(device.info().vector_bits, 512);
    return;
  }
#endif
  EXPECT_GT(device.info().vector_bits, 0);
}

TEST(Device, LeavesTheEnvironmentAsItWas) {
  { const Device device({.threads = 1, .compute_only = true}); }
  EXPECT_EQ(std::getenv("LP_NUM_THREADS"), nullptr);
  EXPECT_EQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), nullptr);
}

TEST(Device, TheUsersVectorWidthWins) {
  ScopedEnvironment user;
  user.set("LP_NATIVE_VECTOR_WIDTH", "128");
  const Device device({.compute_only = true});
  EXPECT_EQ(device.info().vector_bits, 128);
}

TEST(ScopedEnvironment, RestoresOldValues) {
  setenv("VSGL_TEST_VARIABLE", "old", 1);
  {
    ScopedEnvironment environment;
    environment.set("VSGL_TEST_VARIABLE", "new");
    environment.set("VSGL_TEST_VARIABLE", "newer");
    EXPECT_STREQ(std::getenv("VSGL_TEST_VARIABLE"), "newer");
  }
  EXPECT_STREQ(std::getenv("VSGL_TEST_VARIABLE"), "old");
  unsetenv("VSGL_TEST_VARIABLE");
}

TEST(DeviceDeathTest, AValidationMessageEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        setenv("VSGL_VALIDATION", "1", 1);
        const Device device({});
        const auto fence = vk_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        VkFence leaked = VK_NULL_HANDLE;
        check(vkCreateFence(device.handle(), &fence, nullptr, &leaked), "vkCreateFence");
      },
      "validation: .*[Ff]ence");
}

TEST(Check, NamesTheCall) {
  try {
    check(VK_ERROR_DEVICE_LOST, "vkSomething");
    FAIL() << "a failed call was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::device_lost);
    EXPECT_NE(std::string(error.what()).find("vkSomething"), std::string::npos);
  }
}

}  // namespace
}  // namespace vsgl::gpu
