#pragma once

#include <span>
#include <vector>

#include "interop/importance.h"
#include "stages/pdf/pdf.h"

namespace vsgl {

// A kernel that sums, at every lit texel, the importance that the sources (Importon or Reflector) take from
// it.
struct ImportanceKernel {
  std::span<const std::uint32_t> spirv;
  std::span<const std::byte> sources;
  std::size_t source_bytes = 0;                            // of one
  std::uint32_t source_ndf = interop::IMPORTANCE_NDF_ANY;  // of all specular sources; NDF_NONE: none is
  double distance2 = 0;                                    // floor of the squared distance, m^2
};
// NDF that all specular pixels share: NDF_NONE without any, IMPORTANCE_NDF_ANY where they differ or nothing
// is to be skipped.
std::uint32_t common_ndf(const GBuffer& gbuffer, bool skip);

TexelValues sum_importance(const Rsm& rsm, const ImportanceKernel& kernel, bool skip, gpu::Device& device,
                           Report& report);

}  // namespace vsgl
