#pragma once

// What render tells about its frames: the stages' times summed up, and frame by frame for --json.

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/report.h"
#include "pipeline/renderer.h"

namespace vsgl::render {

class FrameReport {
 public:
  explicit FrameReport(Report& report) : report_(report) {}

  void add(int number, const RenderedFrame& frame);
  void warn(const std::vector<std::string>& warnings);  // each text once
  // Adds the number of frames and, with `details`, the list of all to the report's counts.
  void finish(bool details);

 private:
  Report& report_;
  nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
  std::set<std::string> said_;  // warnings and omissions
};

}  // namespace vsgl::render
