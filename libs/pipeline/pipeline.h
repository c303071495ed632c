#pragma once

// The chain from scene to image: the parameters of all its stages.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "stages/cut/cut.h"
#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"
#include "stages/rsm/options.h"
#include "stages/shading/shading.h"
#include "stages/visibility/visibility.h"

namespace vsgl {

// Passes of progressive rendering: lights, what they see and the image anew each time, see base/pass.h.
struct Progressive {
  int passes = 64;               // 1..max_passes
  double alpha = Pass{}.alpha;
};

struct Pipeline {
  BakeParams rsm_bake;
  PdfParams pdf_build;
  LightsParams vsgl_gen;
  std::optional<VisibilityParams> ismap = VisibilityParams{};  // none: no shadows
  CutParams light_cut;  // of a tree of lights, without ismap, which chooses the cut itself
  ShadingParams shade;
  std::optional<Progressive> progressive;  // none: one pass

  void set_seed(std::uint64_t seed);
  void set_skip(bool skip);  // leave out what the scene does not need
  void set_error(double error);
};

// Reads a pipeline JSON (configs/schema/pipeline.schema.json): an object a stage, with what --config of its
// tool takes. Throws json_* and wrong_schema for the file's frame, unknown_option, bad_value and out_of_range
// for what a stage does not take; all name file and JSON pointer.
Pipeline read_pipeline(const std::filesystem::path& path);

}  // namespace vsgl
