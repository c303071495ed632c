#pragma once

#include <cstdint>
#include <vector>

#include "artifact/artifact.h"
#include "interop/shading.h"

namespace vsgl {

// Pixels that one pipeline serves, in the order of the image; background is in no list.
struct ReceiverList {
  std::uint32_t ndf = interop::NDF_NONE;  // of all of them; NDF_ANY without `skip`
  bool bumped = false;                    // a shading normal differs from its geometric one
  std::vector<std::uint32_t> pixels;
  std::vector<interop::Surface> surfaces;
};
std::vector<ReceiverList> sort_receivers(const GBuffer& gbuffer, bool skip);

// NDF_* of the specular lobe; NDF_NONE also where that reflects nothing.
std::uint32_t receiver_ndf(const interop::Surface& surface);

// The pixels of `list` that are `chosen`, in its order.
template <class Chosen>
ReceiverList select(const ReceiverList& list, Chosen chosen) {
  ReceiverList out{list.ndf, list.bumped, {}, {}};
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    if (!chosen(list.pixels[i])) continue;
    out.pixels.push_back(list.pixels[i]);
    out.surfaces.push_back(list.surfaces[i]);
  }
  return out;
}

// `count` pixels of `list` from number `first` on.
ReceiverList slice(const ReceiverList& list, std::size_t first, std::size_t count);

// Adds the sums of the pixels of `list`, in its order, to the image's.
void add(const std::vector<interop::ShadingSums>& sums, const ReceiverList& list,
         std::vector<interop::ShadingSums>& image);

}  // namespace vsgl
