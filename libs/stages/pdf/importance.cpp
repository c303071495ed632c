#include "stages/pdf/importance.h"

#include <algorithm>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "math/light_source.h"

namespace vsgl {
namespace {

using interop::Reflector;

// Lit texels of one kind, so that a pipeline without specular lobes can serve the diffuse ones.
struct TexelList {
  std::vector<Reflector> texels;
  std::vector<double*> values;  // where each texel's result goes
};

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

// Texels with power, in order: diffuse ones (none unless `split`) and those with a specular lobe.
std::array<TexelList, 2> collect_lit(const Rsm& rsm, bool split, TexelValues& values) {
  std::array<TexelList, 2> lists;
  for (std::size_t k = 0; k < rsm.layers.size(); ++k) {
    const RsmLayer& layer = rsm.layers[k];
    for (std::size_t i = 0; i < layer.surface.size(); ++i) {
      if (layer.pyramid[i].weight <= 0) continue;
      TexelList& list = lists[split && layer.surface[i].ndf == interop::NDF_NONE ? 0 : 1];
      list.texels.push_back(make_reflector(layer, i));
      list.values.push_back(&values[k][i]);
    }
  }
  return lists;
}

class Pass {
 public:
  Pass(const ImportanceKernel& kernel, bool specular_texels, gpu::Device& device)
      : kernel_(kernel),
        device_(device),
        pipeline_(device, kernel.spirv, {gpu::Binding::storage, gpu::Binding::uniform, gpu::Binding::storage},
                  sizeof(interop::ImportancePush),
                  {{interop::IMPORTANCE_SPECULAR_TEXELS_ID, specular_texels},
                   {interop::IMPORTANCE_SPECULAR_SOURCES_ID, kernel.specular_sources}}) {}

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

TexelValues sum_importance(const Rsm& rsm, const ImportanceKernel& kernel, bool skip, gpu::Device& device,
                           Report& report) {
  PhaseTimer timer(report, "importance");
  TexelValues values;
  for (const RsmLayer& layer : rsm.layers) values.emplace_back(layer.surface.size());
  const auto lists = collect_lit(rsm, skip, values);
  for (std::size_t specular = 0; specular < lists.size(); ++specular)
    if (!lists[specular].texels.empty()) Pass(kernel, specular != 0, device).run(lists[specular], report);
  const std::size_t lit = lists[0].texels.size() + lists[1].texels.size();
  report.count("lit_texels", lit);
  report.count("evaluations", lit * (kernel.sources.size() / kernel.source_bytes));
  if (lists[1].texels.empty())
    report.skipped("specular reflection of texels", "no texel has a specular lobe");
  if (!kernel.specular_sources)
    report.skipped("specular reflection of pixels", "no pixel has a specular lobe");
  return values;
}

}  // namespace vsgl
