#pragma once

#include <cstdint>
#include <vector>

#include "artifact/artifact.h"
#include "interop/proxy.h"

namespace vsgl::soft_gi {

interop::ProxyReceiver receiver_of(const interop::Surface& surface);

// Receivers in groups of PROXY_GROUP, and where each one has gone.
struct ReceiverGroups {
  std::vector<interop::ProxyReceiver> receivers;  // groups filled up with empty places
  std::vector<std::uint32_t>
      slots;  // of each place of the grid, row by row; PROXY_NO_SLOT where nothing is seen

  std::size_t groups() const { return receivers.size() / interop::PROXY_GROUP; }
};

// One receiver for rate x rate pixels, at a pixel near their middle: a grid of so many columns and rows.
struct ReceiverGrid {
  int columns = 0, rows = 0, rate = 1;

  ReceiverGrid(const GBuffer& gbuffer, int rate);
  std::size_t pixel(int column, int row, const GBuffer& gbuffer) const;
};

// Those of a grid that see something, tile by tile of 8 x 8.
ReceiverGroups group_grid(const GBuffer& gbuffer, const ReceiverGrid& grid);
// Those of a list of pixels in the order of the image; slots in the list's order. Groups are cut where the
// list is.
ReceiverGroups group_pixels(const GBuffer& gbuffer, const std::vector<std::uint32_t>& pixels);

}  // namespace vsgl::soft_gi
