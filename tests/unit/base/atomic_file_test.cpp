#include "base/atomic_file.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "folder_test.h"

namespace vsgl {
namespace {

using Names = std::set<std::string>;
using Atomic = test::FolderTest;

TEST_F(Atomic, CommitMovesEveryOutputIntoPlace) {
  OutputSet outputs(false);
  write_text(outputs.add(path("a.exr")), "A");
  write_text(outputs.add(path("b.json")), "B");
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  outputs.commit();
  EXPECT_EQ(listing(), (Names{"a.exr", "b.json"}));
  EXPECT_EQ(read("a.exr"), "A");
  EXPECT_EQ(outputs.targets(), (std::vector<std::filesystem::path>{path("a.exr"), path("b.json")}));
}

TEST_F(Atomic, TheTemporaryFileKeepsFolderAndExtension) {
  OutputSet outputs(false);
  const auto temporary = outputs.add(path("map.exr"));
  EXPECT_EQ(temporary.parent_path(), path("map.exr").parent_path());
  EXPECT_EQ(temporary.extension(), ".exr");
}

TEST_F(Atomic, WithoutCommitNothingIsLeftAndTheOldFileIsUnharmed) {
  write("a.exr", "old");
  {
    OutputSet outputs(true);
    write_text(outputs.add(path("a.exr")), "new");
    write_text(outputs.add(path("b.exr")), "new");
  }
  EXPECT_EQ(listing(), Names{"a.exr"});
  EXPECT_EQ(read("a.exr"), "old");
}

TEST_F(Atomic, CommitReplacesTheOldFileWithOverwrite) {
  write("a.exr", "old");
  OutputSet outputs(true);
  write_text(outputs.add(path("a.exr")), "new");
  outputs.commit();
  EXPECT_EQ(read("a.exr"), "new");
}

TEST_F(Atomic, RefusesAnExistingFileWithoutOverwrite) {
  write("a.exr", "old");
  OutputSet outputs(false);
  test::expect_error(ErrorCode::output_exists, "--overwrite", [&] { outputs.add(path("a.exr")); });
  EXPECT_EQ(listing(), Names{"a.exr"});
}

TEST_F(Atomic, RefusesAFileThatAppearedDuringTheRun) {
  {
    OutputSet outputs(false);
    write_text(outputs.add(path("a.exr")), "new");
    write("a.exr", "of another process");
    test::expect_error(ErrorCode::output_exists, "a.exr", [&] { outputs.commit(); });
  }
  EXPECT_EQ(listing(), Names{"a.exr"});
  EXPECT_EQ(read("a.exr"), "of another process");
}

TEST_F(Atomic, RefusesMissingFoldersAndSpecialFiles) {
  OutputSet outputs(true);
  test::expect_error(ErrorCode::write_failed, "does not exist", [&] { outputs.add(path("none/a.exr")); });
  test::expect_error(ErrorCode::write_failed, "no regular file", [&] { outputs.add("/dev/null"); });
  test::expect_error(ErrorCode::write_failed, "no regular file",
                     [&] { outputs.add(path("").parent_path()); });
  test::expect_error(ErrorCode::write_failed, "name a file", [&] { outputs.add(path("")); });
}

TEST_F(Atomic, RefusesAFolderWithoutWritePermission) {
  using std::filesystem::perms;
  const perms readable = perms::owner_read | perms::owner_exec | perms::group_read | perms::group_exec;
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path(""), readable | perms::owner_write);
  std::filesystem::permissions(path("locked"), readable);
  // In a process of its own that is not root, who may write everywhere.
  const auto check = [&] {
    constexpr uid_t nobody = 65534;
    if (geteuid() == 0 && setuid(nobody) != 0) std::_Exit(3);
    try {
      OutputSet::check(path("locked/a.exr"), false);
    } catch (const Error& error) {
      const bool says_why = std::string(error.what()).find("cannot be written") != std::string::npos;
      std::_Exit(error.code() == ErrorCode::write_failed && says_why ? 0 : 1);
    }
    std::_Exit(2);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Atomic, AnAnnouncedOutputMustBeWritten) {
  {
    OutputSet outputs(false);
    outputs.add(path("a.exr"));
    test::expect_error(ErrorCode::internal, "never written", [&] { outputs.commit(); });
  }
  EXPECT_EQ(listing(), Names{});
}

TEST_F(Atomic, AFailedRenameLeavesNoTemporary) {
  {
    OutputSet outputs(true);
    write_text(outputs.add(path("a.exr")), "A");
    std::filesystem::create_directory(path("a.exr"));
    test::expect_error(ErrorCode::write_failed, "a.exr", [&] { outputs.commit(); });
  }
  EXPECT_EQ(listing(), Names{"a.exr"});
}

class AtomicSignal : public test::FolderTest, public ::testing::WithParamInterface<int> {};

TEST_P(AtomicSignal, RemovesTheTemporariesAndEndsWithItsStatus) {
  write("old.exr", "old");
  const pid_t child = fork();
  if (child == 0) {
    signal(GetParam(), SIG_DFL);
    OutputSet::remove_on_signals();
    OutputSet outputs(true);
    write_text(outputs.add(path("old.exr")), "new");
    write_text(outputs.add(path("b.exr")), "new");
    raise(GetParam());
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + GetParam());
  EXPECT_EQ(listing(), Names{"old.exr"});
  EXPECT_EQ(read("old.exr"), "old");
}

INSTANTIATE_TEST_SUITE_P(Signals, AtomicSignal, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

using Text = test::FolderTest;

TEST_F(Text, RoundTrips) {
  const std::string text("a\0b\n\xff", 5);
  write_text(path("t"), text);
  EXPECT_EQ(read_text(path("t")), text);
}

TEST_F(Text, ReportsFailures) {
  test::expect_error(ErrorCode::file_not_found, "none", [&] { read_text(path("none")); });
  test::expect_error(ErrorCode::read_failed, "reading failed", [&] { read_text(path("")); });
  test::expect_error(ErrorCode::write_failed, "writing failed", [&] { write_text("/dev/full", "text"); });
}

}  // namespace
}  // namespace vsgl
