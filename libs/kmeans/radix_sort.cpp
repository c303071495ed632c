#include "kmeans/radix_sort.h"

#include "gpu/address.h"
#include "interop/kmeans.h"
#include "spirv/kmeans/sort_count.comp.glsl.h"
#include "spirv/kmeans/sort_scan.comp.glsl.h"
#include "spirv/kmeans/sort_scatter.comp.glsl.h"

namespace vsgl {

using interop::SortPush;

RadixSort::RadixSort(gpu::Device& device, std::size_t count, int bits)
    : count_(static_cast<std::uint32_t>(count)),
      blocks_(gpu::groups_for(count, interop::SORT_BLOCK)),
      passes_(gpu::groups_for(static_cast<std::size_t>(bits), interop::SORT_DIGIT_BITS)),
      count_digits_(device, sort_count_comp_spv, {}, sizeof(SortPush)),
      scan_(device, sort_scan_comp_spv, {}, sizeof(SortPush)),
      scatter_(device, sort_scatter_comp_spv, {}, sizeof(SortPush)),
      counts_(device, interop::SORT_DIGITS * blocks_ * sizeof(std::uint32_t)) {
  const std::size_t bytes = count * sizeof(std::uint32_t);
  for (int side = 0; side < 2; ++side) pairs_.push_back({{device, bytes}, {device, bytes}});
}

void RadixSort::record(gpu::Commands& commands, const std::string& label) const {
  for (std::uint32_t pass = 0; pass < passes_; ++pass) {
    const Pairs &from = pairs_[pass % 2], &to = pairs_[1 - pass % 2];
    const SortPush push{address_of(from.keys),          address_of(from.values), address_of(to.keys),
                        address_of(to.values),          address_of(counts_),     count_,
                        pass * interop::SORT_DIGIT_BITS};
    commands.dispatch(label, count_digits_, {}, push, {blocks_, 1, 1});
    commands.dispatch(label, scan_, {}, push, {1, 1, 1});
    commands.dispatch(label, scatter_, {}, push, {blocks_, 1, 1});
  }
}

}  // namespace vsgl
