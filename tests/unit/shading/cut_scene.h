#pragma once

// Cuts of the box scene, and their sums in double precision.

#include <functional>

#include "cluster/borders.h"
#include "cluster/cluster.h"
#include "math/fvpl.h"
#include "run.h"
#include "stages/shading/cut_blocks.h"
#include "stages/shading/cut_pixels.h"
#include "stages/shading/methods.h"

namespace vsgl::test {

// All lights in every tile; no visibility.
inline Cut whole_cut(const GBuffer& gbuffer, const Lights& lights) {
  Cut cut;
  cut.width = gbuffer.width;
  cut.height = gbuffer.height;
  cut.lights = static_cast<int>(lights.lights.size());
  const auto count = static_cast<std::uint32_t>(lights.lights.size());
  for (int tile = 0; tile < cut.columns() * cut.rows(); ++tile) {
    cut.tiles.push_back({static_cast<std::uint32_t>(cut.nodes.size()), count, 0.01f});
    for (std::uint32_t i = 0; i < count; ++i) cut.nodes.push_back(i);
  }
  return cut;
}

// Gives each entry a mask of its own: `sees(entry, x, y)` for the pixel of its tile.
inline void add_masks(Cut& cut, const std::function<bool(std::size_t, std::uint32_t, std::uint32_t)>& sees) {
  cut.mask_words.assign(interop::MASK_WORDS, 0xFFFFFFFFu);
  for (std::size_t e = 0; e < cut.nodes.size(); ++e) {
    cut.masks.push_back(static_cast<std::uint32_t>(cut.mask_words.size() / interop::MASK_WORDS));
    std::uint32_t words[interop::MASK_WORDS] = {};
    for (std::uint32_t y = 0; y < interop::TILE; ++y)
      for (std::uint32_t x = 0; x < interop::TILE; ++x) {
        const std::uint32_t bit = y * interop::TILE + x;
        if (sees(e, x, y)) words[bit / 32] |= 1u << (bit % 32);
      }
    cut.mask_words.insert(cut.mask_words.end(), std::begin(words), std::end(words));
  }
}

inline Indirect shade_by(const Cut& cut, const GBuffer& gbuffer, const Lights& lights,
                         const ShadingParams& params = {}, Report* report = nullptr) {
  Report unused;
  return shade_cut(gbuffer, lights, cut, params, shared_device(), report ? *report : unused);
}

// Specular BRDF times cosine, 1/sr, with half vectors spread by a far footprint as docs/shading.md tells:
// alpha^2 grows by the geometric mean of 1 / (2 sharpness) and 1 / (2 sharpness cos^2).
inline double distant_specular(const SpecularReceiver& r, Vec3 u, double sharpness) {
  const Vec3 light = specular_local(r, u), h = Vec3{r.sin_view, 0, r.cos_view} + light;
  if (light.z <= 0) return 0;
  const double spread = std::min(0.5 / (sharpness * r.cos_view), 1.0), hh = std::max(dot(h, h), 1e-12);
  const double sin2 = (h.x * h.x + h.y * h.y) / hh, cos2 = h.z * h.z / hh;
  const bool is_ggx = r.ndf == interop::NDF_GGX;
  const double alpha2 = is_ggx ? r.alpha2 : std::min(r.alpha2 + spread, 1.0);
  const double density =
      is_ggx ? ggx_spread_d(alpha2, spread, sin2, cos2) : ndf_density(r.ndf, alpha2, sin2, cos2);
  return density / (4 * r.cos_view * (1 + r.view_lambda + smith_lambda(r.ndf, alpha2, light.z)));
}

// Bounds of the pixels that are shaded as one block.
struct Box {
  Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};

  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  double distance2(Vec3 p) const {
    const Vec3 nearest{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                       std::clamp(p.z, low.z, high.z)};
    return dot(p - nearest, p - nearest);
  }
};

