#pragma once

#include <string>

namespace vsgl {

struct ImageSize {
  int width = 0, height = 0;
};

// The size that an option's text names: "640x360", or "512" for a square. Throws bad_value for other text and
// out_of_range for a side outside 1..limit, both naming `flag`.
ImageSize read_image_size(const std::string& flag, const std::string& text, int limit);

}  // namespace vsgl
