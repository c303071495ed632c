#pragma once

// Every method of every stage, behind one interface, on one small synthetic room.

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "gpu/device.h"

namespace vsgl::test {

struct Candidate {
  std::string stage, method;
  std::string tool;  // the executable that offers it, by --list-methods; or by --help alone
  // Runs the method on `device` and writes its artifact.
  std::function<void(gpu::Device& device, const std::filesystem::path& path)> run;
  // Reads the artifact with its validating reader and judges it: throws or records a test failure.
  std::function<void(gpu::Device& device, const std::filesystem::path& path)> check;
  bool is_listed = true;
};

// One row per registry row, in the stages' order.
const std::vector<Candidate>& candidates();

// For each stage: calls it with a method that nobody has.
struct Stage {
  std::string name;
  std::function<void(gpu::Device& device, const std::string& method)> run;
};
const std::vector<Stage>& stages();

inline std::ostream& operator<<(std::ostream& stream, const Candidate& candidate) {
  return stream << candidate.stage << '/' << candidate.method;
}

}  // namespace vsgl::test
