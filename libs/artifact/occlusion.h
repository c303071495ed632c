#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "base/provenance.h"

namespace vsgl {

// Visibility of the environment from the receivers of proxy-gi, in spherical harmonics of order 4: channels
// sh0.V to sh15.V, coefficient (l, m) in that of l^2 + l + m.
struct Occlusion {
  int width = 0, height = 0;
  int rate = 1;                                // pixels of the G-buffer a side that one receiver stands for
  std::vector<std::array<float, 16>> vectors;  // row by row; 0 where nothing is seen
};
void write(const std::filesystem::path& path, const Occlusion& occlusion, const Provenance& provenance);
Occlusion read_occlusion(const std::filesystem::path& path);

}  // namespace vsgl
