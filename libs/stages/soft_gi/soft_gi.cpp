#include "stages/soft_gi/soft_gi.h"

#include <algorithm>

#include "base/error.h"
#include "base/find_method.h"
#include "math/interop_vec.h"
#include "stages/soft_gi/gather.h"
#include "stages/soft_gi/upsample.h"

namespace vsgl {
namespace {

using namespace soft_gi;
using interop::ProxyShade;

constexpr double kAnchorTolerance = 1e-6;  // of the scene's radius

void require_range(const char* name, double value, double minimum, double maximum) {
  if (!(value >= minimum && value <= maximum))
    throw Error(ErrorCode::out_of_range, std::string(name) + ": " + std::to_string(value) + " is outside " +
                                             std::to_string(minimum) + ".." + std::to_string(maximum));
}

void check(const GBuffer& gbuffer, const Proxies& proxies, const SoftGiParams& params) {
  if (params.rate != 1 && params.rate != 2 && params.rate != 4 && params.rate != 8)
    throw Error(ErrorCode::out_of_range, "rate: " + std::to_string(params.rate) + " is none of 1, 2, 4, 8");
  require_range("tolerance", params.tolerance, 1e-5, 0.5);
  for (const auto& influence : {params.shadow_influence, params.indirect_influence})
    if (influence) require_range("influence", *influence, 1, 1000);
  if (length(proxies.anchor - gbuffer.anchor) > kAnchorTolerance * gbuffer.scene_radius)
    throw Error(ErrorCode::invalid_data,
                "proxies: anchor differs from the G-buffer's; make both from the same scene");
}

Influence influence_of(const ColourVector& light, const SoftGiParams& params) {
  Influence out{params.shadow_influence.value_or(0), params.indirect_influence.value_or(0)};
  if (params.shadow_influence && params.indirect_influence) return out;
  const Influence chosen = choose_influence(light, params.tolerance);
  return {params.shadow_influence.value_or(chosen.shadow),
          params.indirect_influence.value_or(chosen.indirect)};
}

void describe(const Gathered& gathered, const ReceiverGroups& groups, std::size_t proxies, Report& report) {
  report.count("proxies", proxies);
  report.count("receivers",
               std::ranges::count_if(groups.receivers, [](const auto& r) { return r.seen != 0; }));
  report.count("groups", groups.groups());
  report.count("listed_pairs", gathered.pairs);
  report.count("longest_list", gathered.longest);
  if (gathered.empty > 0)
    report.skipped(std::to_string(gathered.empty) + " groups of receivers",
                   "no proxy's influence reaches them");
  if (proxies == 0) report.skipped("shadows and indirect light", "there are no proxies");
}

Occlusion occlusion_of(const Gathered& gathered, const ReceiverGroups& groups, const ReceiverGrid& grid) {
  Occlusion out{grid.columns, grid.rows, grid.rate, {}};
  for (const std::uint32_t slot : groups.slots)
    out.vectors.push_back(slot == interop::PROXY_NO_SLOT ? std::array<float, 16>{}
                                                         : gathered.occlusion[slot]);
  return out;
}

// Reflected radiance, from irradiances at each pixel; those below 0, where the light or the occlusion rings,
// count as 0.
Indirect reflect(const GBuffer& gbuffer, const std::vector<ProxyShade>& shades, Report& report) {
  Indirect out;
  out.width = gbuffer.width;
  out.height = gbuffer.height;
  std::size_t clamped = 0;
  const auto reflected = [&](interop::vec3 albedo, interop::vec3 irradiance) {
    clamped += irradiance.x < 0 || irradiance.y < 0 || irradiance.z < 0;
    constexpr float kInversePi = 0.318309886f;
    return interop::vec3{albedo.x * kInversePi * std::max(irradiance.x, 0.0f),
                         albedo.y * kInversePi * std::max(irradiance.y, 0.0f),
                         albedo.z * kInversePi * std::max(irradiance.z, 0.0f)};
  };
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const interop::vec3 albedo = gbuffer.pixels[i].diffuse;
    out.direct.push_back(reflected(albedo, shades[i].direct));
    out.diffuse.push_back(reflected(albedo, shades[i].indirect));
  }
  report.count("clamped_values", clamped);
  return out;
}

// Every pixel's own receiver.
std::vector<ProxyShade> spread(const Gathered& gathered, const ReceiverGroups& groups) {
  std::vector<ProxyShade> out;
  for (const std::uint32_t slot : groups.slots)
    out.push_back(slot == interop::PROXY_NO_SLOT ? ProxyShade{} : gathered.shades[slot]);
  return out;
}

// Pixels that no receiver suits are gathered for themselves.
void mend(const GBuffer& gbuffer, const std::vector<std::uint32_t>& pixels, Gatherer& gatherer,
          std::vector<ProxyShade>& shades, Report& report) {
  report.count("pixels_gathered_alone", pixels.size());
  if (pixels.empty()) return;
  const ReceiverGroups groups = group_pixels(gbuffer, pixels);
  const Gathered gathered = gatherer.gather(groups, false, report);
  for (std::size_t i = 0; i < pixels.size(); ++i) shades[pixels[i]] = gathered.shades[groups.slots[i]];
}

}  // namespace

