#pragma once

// Frames of a layer out of numbered EXR files.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "stages/metrics/flicker.h"

namespace vsgl::metrics {

// Level 0 of an RGB layer of the first part that has it, with the variance that the file states for the layer
// `indirect`. Throws what read_exr() does, missing_channel, non_finite and invalid_data.
Frame read_frame(const std::filesystem::path& path, const std::string& layer);

// Files whose name holds "%04d" for the frame, first to last.
struct Sequence {
  std::filesystem::path files;
  int first = 0, last = 0;
  std::string layer = "indirect";

  int frames() const { return last - first + 1; }
  Frame frame(int index) const;
};

// What a sequence is measured against besides its reference.
struct Rival {
  std::string name;
  FlickerResult result;
  Interval difference;  // flicker_difference(test, rival)
};

struct SequenceFailure {
  std::string kind;  // limit, misaligned_frame, repeated_frame
  std::string message;
};
using FlickerLimits = std::vector<std::pair<const FlickerMetric*, double>>;
std::vector<SequenceFailure> judge(const FlickerResult& result, const Sequence& test,
                                   const FlickerLimits& limits);

// The result as vsgltools/flicker/1 (configs/schema/flicker.schema.json).
nlohmann::ordered_json to_json(const FlickerResult& result, const Sequence& test, const Sequence& reference,
                               double frame_rate_hz, const Rival* rival, const FlickerLimits& limits,
                               const std::vector<SequenceFailure>& failures);

}  // namespace vsgl::metrics
