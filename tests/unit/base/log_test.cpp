#include "base/log.h"

#include <gtest/gtest.h>

namespace vsgl {
namespace {

std::string messages_at(int level) {
  ::testing::internal::CaptureStderr();
  set_log("shade", level);
  log_warning("W");
  log_info("I");
  log_debug("D");
  set_log("vsgltools", 0);
  return ::testing::internal::GetCapturedStderr();
}

TEST(Log, LevelsChooseTheMessages) {
  EXPECT_EQ(messages_at(-1), "");
  EXPECT_EQ(messages_at(0), "shade: warning: W\n");
  EXPECT_EQ(messages_at(1), "shade: warning: W\nshade: I\n");
  EXPECT_EQ(messages_at(2), "shade: warning: W\nshade: I\nshade: debug: D\n");
}

TEST(Log, NoProgressBarOutsideATerminal) {
  ::testing::internal::CaptureStderr();  // a file
  set_progress(true);
  {
    Progress progress("points", 10);
    for (std::size_t i = 0; i <= 10; ++i) progress.step(i);
  }
  set_progress(false);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace vsgl
