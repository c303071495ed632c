#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vsgl {

// The outputs of one run, written whole or not at all: each is written to a temporary file in the same
// folder; commit() flushes all to disk and renames them. Destroyed without commit(), nothing is left and no
// old file is harmed.
class OutputSet {
 public:
  // With `overwrite` false, add() throws output_exists when the target is there already.
  explicit OutputSet(bool overwrite) : overwrite_(overwrite) {}
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  // Announces an output; returns the path of the temporary file to write (same extension). Throws
  // write_failed when the folder does not exist or cannot be written, or when the target is there and is no
  // regular file.
  std::filesystem::path add(const std::filesystem::path& target);
  // fsync and rename all. Throws write_failed; then every temporary file is removed. An output that was
  // announced and left empty is an internal error.
  void commit();
  // All outputs, in the order of add().
  std::vector<std::filesystem::path> targets() const;

  // The checks of add(), without creating anything.
  static void check(const std::filesystem::path& target, bool overwrite);
  // From now on SIGINT, SIGTERM and SIGHUP remove every temporary file of the process and end it with status
  // 128 + signal.
  static void remove_on_signals();

 private:
  struct Entry {
    std::filesystem::path target, temporary;
  };
  bool overwrite_;
  bool committed_ = false;
  std::vector<Entry> entries_;
};

// Writes `text` to `path` (a temporary path of an OutputSet). Throws write_failed.
void write_text(const std::filesystem::path& path, const std::string& text);
// Reads a whole file. Throws file_not_found or read_failed.
std::string read_text(const std::filesystem::path& path);

}  // namespace vsgl
