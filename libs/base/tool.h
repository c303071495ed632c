#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/provenance.h"
#include "base/report.h"
#include "base/run_record.h"

namespace vsgl {

// The options that every tool has.
struct CommonOptions {
  std::string config;           // JSON file: keys are the long flags in snake_case; flags override it
  std::string device = "auto";  // auto | cpu | gpu | part of a device's name
  int threads = 0;              // 0: all cores
  std::uint64_t seed = 0;
  bool json = false, dry_run = false, overwrite = false, if_changed = false, quiet = false, no_skip = false;
  int verbose = 0;
  std::string progress = "auto";  // auto | never
};

// The frame of an executable: declares the common options, parses, merges --config, answers --help,
// --version,
// --dry-run, prints the Report, turns errors into "tool: error E3006: ..." on stderr and the exit status.
//
//   int main(int argc, char** argv) {
//     vsgl::Tool tool("vsgl-gen", "samples and filters lights from a reflective shadow map");
//     std::filesystem::path rsm, output;
//     tool.input("--rsm", rsm, "RSM to sample")->required();
//     tool.output("-o,--output", output, "lights to write")->required();
//     int count = 1024;
//     tool.app().add_option("--count", count, "number of lights")->check(CLI::Range(1,
//     1048576))->capture_default_str(); return tool.run(argc, argv, [&](vsgl::Report& report,
//     vsgl::OutputSet& outputs) {
//       ...; write(outputs.add(output)); return vsgl::Exit::ok;
//     });
//   }
class Tool {
 public:
  Tool(std::string name, std::string summary);

  CLI::App& app() { return app_; }
  const CommonOptions& common() const { return common_; }

  // An input file: hashed into the provenance (only its name enters the command line). Must exist when run()
  // starts. A name of a sequence (base/frame_name.h) is neither hashed nor looked for: that is for the body.
  CLI::Option* input(const std::string& flags, std::filesystem::path& path, const std::string& help);
  // An output file: not part of the provenance; checked against --overwrite and for a writable folder before
  // work begins.
  CLI::Option* output(const std::string& flags, std::filesystem::path& path, const std::string& help);

  // A folder for outputs, which is there already; not part of the provenance.
  CLI::Option* output_folder(const std::string& flags, std::filesystem::path& path, const std::string& help);

  // A file that a run keeps for itself: it may be there already and is replaced; not part of the provenance.
  CLI::Option* state(const std::string& flags, std::filesystem::path& path, const std::string& help);

  // Leaves an option, which does not shape the result, out of the command line of the provenance.
  void keep_from_provenance(const CLI::Option* option) { neutral_.insert(option); }

  // A file that the inputs refer to (meshes and textures of a scene): hashed into the provenance after them.
  void depends_on(const std::filesystem::path& path);

  // Valid inside run()'s body. Inputs are hashed on first use. Throws file_not_found or read_failed.
  Provenance provenance() const;

  // `body` writes to the temporary paths of `outputs`; they are committed when it returns (any Exit). Never
  // throws.
  // --threads is in force (OpenMP) when it starts.
  int run(int argc, char** argv, const std::function<Exit(Report&, OutputSet&)>& body);

 private:
  using PathOption = std::pair<CLI::Option*, std::filesystem::path*>;

  void add_common_options();
  CLI::Option* add_path(const std::string& flags, std::filesystem::path& path, const std::string& help);
  // False when --help, --version or --dry-run has been answered.
  bool parse(int argc, char** argv);
  void check_conflicts() const;
  void check_inputs() const;
  void check_outputs() const;
  Exit work(const std::function<Exit(Report&, OutputSet&)>& body);
  void print_result(const Report& report, const std::vector<std::filesystem::path>& outputs) const;
  std::string command_line() const;
  std::string command_line_without(const std::set<const CLI::Option*>& left_out) const;

  // --if-changed. The record of this very run, if its outputs are still there; where there are sequences
  // among the inputs there never is one, since they may have got new frames.
  std::optional<RunRecord> earlier_run() const;
  void remember_run(const OutputSet& outputs, Exit status) const;
  std::filesystem::path record_file() const;  // empty: no output is asked for
  std::string command_line_with_outputs() const;
  std::vector<std::filesystem::path> input_files() const;  // that are hashed

  std::string name_;
  CLI::App app_;
  CommonOptions common_;
  std::vector<PathOption> inputs_, outputs_;
  std::set<const CLI::Option*> paths_;  // inputs, outputs, folders and states
  std::set<const CLI::Option*>
      neutral_;  // do not shape the result: left out of the command line of the provenance
  std::vector<std::filesystem::path> dependencies_;
  mutable std::vector<Provenance::Input> hashed_;
};

}  // namespace vsgl
