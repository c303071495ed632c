#include "shader_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

#include "library_dispatch.h"

namespace vsgl::test {

namespace {

std::string describe(const Row& row) {
  std::ostringstream text;
  text.precision(9);
  for (const float x : row) text << x << " ";
  return text.str();
}

// In units of what is allowed; infinite if either is not finite.
double error_of(float result, const Values::Value& twin, const Tolerance& tolerance) {
  if (twin.exact) return std::bit_cast<std::uint32_t>(result) == twin.value ? 0 : 2;
  const double difference = std::abs(static_cast<double>(result) - twin.value);
  if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
  return difference == 0 ? 0 : difference / (tolerance.relative * twin.scale + tolerance.absolute);
}

// Reports the worst value of a call only.
void compare_call(gpu::Device& device, const LibraryFile& file, std::uint32_t number, bool rough) {
  const auto dispatch = [&](const std::vector<Row>& rows, std::size_t stride) {
    return call_on_device(device, file.spirv, number, rows, stride, file.appendix, {.rough = rough});
  };
  const LibraryCall& call = file.calls[number];
  ASSERT_FALSE(call.rows.empty()) << call.name;
  std::vector<Values> expected;
  for (const Row& row : call.rows) {
    ASSERT_EQ(row.size(), call.rows[0].size()) << call.name;
    Arguments arguments{row};
    expected.push_back(call.twin(arguments));
  }
  const std::size_t stride = expected[0].size();
  const std::vector<float> results = dispatch(call.rows, stride);
  double worst = 0;
  std::string where;
  for (std::size_t i = 0; i < call.rows.size(); ++i)
    for (std::size_t j = 0; j < stride; ++j) {
      const double error = error_of(results[i * stride + j], expected[i][j], call.tolerance);
      if (error <= worst) continue;
      worst = error;
      std::ostringstream text;
      text.precision(9);
      text << "value " << j << " is " << results[i * stride + j] << ", twin " << expected[i][j].value
           << ", of " << describe(call.rows[i]);
      where = text.str();
    }
  EXPECT_LE(worst, 1) << file.name << ": " << call.name << ": " << where;
  if (call.wild.empty()) return;
  const std::vector<float> wild = dispatch(call.wild, stride);
  const auto bad = std::find_if_not(wild.begin(), wild.end(), [](float x) { return std::isfinite(x); });
  if (bad != wild.end())
    ADD_FAILURE() << call.name << ": not finite, of "
                  << describe(call.wild[static_cast<std::size_t>(bad - wild.begin()) / stride]);
}

class ShaderLibrary : public testing::TestWithParam<LibraryFile> {};

TEST_P(ShaderLibrary, MatchesItsTwin) {
  gpu::Device device = make_test_device();
  for (std::uint32_t i = 0; i < GetParam().calls.size(); ++i) compare_call(device, GetParam(), i, false);
}

// The tolerances are those of any device that keeps Vulkan's promises, not of this one.
TEST_P(ShaderLibrary, MatchesItsTwinOnARoughDevice) {
  gpu::Device device = make_test_device();
  for (std::uint32_t i = 0; i < GetParam().calls.size(); ++i) compare_call(device, GetParam(), i, true);
}

INSTANTIATE_TEST_SUITE_P(Files, ShaderLibrary, testing::ValuesIn(library_files()),
                         [](const auto& file) { return file.param.name; });

std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path);
  EXPECT_TRUE(stream) << path;
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(ShaderLibraryCoverage, EveryFunctionIsDispatched) {
  const std::filesystem::path shaders = std::filesystem::path(VSGL_SOURCE_DIR) / "shaders";
  std::map<std::string, std::size_t> calls;
  for (const LibraryFile& file : library_files()) calls[file.name] = file.calls.size();
  std::size_t functions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shaders / "lib")) {
    const std::string name = entry.path().stem().string();
    const std::vector<std::string> defined = matches(read(entry.path()), R"((?:^|\n)\w+ (\w+)\([^;{]*\) \{)");
    if (defined.empty()) continue;
    functions += defined.size();
    ASSERT_TRUE(calls.contains(name)) << "shaders/lib/" << name << ".glsl has no test";
    const std::string test = read(shaders / "test" / "library" / (name + ".comp.glsl"));
    for (const std::string& function : defined)
      EXPECT_TRUE(std::regex_search(test, std::regex("\\b" + function + "\\(")))
          << function << " is never called";
    EXPECT_EQ(std::max<std::size_t>(matches(test, R"((case) \d+u:)").size(), 1), calls[name]) << name;
  }
  EXPECT_GT(functions, 50u);
}

}  // namespace
}  // namespace vsgl::test
