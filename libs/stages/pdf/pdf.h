#pragma once

// Sampling densities over the texels of a reflective shadow map. docs/sampling.md states the formulas.

#include <cstdint>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"

namespace vsgl {

struct PdfParams {
  std::string method = "brsm-vsgl";             // one of pdf_methods()
  int gbuffer_lights = 2048;                    // brsm-vsgl: lights on the G-buffer, 1..1048576
  std::string gbuffer_generation = "fis-2016";  // brsm-vsgl: one of gbuffer_generations()
  int view_samples = 256;                       // brsm-vpl: pixels that each texel is tried on, 1..1048576
  double defensive = 0.1;                       // brsm: share of the flux density in the mixture, 0..1
  std::uint64_t seed = 0;
  bool skip = true;  // leave out specular lobes that nothing has
};

// The density of `params.method`, of mean 1 over the texels of all layers; 0 everywhere where nothing is
// reflected. `gbuffer` may be null for methods that do not need one. The same inputs give the same bytes for
// any number of threads. Throws bad_value, out_of_range, missing_option without a G-buffer, invalid_data when
// the inputs' anchors differ, device_limit.
Pdf build_pdf(const Rsm& rsm, const GBuffer* gbuffer, const PdfParams& params, gpu::Device& device,
              Report& report);

// Relative values of all texels, layer by layer, row by row.
using TexelValues = std::vector<std::vector<double>>;

// A way to build densities. `run` may assume checked parameters, a G-buffer if it needs one, and some
// reflected power.
struct PdfMethod {
  std::string name;
  std::string summary;  // one line, for --list-methods
  bool needs_gbuffer;   // then the flux density is mixed in
  TexelValues (*run)(const Rsm&, const GBuffer*, const PdfParams&, gpu::Device&, Report&);
};
const std::vector<PdfMethod>& pdf_methods();

// How brsm-vsgl makes the lights on the G-buffer: as vsgl-gen's method of that name those on the RSM.
struct GbufferGeneration {
  std::string name;
  std::string summary;
  bool is_clustering;  // of pixels about centres; else kernels are filtered
  std::uint32_t kind;  // KMEANS_* of clusters, KERNEL_* of kernels
};
const std::vector<GbufferGeneration>& gbuffer_generations();
// The row of that name. Throws bad_value, listing those that are there.
const GbufferGeneration& gbuffer_generation(const std::string& name);

}  // namespace vsgl
