#include "base/frame_name.h"

#include <gtest/gtest.h>

namespace vsgl::test {
namespace {

TEST(FrameName, MarksBecomeNumbers) {
  EXPECT_EQ(frame_path("out/image.%04d.exr", 12), "out/image.0012.exr");
  EXPECT_EQ(frame_path("%03d/a%02d-%01d.exr", 7), "%03d/a07-7.exr");  // in the file's name only
  EXPECT_EQ(frame_path("a%04d.exr", 123456), "a123456.exr");
  EXPECT_EQ(frame_path("a.exr", 3), "a.exr");
  EXPECT_TRUE(names_frames("a%04d.exr"));
  for (const char* name : {"a.exr", "a%d.exr", "a%4d.exr", "a%00d.exr", "a%010d.exr", "%04d/a.exr"})
    EXPECT_FALSE(names_frames(name)) << name;
}

}  // namespace
}  // namespace vsgl::test
