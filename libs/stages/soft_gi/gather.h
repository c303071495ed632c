#pragma once

// The passes that need every proxy: lists, sums, exponentials.

#include <array>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "stages/soft_gi/light.h"
#include "stages/soft_gi/receivers.h"
#include "stages/soft_gi/soft_gi.h"

namespace vsgl::soft_gi {

// Of each receiver, in the order of its groups.
struct Gathered {
  std::vector<interop::ProxyShade> shades;
  std::vector<std::array<float, 16>> occlusion;  // where asked for
  std::size_t pairs = 0;                         // of receivers' places and listed proxies
  std::size_t longest = 0;                       // list
  std::size_t empty = 0;                         // groups without proxies
};

class Gatherer {
 public:
  // The device must outlive it.
  Gatherer(const std::vector<ProxySphere>& proxies, const ColourVector& light, const Influence& influence,
           const SoftGiParams& params, gpu::Device& device);

  Gathered gather(const ReceiverGroups& groups, bool with_occlusion, Report& report);

 private:
  struct Lists {
    std::vector<std::uint32_t> starts;
    gpu::Buffer starts_buffer, entries;
  };
  Lists cull(gpu::Buffer& receivers, std::uint32_t groups, Report& report);
  void gather_part(std::span<const interop::ProxyReceiver> receivers, bool with_occlusion, Gathered& out,
                   Report& report);

  gpu::Device& device_;
  std::uint32_t count_;
  Influence influence_;
  gpu::Buffer proxies_, table_, form_, light_, fits_;
  gpu::ComputePipeline count_lists_, fill_lists_, accumulate_, exponentiate_;
};

}  // namespace vsgl::soft_gi
