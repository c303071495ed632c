#pragma once

// Maps that show where two artifacts differ.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stages/metrics/compare.h"
#include "stages/metrics/layer.h"

namespace vsgl::metrics {

// |a - b| of every compared channel, in the reference's parts and levels, as FLOAT; UINT channels: 1 where
// they differ. -1 where a side is not finite. Parts whose levels or channels do not belong together are left
// out; without any part there is no map.
std::optional<ExrFile> error_map(const ExrFile& test, const ExrFile& reference, const Options& options);

// 8-bit sRGB, row by row from the top-left.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

// Error of the luminance relative to the reference, |a - b| / (|b| + mean|b| / 100), on a logarithmic scale:
// 1e-4 and less is the dark end of the map, 1 and more the bright end. Pixels that are not finite are green,
// which the map has nowhere.
Picture false_colour(const LayerPair& layer);

// Test | reference | false colour. The first two scaled by 2^exposure, cut to 0..1, sRGB.
Picture side_by_side(const LayerPair& layer, double exposure);

// sRGB of the colour map at t in 0..1: lightness rises evenly from black-blue over purple and orange to pale
// yellow.
std::array<std::uint8_t, 3> map_colour(double t);

// Throws write_failed.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace vsgl::metrics
