#pragma once

// Soft shadows and inter-reflection under an environment, from sphere proxies in spherical harmonics [Sloan
// 2007]. docs/proxies.md states the formulas.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "artifact/occlusion.h"
#include "artifact/proxies.h"
#include "base/methods.h"
#include "base/report.h"
#include "gpu/device.h"
#include "scene/environment.h"

namespace vsgl {

struct SoftGiParams {
  int rate = 4;                              // pixels a side that one receiver stands for: 1, 2, 4 or 8
  std::string emission = "averaged";         // of emissions(): radiance of a proxy
  std::string exponential = "second-order";  // of exponentials()
  std::string upsample = "plane";            // of upsamplers()
  std::string normalisation = "cosine";      // of normalisations()
  std::string overlap = "exposed";           // of overlaps()
  // Radii of spheres of influence, over the proxies', 1..1000; without: chosen for the environment.
  std::optional<double> shadow_influence{}, indirect_influence{};
  // Of that choice: difference of shade over the largest there is, 1e-5..0.5.
  double tolerance = 1.0 / 4096;
};

struct SoftGiMethod {
  std::string name, summary;
  std::uint32_t kind;  // interop::PROXY_*; of overlaps(): whether exposures are measured
};
const std::vector<SoftGiMethod>& emissions();
const std::vector<SoftGiMethod>& exponentials();
const std::vector<SoftGiMethod>& upsamplers();
const std::vector<SoftGiMethod>& normalisations();  // of light from proxies that overlap
const std::vector<SoftGiMethod>& overlaps();        // how much of a proxy counts

// Radiance of every pixel: `direct` from the environment, with the proxies' shadows, and `diffuse` from the
// proxies. Diffuse reflection alone. `occlusion`: the receivers' vectors, where not null. The same bytes for
// any number of threads. Throws bad_value, out_of_range, invalid_data when G-buffer and proxies have
// different anchors, device_limit.
Indirect shade_soft_gi(const GBuffer& gbuffer, const Proxies& proxies, const scene::Environment& environment,
                       const SoftGiParams& params, gpu::Device& device, Report& report,
                       Occlusion* occlusion = nullptr);

}  // namespace vsgl
