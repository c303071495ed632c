#pragma once

#include <cstdint>
#include <vector>

#include "artifact/artifact.h"

namespace vsgl {

// Pixels that one pipeline serves, in the order of the image; background is in no list.
struct ReceiverList {
  std::uint32_t ndf = interop::NDF_NONE;  // of all of them; NDF_ANY without `skip`
  bool bumped = false;                    // a shading normal differs from its geometric one
  std::vector<std::uint32_t> pixels;
  std::vector<interop::Surface> surfaces;
};
std::vector<ReceiverList> sort_receivers(const GBuffer& gbuffer, bool skip);

}  // namespace vsgl
