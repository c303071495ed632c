#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "interop/moments.h"

namespace vsgl {

// The moment pyramid of size x size texels, a power of two, on the device: a buffer a level. Whoever writes
// the finest level lets merge() make the others.
class MomentPyramid {
 public:
  MomentPyramid(gpu::Device& device, int size);

  gpu::Buffer& finest() { return levels_.front(); }  // Moments of each texel, row by row
  // Appends the steps from each level to the next: 2x2 texels in the order 00, 10, 01, 11, by the law of
  // total variance.
  void merge(gpu::Commands& commands) const;
  // All levels in the layout of math/pyramid.h.
  std::vector<interop::Moments> download();

 private:
  int size_;
  gpu::ComputePipeline pipeline_;
  std::vector<gpu::Buffer> levels_;
};

// Whether lobes that are to be averaged by a map LOBE_* have to be encoded anew first: they come as
// LOBE_BANERJEE has them.
bool needs_encoding(std::uint32_t lobe_filter);
// Appends what encodes the lobes of `texels` of an RSM, the finest level of its pyramid, anew by a map
// LOBE_*.
void encode_lobes(const gpu::Buffer& moments, std::size_t texels, std::uint32_t lobe_filter,
                  gpu::Device& device, gpu::Commands& commands);
// Appends the steps that make all other levels of a pyramid of `size` texels a side anew: `coarser`, one
// after another.
void merge_levels(const gpu::Buffer& finest, const gpu::Buffer& coarser, int size, gpu::Device& device,
                  gpu::Commands& commands);

}  // namespace vsgl
