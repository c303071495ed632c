#pragma once

// Shading by a cut on the device.

#include <future>
#include <vector>

#include "base/report.h"
#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "gpu/device.h"
#include "stages/shading/cut_blocks.h"

namespace vsgl {

// Keeps the clusters on the device; everything given must outlive it.
class CutPass {
 public:
  CutPass(const GBuffer& gbuffer, const Cut& cut, const CutClusters& clusters, bool skip,
          gpu::Device& device);

  // Starts to build the pipeline of a kernel, which run() would else do: each on a thread of its own, because
  // drivers take as long over them as over the shading.
  void prepare(const CutKernel& kernel);

  // Sums of `receivers.pixels`, in their order. As many blocks at a time as the device's buffers hold, and
  // at most `words` words of lists, if there is more than one block. Throws device_limit when the buffers are
  // too small for one.
  std::vector<interop::CutSums> run(const CutReceivers& receivers, std::size_t words, Report& report);

  const CutCounts& counts() const { return counts_; }

  static constexpr std::size_t kWords = std::size_t{1} << 26;  // of lists at a time: 256 MiB

 private:
  gpu::ComputePipeline pipeline_of(const CutKernel& kernel) const;
  std::size_t leading(const CutReceivers& receivers, std::size_t first, std::size_t words) const;

  const GBuffer& gbuffer_;
  const Cut& cut_;
  const CutClusters& clusters_;
  bool skip_;
  gpu::Device& device_;
  gpu::Buffer cluster_buffer_;
  CutCounts counts_;
  std::vector<std::future<void>> building_;
};

}  // namespace vsgl
