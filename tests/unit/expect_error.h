#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"

namespace vsgl::test {

// Runs `action` and expects an Error of that number whose message holds every one of `fragments`.
template <typename Action>
void expect_error(ErrorCode code, const std::vector<std::string>& fragments, Action action) {
  try {
    action();
    ADD_FAILURE() << "no error; expected E" << static_cast<int>(code);
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    for (const std::string& fragment : fragments)
      EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos)
          << "'" << fragment << "' is not in: " << error.what();
  }
}

// The same with one fragment.
template <std::size_t N, typename Action>
void expect_error(ErrorCode code, const char (&fragment)[N], Action action) {
  expect_error(code, std::vector<std::string>{fragment}, action);
}

// A folder of its own for a test's files, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "vsgl-test-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("mkdtemp failed");
    path_ = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace vsgl::test