const std::vector<SoftGiMethod>& emissions() {
  static const std::vector<SoftGiMethod> all = {
      {"point", "the radiance at the point nearest to the receiver, all over the proxy's disk",
       interop::PROXY_POINT},
      {"averaged", "the mean radiance over the disk", interop::PROXY_AVERAGED},
      {"exact", "the radiance as it varies over the disk, by tables", interop::PROXY_EXACT},
  };
  return all;
}

const std::vector<SoftGiMethod>& exponentials() {
  static const std::vector<SoftGiMethod> all = {
      {"second-order", "1 + x + x*x/2, then squared up", interop::PROXY_SECOND_ORDER},
      {"hyb", "a + b x with fitted factors, then squared up (2006)", interop::PROXY_HYB},
  };
  return all;
}

const std::vector<SoftGiMethod>& upsamplers() {
  static const std::vector<SoftGiMethod> all = {
      {"plane", "bilinear, by distance from the pixel's tangent plane and by normals", interop::PROXY_PLANE},
      {"bilateral", "bilinear, by depth and normals (2007)", interop::PROXY_BILATERAL},
      {"bilinear", "bilinear alone", interop::PROXY_BILINEAR},
  };
  return all;
}

const std::vector<SoftGiMethod>& normalisations() {
  static const std::vector<SoftGiMethod> all = {
      {"cosine", "they give at most what they hide of an even sky", interop::PROXY_COSINE},
      {"solid-angle", "by the share of the sphere that they cover together (2007)",
       interop::PROXY_SOLID_ANGLE},
  };
  return all;
}

const std::vector<SoftGiMethod>& overlaps() {
  static const std::vector<SoftGiMethod> all = {
      {"exposed", "the share of it that its neighbours leave exposed", 1},
      {"whole", "all of it (2007)", 0},
  };
  return all;
}

Indirect shade_soft_gi(const GBuffer& gbuffer, const Proxies& proxies, const scene::Environment& environment,
                       const SoftGiParams& params, gpu::Device& device, Report& report,
                       Occlusion* occlusion) {
  check(gbuffer, proxies, params);
  const std::uint32_t upsampler = find_method(upsamplers(), params.upsample, "upsample").kind;
  ColourVector light;
  Influence influence{};
  {
    const PhaseTimer timer(report, "project environment");
    light = project(environment);
    influence = influence_of(light, params);
  }
  report.count("least_radiance", least_radiance(light));
  report.count("shadow_influence", influence.shadow);
  report.count("indirect_influence", influence.indirect);
  const PhaseTimer timer(report, "shade");
  const std::vector<ProxySphere> spheres = proxies.spheres();
  Gatherer gatherer(spheres, light, influence, params, device);
  const ReceiverGrid grid(gbuffer, params.rate);
  const ReceiverGroups groups = group_grid(gbuffer, grid);
  const Gathered gathered = gatherer.gather(groups, occlusion != nullptr, report);
  describe(gathered, groups, spheres.size(), report);
  if (occlusion) *occlusion = occlusion_of(gathered, groups, grid);
  if (params.rate == 1) return reflect(gbuffer, spread(gathered, groups), report);
  Upsampled upsampled = upsample(gbuffer, grid, groups, gathered.shades, upsampler, device, report);
  mend(gbuffer, upsampled.unsuited, gatherer, upsampled.shades, report);
  return reflect(gbuffer, upsampled.shades, report);
}

}  // namespace vsgl
