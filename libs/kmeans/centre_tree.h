#pragma once

#include <string>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "kmeans/radix_sort.h"

namespace vsgl {

// A binary radix tree over centres on the device, built by all its nodes at once: [Karras 2012] with the
// centres in the order of their Morton codes. interop::CentreNode states the layout.
class CentreTree {
 public:
  CentreTree(gpu::Device& device, std::uint32_t count);  // centres, at least 1

  // `centres`: interop::Feature each.
  void record(gpu::Commands& commands, const gpu::Buffer& centres, const std::string& label);
  gpu::Buffer& nodes() { return nodes_; }

 private:
  std::uint32_t count_;
  gpu::ComputePipeline extent_, codes_, tree_, bound_blocks_, refit_;
  RadixSort sort_;
  gpu::Buffer extent_box_, nodes_, blocks_;
};

}  // namespace vsgl
