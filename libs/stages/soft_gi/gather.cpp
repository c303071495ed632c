#include "stages/soft_gi/gather.h"

#include <algorithm>
#include <numbers>

#include "base/find_method.h"
#include "math/interop_vec.h"
#include "spirv/proxy/accumulate.comp.glsl.h"
#include "spirv/proxy/cull.comp.glsl.h"
#include "spirv/proxy/exponentiate.comp.glsl.h"
#include "stages/soft_gi/exposure.h"
#include "stages/soft_gi/tables.h"

namespace vsgl::soft_gi {
namespace {

using gpu::Binding, gpu::Buffer, gpu::groups_for;
using interop::ProxyReceiver, interop::PROXY_GROUP;

constexpr std::size_t kPartGroups = 1 << 14;  // at once: 80 MiB of sums
constexpr std::uint32_t kCullGroup = 64;

std::vector<interop::Proxy> pack(const std::vector<ProxySphere>& spheres, const std::string& overlap) {
  Exposure whole;
  whole.fill(1);
  const bool measured = find_method(overlaps(), overlap, "overlap").kind != 0;
  const std::vector<Exposure> shares =
      measured ? exposures(spheres) : std::vector<Exposure>(spheres.size(), whole);
  std::vector<interop::Proxy> out;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& [center, radius, albedo] = spheres[i];
    out.push_back({to_float(center), static_cast<float>(radius), to_float(albedo / std::numbers::pi), {}});
    std::ranges::copy(shares[i], out.back().exposed);
  }
  return out;
}

std::vector<interop::vec3> pack(const ColourVector& light) {
  std::vector<interop::vec3> out;
  for (int i = 0; i < sh::kCoefficients; ++i)
    out.push_back(to_float({light[0][i], light[1][i], light[2][i]}));
  return out;
}

std::uint32_t normalisation_of(const SoftGiParams& params) {
  return find_method(normalisations(), params.normalisation, "normalisation").kind;
}

gpu::ComputePipeline cull_pipeline(gpu::Device& device, std::uint32_t fill) {
  return {device,
          cull_comp_spv,
          std::vector<Binding>(4, Binding::storage),
          sizeof(interop::ProxyCullPush),
          {{interop::PROXY_FILL_ID, fill}}};
}

}  // namespace

Gatherer::Gatherer(const std::vector<ProxySphere>& proxies, const ColourVector& light,
                   const Influence& influence, const SoftGiParams& params, gpu::Device& device)
    : device_(device),
      count_(static_cast<std::uint32_t>(proxies.size())),
      influence_(influence),
      proxies_(Buffer::from(device, pack(proxies, params.overlap))),
      table_(Buffer::from(device, proxy_table())),
      form_(Buffer::from(device, std::vector{irradiance_form(light)})),
      light_(Buffer::from(device, pack(light))),
      fits_(Buffer::from(device, exponential_fits())),
      count_lists_(cull_pipeline(device, 0)),
      fill_lists_(cull_pipeline(device, 1)),
      accumulate_(device, accumulate_comp_spv, std::vector<Binding>(7, Binding::storage),
                  sizeof(interop::ProxyAccumulatePush),
                  {{interop::PROXY_OPERATOR_ID, find_method(emissions(), params.emission, "emission").kind},
                   {interop::PROXY_NORMALISATION_ID, normalisation_of(params)}}),
      exponentiate_(
          device, exponentiate_comp_spv, std::vector<Binding>(5, Binding::storage), 0,
          {{interop::PROXY_EXP_ID, find_method(exponentials(), params.exponential, "exponential").kind},
           {interop::PROXY_NORMALISATION_ID, normalisation_of(params)}}) {}

// Counts first, so that the lists have exactly the room that they need.
Gatherer::Lists Gatherer::cull(Buffer& receivers, std::uint32_t groups, Report& report) {
  const interop::ProxyCullPush push{groups, count_,
                                    static_cast<float>(std::max(influence_.shadow, influence_.indirect))};
  const std::array<std::uint32_t, 3> size{groups_for(groups, kCullGroup), 1, 1};
  Buffer counts(device_, groups * sizeof(std::uint32_t)), none(device_, 0);
  gpu::Commands counting(device_);
  counting.dispatch("cull", count_lists_, {receivers, proxies_, counts, none}, push, size);
  counting.submit(report);
  std::vector<std::uint32_t> starts{0};
  for (const std::uint32_t count : counts.download<std::uint32_t>(groups))
    starts.push_back(starts.back() + count);
  Lists lists{starts, Buffer::from(device_, starts), Buffer(device_, starts.back() * sizeof(std::uint32_t))};
  gpu::Commands filling(device_);
  filling.dispatch("cull", fill_lists_, {receivers, proxies_, lists.starts_buffer, lists.entries}, push,
                   size);
  filling.submit(report);
  return lists;
}

void Gatherer::gather_part(std::span<const ProxyReceiver> part, bool with_occlusion, Gathered& out,
                           Report& report) {
  const auto groups = static_cast<std::uint32_t>(part.size() / PROXY_GROUP);
  Buffer receivers = Buffer::from(device_, part);
  Lists lists = cull(receivers, groups, report);
  Buffer sums(device_, part.size() * sizeof(interop::ProxySums));
  Buffer shades(device_, part.size() * sizeof(interop::ProxyShade));
  const interop::ProxyAccumulatePush push{static_cast<float>(1 / influence_.shadow),
                                          static_cast<float>(1 / influence_.indirect)};
  gpu::Commands commands(device_);
  commands.dispatch("accumulate", accumulate_,
                    {receivers, proxies_, lists.starts_buffer, lists.entries, table_, form_, sums}, push,
                    {groups, 1, 1});
  commands.dispatch("exponentiate", exponentiate_, {receivers, sums, light_, fits_, shades},
                    std::span<const std::byte>{}, {groups, 1, 1});
  commands.submit(report);
  const auto found = shades.download<interop::ProxyShade>(part.size());
  out.shades.insert(out.shades.end(), found.begin(), found.end());
  for (std::uint32_t group = 0; group < groups; ++group) {
    const std::size_t length = lists.starts[group + 1] - lists.starts[group];
    out.longest = std::max(out.longest, length);
    out.empty += length == 0;
  }
  out.pairs += std::size_t{lists.starts.back()} * PROXY_GROUP;
  if (!with_occlusion) return;
  for (const interop::ProxySums& sum : sums.download<interop::ProxySums>(part.size())) {
    std::array<float, 16>& vector = out.occlusion.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const interop::vec4& v = sum.log_occlusion[i];
      vector[4 * i] = v.x, vector[4 * i + 1] = v.y, vector[4 * i + 2] = v.z, vector[4 * i + 3] = v.w;
    }
  }
}

Gathered Gatherer::gather(const ReceiverGroups& groups, bool with_occlusion, Report& report) {
  Gathered out;
  const std::size_t most = kPartGroups * PROXY_GROUP;
  const std::span<const ProxyReceiver> all = groups.receivers;
  for (std::size_t first = 0; first < all.size(); first += most)
    gather_part(all.subspan(first, std::min(most, all.size() - first)), with_occlusion, out, report);
  return out;
}

}  // namespace vsgl::soft_gi
