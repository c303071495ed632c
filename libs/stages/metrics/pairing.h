#pragma once

// Which part belongs to which, and which channels are compared. Private to this library.

#include <string>
#include <utility>
#include <vector>

#include "image/exr.h"
#include "stages/metrics/compare.h"

namespace vsgl::metrics {

// Whether `name` is the channel "layer.X" or the whole layer "layer".
bool names_channel(const std::string& name, const std::string& channel);
bool is_selected(const Options& options, const std::string& channel);
// Throws bad_value when a name of the options matches no channel of either file.
void check_selection(const Options& options, const ExrFile& test, const ExrFile& reference);

// Parts of one name; the only parts of two single-part files go together whatever their names.
struct PartPair {
  const ExrPart* test = nullptr;
  const ExrPart* reference = nullptr;  // either may be absent, not both
};
std::vector<PartPair> pair_parts(const ExrFile& test, const ExrFile& reference);

}  // namespace vsgl::metrics
