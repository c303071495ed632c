#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/compute.h"

namespace vsgl {

// Sorts pairs of 32-bit words by their keys on the device; pairs of equal keys keep their order. Ranks are
// counted, never drawn from atomics: the same bytes on any number of threads. [Merrill 2010]
class RadixSort {
 public:
  // For `count` pairs, at least 1, whose keys are below 2^bits.
  RadixSort(gpu::Device& device, std::size_t count, int bits);

  // The pairs to be sorted; sorting overwrites them.
  gpu::Buffer& keys() { return pairs_[0].keys; }
  gpu::Buffer& values() { return pairs_[0].values; }
  void record(gpu::Commands& commands, const std::string& label) const;
  gpu::Buffer& sorted_keys() { return pairs_[passes_ % 2].keys; }
  gpu::Buffer& sorted_values() { return pairs_[passes_ % 2].values; }

 private:
  struct Pairs {
    gpu::Buffer keys, values;
  };
  std::uint32_t count_, blocks_;
  std::size_t passes_;
  gpu::ComputePipeline count_digits_, scan_, scatter_;
  std::vector<Pairs> pairs_;
  gpu::Buffer counts_;
};

}  // namespace vsgl
