// Shading by a cut through a light tree. docs/shading.md describes it.

#include <algorithm>
#include <array>

#include "cluster/borders.h"
#include "interop/shading.h"
#include "math/interop_vec.h"
#include "stages/shading/cut_pass.h"
#include "stages/shading/cut_pixels.h"
#include "stages/shading/methods.h"

namespace vsgl {
namespace {

constexpr const char* kPhase = "shade";

// Sums of all pixels, without reflectances: zero for background, and for what is not yet shaded.
struct Image {
  std::vector<interop::vec3> diffuse, specular;

  explicit Image(std::size_t pixels) : diffuse(pixels), specular(pixels) {}
};

void shade_pixels(const GBuffer& gbuffer, const Cut& cut, std::span<const std::uint8_t> kinds,
                  std::span<const std::uint8_t> shaded, CutPass& pass, bool skip, Image& image,
                  Report& report) {
  const std::vector<CutReceivers> lists = sort_into_blocks(gbuffer, kinds, shaded, skip);
  for (const CutReceivers& receivers : lists) pass.prepare(receivers);
  for (const CutReceivers& receivers : lists) {
    const std::vector<interop::CutSums> sums = pass.run(receivers, CutPass::kWords, report);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::uint32_t pixel = receivers.pixels[i];
      const auto gain = static_cast<double>(gain_at(gbuffer, cut, pixel));
      image.diffuse[pixel] = to_float(gain * to_double(sums[i].diffuse));
      image.specular[pixel] = to_float(gain * to_double(sums[i].specular));
    }
  }
}

std::vector<std::uint8_t> all_seen(std::span<const std::uint8_t> kinds) {
  std::vector<std::uint8_t> shaded(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) shaded[i] = kinds[i] != kBackground;
  return shaded;
}

// Diffuse pixels from samples at half resolution, with an exact second pass where these differ too much for
// the error that the cut aims at.
void shade_at_half(const GBuffer& gbuffer, const Cut& cut, std::span<const std::uint8_t> kinds, CutPass& pass,
                   bool skip, Image& image, Report& report) {
  const HalfResolution half(gbuffer, kinds, cut.error);
  shade_pixels(gbuffer, cut, kinds, half.shaded(), pass, skip, image, report);
  const std::vector<std::uint8_t> rejected = half.interpolate(image.diffuse);
  shade_pixels(gbuffer, cut, kinds, rejected, pass, skip, image, report);
  report.count("diffuse_exact_pixels", half.exact_pixels() + static_cast<std::size_t>(std::count(
                                                                 rejected.begin(), rejected.end(), 1)));
}

interop::vec3 product(interop::vec3 a, interop::vec3 b, float share) {
  return {a.x * b.x * share, a.y * b.y * share, a.z * b.z * share};
}

Indirect compose(const GBuffer& gbuffer, const Cut& cut, const Image& image, bool specular) {
  Indirect out;
  out.width = gbuffer.width;
  out.height = gbuffer.height;
  const std::size_t pixels = gbuffer.pixels.size();
  out.diffuse.resize(pixels);
  if (specular) out.specular.resize(pixels);
  out.cut_size.resize(pixels);
  out.error_estimate.resize(pixels);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < pixels; ++i) {
    const float share = cut.visibility.empty() ? 1.0f : cut.visibility[i];
    const interop::Surface& s = gbuffer.pixels[i];
    out.diffuse[i] = product(s.diffuse, image.diffuse[i], share);
    if (specular) out.specular[i] = product(s.specular, image.specular[i], share);
    if (s.id == interop::NO_INSTANCE) continue;
    const std::size_t x = i % static_cast<std::size_t>(gbuffer.width) / interop::TILE,
                      y = i / static_cast<std::size_t>(gbuffer.width) / interop::TILE;
    const Cut::Tile& tile = cut.tiles[y * static_cast<std::size_t>(cut.columns()) + x];
    out.cut_size[i] = static_cast<float>(tile.count);
    out.error_estimate[i] = tile.error;
  }
  return out;
}

void report_classes(std::span<const std::uint8_t> kinds, const CutClusters& clusters, const Cut& cut,
                    bool skip, Report& report) {
  std::array<std::size_t, 256> pixels{};
  for (const std::uint8_t kind : kinds) ++pixels[kind];
  const std::size_t background = pixels[kBackground], diffuse = pixels[interop::NDF_NONE],
                    specular = kinds.size() - background - diffuse;
  report.count("pixels_diffuse", diffuse);
  report.count("pixels_specular", specular);
  report.count("clusters", clusters.clusters.size());
  if (background > 0) report.skipped("background", std::to_string(background) + " pixels see nothing");
  if (!skip) return;
  if (specular == 0) report.skipped("specular reflection", "no pixel has a specular lobe");
  if (clusters.ndf == interop::NDF_NONE)
    report.skipped("specular emission", "no cluster has a specular lobe");
  if (!cut.has_visibility()) report.skipped("visibility", "the cut has none");
}

void report_counts(const CutCounts& counts, std::size_t seen, bool skip, Report& report) {
  report.count("items_plain", counts.plain);
  report.count("items_glossy", counts.glossy);
  report.count("items_middle", counts.middle);
  report.count("items_near", counts.near);
  report.count("evaluations", counts.evaluations);
  report.count("evaluations_per_pixel",
               seen > 0 ? static_cast<double>(counts.evaluations) / static_cast<double>(seen) : 0.0);
  if (skip && counts.dark > 0)
    report.skipped("clusters that face away",
                   std::to_string(counts.dark) + " items that send nothing to a block");
  if (skip && counts.unseen > 0)
    report.skipped("occluded clusters",
                   std::to_string(counts.unseen) + " items that no pixel of a block sees");
}

}  // namespace

Indirect shade_cut(const GBuffer& gbuffer, const Lights& lights, const Cut& cut, const ShadingParams& params,
                   gpu::Device& device, Report& report) {
  const PhaseTimer timer(report, kPhase);
  const std::vector<std::uint8_t> kinds = pixel_kinds(gbuffer);
  const CutClusters clusters = gather_clusters(lights, cut);
  report_classes(kinds, clusters, cut, params.skip, report);
  CutPass pass(gbuffer, cut, clusters, params.skip, device);
  Image image(gbuffer.pixels.size());
  if (params.diffuse_scale == 2)
    shade_at_half(gbuffer, cut, kinds, pass, params.skip, image, report);
  else
    shade_pixels(gbuffer, cut, kinds, all_seen(kinds), pass, params.skip, image, report);
  report_counts(
      pass.counts(),
      gbuffer.pixels.size() - static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), kBackground)),
      params.skip, report);
  return compose(gbuffer, cut, image, !params.skip || gbuffer.has_specular());
}

}  // namespace vsgl
