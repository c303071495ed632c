#include "stages/soft_gi/receivers.h"

#include <algorithm>

namespace vsgl::soft_gi {
namespace {

constexpr int kTile = 8;
static_assert(kTile * kTile == interop::PROXY_GROUP);

void fill_up(std::vector<interop::ProxyReceiver>& receivers) {
  while (receivers.size() % interop::PROXY_GROUP != 0) receivers.push_back({});
}

}  // namespace

interop::ProxyReceiver receiver_of(const interop::Surface& surface) {
  if (surface.id == interop::NO_INSTANCE) return {};
  return {surface.position, 1, surface.shading_normal};
}

ReceiverGrid::ReceiverGrid(const GBuffer& gbuffer, int r)
    : columns((gbuffer.width + r - 1) / r), rows((gbuffer.height + r - 1) / r), rate(r) {}

std::size_t ReceiverGrid::pixel(int column, int row, const GBuffer& gbuffer) const {
  const int x = std::min(column * rate + rate / 2, gbuffer.width - 1);
  const int y = std::min(row * rate + rate / 2, gbuffer.height - 1);
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(gbuffer.width) + static_cast<std::size_t>(x);
}

ReceiverGroups group_grid(const GBuffer& gbuffer, const ReceiverGrid& grid) {
  ReceiverGroups out;
  out.slots.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                   interop::PROXY_NO_SLOT);
  for (int top = 0; top < grid.rows; top += kTile)
    for (int left = 0; left < grid.columns; left += kTile) {
      for (int row = top; row < std::min(top + kTile, grid.rows); ++row)
        for (int column = left; column < std::min(left + kTile, grid.columns); ++column) {
          const auto receiver = receiver_of(gbuffer.pixels[grid.pixel(column, row, gbuffer)]);
          if (receiver.seen == 0) continue;
          out.slots[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                    static_cast<std::size_t>(column)] = static_cast<std::uint32_t>(out.receivers.size());
          out.receivers.push_back(receiver);
        }
      fill_up(out.receivers);
    }
  return out;
}

ReceiverGroups group_pixels(const GBuffer& gbuffer, const std::vector<std::uint32_t>& pixels) {
  ReceiverGroups out;
  for (const std::uint32_t pixel : pixels) {
    out.slots.push_back(static_cast<std::uint32_t>(out.receivers.size()));
    out.receivers.push_back(receiver_of(gbuffer.pixels[pixel]));
  }
  fill_up(out.receivers);
  return out;
}

}  // namespace vsgl::soft_gi
