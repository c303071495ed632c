#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vsgl {

// Where an artifact comes from, written into its header. Holds nothing that changes between equal runs: no
// times, no absolute paths, no thread counts.
struct Provenance {
  std::string tool;          // "vsgl-gen"
  std::string tool_version;  // "0.1.0"
  std::string command_line;  // the flags that shape the result, paths reduced to file names
  std::uint64_t seed = 0;
  struct Input {
    std::string name;    // file name without folder
    std::string sha256;  // of its bytes, lower-case hex
  };
  std::vector<Input> inputs;
};

}  // namespace vsgl
