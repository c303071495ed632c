#pragma once

#include <optional>

#include "base/image_size.h"
#include "stages/rsm/rsm.h"

namespace CLI {
class App;
}

namespace vsgl {

// What rsm-bake takes besides files.
struct BakeParams {
  RsmParams rsm;
  std::optional<ImageSize> resolution;  // of the G-buffer; none: the scene's
  VisibleBy visible = VisibleBy::automatic;

  // Whether a CPU device may be set up for compute alone, which runs wider (gpu::DeviceOptions).
  bool compute_only() const { return visible != VisibleBy::raster; }
};

inline constexpr int kMaxResolution = 16384;  // pixels a side of a G-buffer

// Declares the parameters of this stage as options: the flags of its tool, the keys of its --config file and
// of its object in a pipeline JSON. `params` must outlive the app.
void add_options(CLI::App& app, BakeParams& params);

}  // namespace vsgl
