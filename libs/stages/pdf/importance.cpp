#include "stages/pdf/importance.h"

#include <algorithm>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "math/light_source.h"

namespace vsgl {
namespace {

using interop::Reflector;

// Lit texels that one pipeline serves.
struct TexelList {
  std::vector<Reflector> texels;
  std::vector<double*> values;  // where each texel's result goes
};
// By NDF_* or IMPORTANCE_NDF_ANY.
using TexelLists = std::array<TexelList, interop::IMPORTANCE_NDF_ANY + 1>;

interop::vec3 luminance_weighted(interop::vec3 c) {
  return {0.2126f * c.x, 0.7152f * c.y, 0.0722f * c.z};
}

Reflector make_reflector(const RsmLayer& layer, std::size_t texel) {
  const interop::Surface& s = layer.surface[texel];
  const interop::Moments& m = layer.pyramid[texel];
  const Vec3 incident = direction_to_source(layer.light, {s.position.x, s.position.y, s.position.z});
  return {s.position,
          s.alpha,
          s.normal,
          s.ndf,
          s.shading_normal,
          {static_cast<float>(incident.x), static_cast<float>(incident.y), static_cast<float>(incident.z)},
          luminance_weighted(m.power_diffuse),
          luminance_weighted(m.power_specular)};
}

// Texels with power, in order: by their NDF, so that none pays for lobes that it lacks, or all together.
TexelLists collect_lit(const Rsm& rsm, bool skip, TexelValues& values) {
  TexelLists lists;
  for (std::size_t k = 0; k < rsm.layers.size(); ++k) {
    const RsmLayer& layer = rsm.layers[k];
    for (std::size_t i = 0; i < layer.surface.size(); ++i) {
      if (layer.pyramid[i].weight <= 0) continue;
      TexelList& list = lists[skip ? layer.surface[i].ndf : interop::IMPORTANCE_NDF_ANY];
      list.texels.push_back(make_reflector(layer, i));
      list.values.push_back(&values[k][i]);
    }
  }
  return lists;
}

class Pass {
 public:
  Pass(const ImportanceKernel& kernel, std::uint32_t texel_ndf, gpu::Device& device)
      : kernel_(kernel),
        device_(device),
        pipeline_(device, kernel.spirv, {gpu::Binding::storage, gpu::Binding::uniform, gpu::Binding::storage},
                  sizeof(interop::ImportancePush),
                  {{interop::IMPORTANCE_TEXEL_NDF_ID, texel_ndf},
                   {interop::IMPORTANCE_SOURCE_NDF_ID, kernel.source_ndf}}) {}

  void run(const TexelList& list, Report& report) {
    gpu::Buffer texels = gpu::Buffer::from(device_, list.texels);
    gpu::Buffer sums(device_, list.texels.size() * sizeof(float));
    sums.clear();
    const std::size_t count = kernel_.sources.size() / kernel_.source_bytes;
    for (std::size_t first = 0; first < count; first += interop::IMPORTANCE_BLOCK) {
      const std::size_t sources = std::min<std::size_t>(interop::IMPORTANCE_BLOCK, count - first);
      gpu::Buffer block = upload(first, sources);
      const interop::ImportancePush push{static_cast<std::uint32_t>(list.texels.size()),
                                         static_cast<std::uint32_t>(sources),
                                         static_cast<float>(kernel_.distance2)};
      gpu::Commands commands(device_);
      commands.dispatch(
          "importance", pipeline_, {texels, block, sums}, push,
          {gpu::groups_for(list.texels.size(), interop::IMPORTANCE_GROUP * interop::IMPORTANCE_TEXELS), 1,
           1});
      commands.submit(report);
    }
    const std::vector<float> result = sums.download<float>(list.texels.size());
    for (std::size_t i = 0; i < result.size(); ++i) *list.values[i] = result[i];
  }

 private:
  // The whole block is bound, so that the shader's array is backed even where it is not read.
  gpu::Buffer upload(std::size_t first, std::size_t sources) const {
    std::vector<std::byte> block(interop::IMPORTANCE_BLOCK * kernel_.source_bytes);
    const auto part = kernel_.sources.subspan(first * kernel_.source_bytes, sources * kernel_.source_bytes);
    std::copy(part.begin(), part.end(), block.begin());
    return gpu::Buffer::from(device_, block);
  }

  const ImportanceKernel& kernel_;
  gpu::Device& device_;
  gpu::ComputePipeline pipeline_;
};

}  // namespace

std::uint32_t common_ndf(const GBuffer& gbuffer, bool skip) {
  if (!skip) return interop::IMPORTANCE_NDF_ANY;
  std::uint32_t common = interop::NDF_NONE;
  for (const interop::Surface& s : gbuffer.pixels) {
    if (s.ndf == interop::NDF_NONE || s.ndf == common) continue;
    if (common != interop::NDF_NONE) return interop::IMPORTANCE_NDF_ANY;
    common = s.ndf;
  }
  return common;
}

TexelValues sum_importance(const Rsm& rsm, const ImportanceKernel& kernel, bool skip, gpu::Device& device,
                           Report& report) {
  PhaseTimer timer(report, "importance");
  TexelValues values;
  for (const RsmLayer& layer : rsm.layers) values.emplace_back(layer.surface.size());
  const TexelLists lists = collect_lit(rsm, skip, values);
  std::size_t lit = 0;
  for (std::uint32_t ndf = 0; ndf < lists.size(); ++ndf) {
    if (lists[ndf].texels.empty()) continue;
    Pass(kernel, ndf, device).run(lists[ndf], report);
    lit += lists[ndf].texels.size();
  }
  report.count("lit_texels", lit);
  report.count("evaluations", lit * (kernel.sources.size() / kernel.source_bytes));
  if (lists[interop::NDF_NONE].texels.size() == lit)
    report.skipped("specular reflection of texels", "no texel has a specular lobe");
  if (kernel.source_ndf == interop::NDF_NONE)
    report.skipped("specular reflection of pixels", "no pixel has a specular lobe");
  return values;
}

}  // namespace vsgl
