#include "kmeans/centre_tree.h"

#include "gpu/address.h"
#include "interop/kmeans.h"
#include "spirv/kmeans/blocks.comp.glsl.h"
#include "spirv/kmeans/codes.comp.glsl.h"
#include "spirv/kmeans/extent.comp.glsl.h"
#include "spirv/kmeans/refit.comp.glsl.h"
#include "spirv/kmeans/tree.comp.glsl.h"

namespace vsgl {
namespace {

constexpr std::uint32_t group_size = 64;
constexpr int code_bits = 30;

}  // namespace

CentreTree::CentreTree(gpu::Device& device, std::uint32_t count)
    : count_(count),
      extent_(device, extent_comp_spv, {}, sizeof(interop::CentreTree)),
      codes_(device, codes_comp_spv, {}, sizeof(interop::CentreTree)),
      tree_(device, tree_comp_spv, {}, sizeof(interop::CentreTree)),
      bound_blocks_(device, blocks_comp_spv, {}, sizeof(interop::CentreTree)),
      refit_(device, refit_comp_spv, {}, sizeof(interop::CentreTree)),
      sort_(device, count, code_bits),
      extent_box_(device, 2 * sizeof(interop::vec3)),
      nodes_(device, (2 * std::size_t{count} - 1) * sizeof(interop::CentreNode)),
      blocks_(device, count * sizeof(interop::CentreBlock)) {}

void CentreTree::record(gpu::Commands& commands, const gpu::Buffer& centres, const std::string& label) {
  const std::array<std::uint32_t, 3> groups{gpu::groups_for(count_, group_size), 1, 1};
  interop::CentreTree push{address_of(centres),
                           address_of(extent_box_),
                           address_of(sort_.keys()),
                           address_of(sort_.values()),
                           address_of(nodes_),
                           address_of(blocks_),
                           count_,
                           0};
  commands.dispatch(label, extent_, {}, push, {1, 1, 1});
  commands.dispatch(label, codes_, {}, push, groups);
  sort_.record(commands, label);
  push.codes_at = address_of(sort_.sorted_keys());
  push.order_at = address_of(sort_.sorted_values());
  commands.dispatch(label, tree_, {}, push, groups);
  for (std::uint32_t blocks = count_; blocks > 1;) {
    blocks = gpu::groups_for(blocks, interop::CENTRE_BLOCK);
    ++push.step;
    commands.dispatch(label, bound_blocks_, {}, push, {gpu::groups_for(blocks, group_size), 1, 1});
  }
  commands.dispatch(label, refit_, {}, push, groups);
}

}  // namespace vsgl
