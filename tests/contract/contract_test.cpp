// What every method of every stage owes its users.

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>

#include "../unit/expect_error.h"
#include "base/atomic_file.h"
#include "base/hash.h"
#include "candidates.h"

namespace vsgl::test {
namespace {

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

// Lower-case letters and digits only: names of parametrised tests.
std::string test_name(const testing::TestParamInfo<Candidate>& info) {
  std::string name = info.param.stage + "_" + info.param.method;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

class Method : public testing::TestWithParam<Candidate> {
 protected:
  // SHA-256 of the artifact that a run with so many threads writes.
  std::string hash_with(int threads) {
    const std::string name = std::to_string(runs_++) + ".exr";
    omp_set_num_threads(threads);
    gpu::Device own({.threads = threads, .compute_only = true});
    GetParam().run(own, folder_ / name);
    return sha256_file(folder_ / name);
  }

  TemporaryFolder folder_;
  int runs_ = 0;
};

TEST_P(Method, GivesTheSameBytesInEveryRunOnAnyThreadCount) {
  const std::string first = hash_with(1);
  EXPECT_EQ(first, hash_with(1)) << "second run";
  EXPECT_EQ(first, hash_with(2)) << "two threads";
}

// Writing refuses values that are not finite; reading checks every documented range.
TEST_P(Method, GivesASoundArtifact) {
  GetParam().run(device(), folder_ / "artifact.exr");
  GetParam().check(device(), folder_ / "artifact.exr");
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 4096> block;
  for (std::size_t n; (n = fread(block.data(), 1, block.size(), pipe.get())) > 0;)
    text.append(block.data(), n);
  return text;
}

TEST_P(Method, IsListedByItsTool) {
  const std::string list = "\n" + output_of(std::string(VSGL_BIN "/") + GetParam().tool + " --list-methods");
  EXPECT_EQ(list.find("\n" + GetParam().method + " ") != std::string::npos, GetParam().is_listed) << list;
  const std::string help = output_of(std::string(VSGL_BIN "/") + GetParam().tool + " --help");
  EXPECT_NE(help.find(GetParam().method), std::string::npos) << help;
}

TEST_P(Method, IsDocumented) {
  for (const auto& entry : std::filesystem::directory_iterator(VSGL_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md" &&
        read_text(entry.path()).find("`" + GetParam().method + "`") != std::string::npos)
      return;
  ADD_FAILURE() << "no document in docs/ mentions `" << GetParam().method << "`";
}

INSTANTIATE_TEST_SUITE_P(Contract, Method, testing::ValuesIn(candidates()), test_name);

TEST(Stages, HaveMethods) {
  for (const Stage& stage : stages()) {
    const auto rows = std::count_if(candidates().begin(), candidates().end(),
                                    [&](const Candidate& c) { return c.stage == stage.name; });
    EXPECT_GT(rows, 0) << stage.name;
  }
}

TEST(Stages, RefuseUnknownMethods) {
  for (const Stage& stage : stages()) {
    SCOPED_TRACE(stage.name);
    expect_error(ErrorCode::bad_value, {"no-such-method", "none of"},
                 [&] { stage.run(device(), "no-such-method"); });
  }
}

}  // namespace
}  // namespace vsgl::test
