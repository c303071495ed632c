#pragma once

// Ground truth: exactly one bounce (light source, one surface, visible surface, camera) by ray tracing,
// without bias. docs/reference.md states estimators and densities.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "artifact/artifact.h"
#include "base/report.h"
#include "scene/scene.h"

namespace vsgl::reference {

inline constexpr int kMaxSamples = 1 << 24;  // a pixel and strategy

struct ReferenceParams {
  std::string strategy = "mis";        // light: paths from the light source; brdf: from the camera; mis: both
  int samples = 256;                   // a pixel and strategy, 1..2^24; rounded up to whole passes
  std::optional<double> target_error;  // stops when sqrt(mean variance) / mean of the indirect light is below
  std::optional<double> time_budget_s;  // stops after the pass during which this time has run out
  std::uint64_t seed = 0;
  std::filesystem::path checkpoint;  // state after each pass, read when it is there; empty: none
  double checkpoint_interval_s = 30;
};

// Radiance at every pixel of `gbuffer`, which must be of `scene`. The same bytes for any number of threads
// and however often the work was interrupted and taken up again from its checkpoint. `progress`: called after
// each pass with the share done, 0..1. Throws bad_value (strategy), out_of_range, invalid_data (another
// anchor, a checkpoint of other inputs).
Reference trace_reference(const scene::Scene& scene, const GBuffer& gbuffer, const ReferenceParams& params,
                          Report& report, const std::function<void(double)>& progress = {});

}  // namespace vsgl::reference