// Of each pixel the box about its block, by which docs/shading.md chooses the form of a cluster.
inline std::vector<Box> block_boxes(const GBuffer& gbuffer) {
  std::vector<Box> boxes(gbuffer.pixels.size());
  const std::vector<std::uint8_t> kinds = pixel_kinds(gbuffer);
  std::vector<std::uint8_t> seen(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) seen[i] = kinds[i] != kBackground;
  for (const CutReceivers& receivers : sort_into_blocks(gbuffer, kinds, seen, true))
    for (const CutReceivers::Block& block : receivers.blocks) {
      const auto pixels = std::span(receivers.pixels).subspan(block.first, block.count);
      Box box;
      for (const std::uint32_t pixel : pixels) box.add(to_double(gbuffer.pixels[pixel].position));
      for (const std::uint32_t pixel : pixels) boxes[pixel] = box;
    }
  return boxes;
}

// What a cluster's light meets: the forms of the classes that docs/shading.md tells. `nearest`: square of the
// block's distance in standard deviations.
inline FvplReflection cut_reflection(const SpecularReceiver& r, const interop::Cluster& c,
                                     const FvplView& view, double nearest) {
  if (c.normal_sharpness <= interop::CLUSTER_FLAT || !fvpl_is_point(nearest, 0))
    return fvpl_extended(r, c, view);
  FvplReflection far = fvpl_point(r, c, view);
  if (r.ndf != interop::NDF_NONE)
    far.specular = view.inverse_d2 * distant_specular(r, view.u, view.sharpness);
  return far;
}

// Sum over the entries of the pixel's tile that it sees; `box` is its block's. Normals must not be bumped.
inline Radiance cut_sum(const GBuffer& gbuffer, std::size_t index,
                        const std::vector<interop::Cluster>& clusters, const Cut& cut, const Box& box) {
  const OraclePixel p(gbuffer, index);
  Radiance sum;
  if (p.surface.id == interop::NO_INSTANCE) return sum;
  const SpecularReceiver r = specular_receiver(p.surface.ndf, p.surface.alpha, p.normal, p.view);
  const std::uint32_t x = static_cast<std::uint32_t>(index) % static_cast<std::uint32_t>(gbuffer.width),
                      y = static_cast<std::uint32_t>(index) / static_cast<std::uint32_t>(gbuffer.width);
  const Cut::Tile& tile =
      cut.tiles[y / interop::TILE * static_cast<std::uint32_t>(cut.columns()) + x / interop::TILE];
  const std::uint32_t bit = y % interop::TILE * interop::TILE + x % interop::TILE;
  for (std::uint32_t e = tile.first; e < tile.first + tile.count; ++e) {
    if (cut.has_visibility() &&
        (cut.mask_words[cut.masks[e] * interop::MASK_WORDS + bit / 32] >> bit % 32 & 1u) == 0)
      continue;
    const interop::Cluster& c = clusters[cut.nodes[e]];
    const auto inverse_variance = static_cast<double>(c.inverse_variance);
    const FvplView view = fvpl_view(to_double(c.position) - p.position, inverse_variance);
    const double nearest = box.distance2(to_double(c.position)) * inverse_variance;
    const Vec3 emission = fvpl_emission(c, view.u, view.inverse_d2);
    const FvplReflection reflection = cut_reflection(r, c, view, nearest);
    sum.diffuse += to_double(p.surface.diffuse) * emission * reflection.diffuse;
    sum.specular += to_double(p.surface.specular) * emission * reflection.specular;
  }
  const double gain = static_cast<double>(gain_at(gbuffer, cut, static_cast<std::uint32_t>(index)));
  return {gain * sum.diffuse, gain * sum.specular};
}

// Largest difference of a layer, over its largest value.
inline double difference(const std::vector<interop::vec3>& a, const std::vector<interop::vec3>& b) {
  double peak = 0, worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    peak = std::max(peak, length(to_double(b[i])));
    worst = std::max(worst, length(to_double(a[i]) - to_double(b[i])));
  }
  return peak > 0 ? worst / peak : worst;
}

}  // namespace vsgl::test
