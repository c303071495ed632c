#pragma once

#include <fstream>
#include <set>
#include <sstream>

#include "../expect_error.h"

namespace vsgl::test {

// Tests in a folder of their own each.
class FolderTest : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  // Names of everything in the folder, hidden files included.
  std::set<std::string> listing() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
      names.insert(entry.path().filename());
    return names;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace vsgl::test
