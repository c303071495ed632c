#include "stages/pdf/options.h"

#include "base/methods.h"
#include "interop/sampling.h"

namespace vsgl {

void add_options(CLI::App& app, PdfParams& params) {
  const CLI::Range counts(1, static_cast<int>(interop::MAX_POINTS));
  add_methods(app, pdf_methods(), params.method, "what the density follows");
  app.add_option("--gbuffer-lights", params.gbuffer_lights, "brsm-vsgl: number of lights on the G-buffer")
      ->check(counts);
  add_choice(app, "--gbuffer-generation", gbuffer_generations(), params.gbuffer_generation,
             "brsm-vsgl: how these lights are made");
  app.add_option("--view-samples", params.view_samples,
                 "brsm-vpl: number of pixels that each texel is tried on")
      ->check(counts);
  app.add_option("--defensive", params.defensive, "brsm: share of the flux density that is mixed in")
      ->check(CLI::Range(0.0, 1.0));
}

}  // namespace vsgl
