#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vsgl {

// What a run with --if-changed remembers for the next one: what it was made of and what it made. Lies beside
// its first output, ".lights.exr.run.json" beside lights.exr.
struct RunRecord {
  struct File {
    std::filesystem::path path;  // relative to the record's folder
    std::string sha256;
  };
  std::string tool;
  std::string program;         // SHA-256 of the executable
  std::string command_line;    // what shapes the result and names the outputs
  int status = 0;              // exit status: a verdict is repeated
  std::vector<File> inputs{};  // those of the command line first, then the files that these refer to
  std::vector<File> outputs{};

  // `file`: of the record.
  bool starts_with_inputs(const std::vector<std::filesystem::path>& inputs,
                          const std::filesystem::path& file) const;
  bool holds(const std::filesystem::path& file) const;  // all inputs and outputs are as recorded
  std::vector<std::filesystem::path> output_paths() const;
};

std::filesystem::path record_path(const std::filesystem::path& output);
// `path` relative to the folder of the record `file`.
std::filesystem::path path_in_record(const std::filesystem::path& path, const std::filesystem::path& file);
// None where there is no record, or one that cannot be read: then the tool must run.
std::optional<RunRecord> read_record(const std::filesystem::path& path);
// Throws write_failed.
void write_record(const std::filesystem::path& path, const RunRecord& record);

}  // namespace vsgl
