#include "stages/lights/tree_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/interop_vec.h"
#include "math/lobe.h"
#include "math/moments.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using interop::Light;

// What is known of a node's texels. Directions are weighted by the luminance of the specular power or, where
// there is none, of all power.
struct Statistics {
  DoubleMoments moments;  // powers and weight are sums, W
  Vec3 shading_normal, incident;
  double shading_deficit = 0;  // 1 - |shading_normal|^2
  // Of specular texels alone:
  double alpha2 = 1;                           // mean alpha^2
  double inverse_square = 0;                   // mean 1 / distance^2 to the source, 1/m^2
  std::array<double, 4> specular_by_ndf = {};  // luminance of the specular power, W

  double specular() const { return luminance(moments.power_specular); }
};

Statistics of_texel(const RsmLayer& layer, std::size_t texel) {
  const interop::Surface& surface = layer.surface[texel];
  Statistics s;
  s.moments = to_double(layer.pyramid[texel]);
  s.shading_normal = to_double(surface.shading_normal);
  s.incident = direction_to_source(layer.light, s.moments.position);
  if (s.specular() <= 0) return s;
  s.alpha2 = static_cast<double>(surface.alpha) * static_cast<double>(surface.alpha);
  s.specular_by_ndf[surface.ndf] = s.specular();
  if (layer.light.type != LightType::directional) {
    const Vec3 to_source = layer.light.position - s.moments.position;
    s.inverse_square = 1 / dot(to_source, to_source);
  }
  return s;
}

using Children = std::array<Statistics, 4>;

void merge_lobes(const Children& children, Statistics& s) {
  const bool by_specular = s.specular() > 0;
  const auto weight = [&](std::size_t k) {
    return by_specular ? children[k].specular() : children[k].moments.weight;
  };
  const MeanSpread normal = merge_mean_spread(
      4, weight, [&](std::size_t k) { return children[k].shading_normal; },
      [&](std::size_t k) { return children[k].shading_deficit; });
  s.shading_normal = normal.mean;
  s.shading_deficit = normal.spread;
  double total = 0;
  for (std::size_t k = 0; k < 4; ++k) total += weight(k);
  for (std::size_t k = 0; k < 4; ++k) s.incident += weight(k) / total * children[k].incident;
  if (!by_specular) return;
  s.alpha2 = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    s.alpha2 += weight(k) / total * children[k].alpha2;
    s.inverse_square += weight(k) / total * children[k].inverse_square;
    for (std::size_t ndf = 0; ndf < 4; ++ndf) s.specular_by_ndf[ndf] += children[k].specular_by_ndf[ndf];
  }
}

Statistics merge(const Children& children) {
  const std::array<DoubleMoments, 4> moments = {children[0].moments, children[1].moments, children[2].moments,
                                                children[3].moments};
  constexpr std::array<double, 4> sums = {1, 1, 1, 1};
  Statistics s;
  s.moments = merge_moments(moments, sums);
  merge_lobes(children, s);
  return s;
}

// A mean direction; where directions cancel out, another.
interop::vec3 unit(Vec3 mean, interop::vec3 otherwise) {
  const double l = length(mean);
  return l > 0 ? to_float(mean / l) : otherwise;
}

class Summary {
 public:
  Summary(const Rsm& rsm, const TexelTree& tree, std::vector<Light>& lights)
      : rsm_(rsm),
        tree_(tree),
        lights_(lights),
        texels_per_layer_(static_cast<std::size_t>(rsm.size) * static_cast<std::size_t>(rsm.size)),
        variance_floor_(footprint_floor * rsm.scene_radius * footprint_floor * rsm.scene_radius) {}

  // Makes the lights of a node and of all below it. Large children are tasks of their own.
  Statistics summarise(std::uint32_t index) {
    const TreeNode& node = tree_.nodes[index];
    if (node.children == 0) {
      const std::uint32_t texel = tree_.texels[node.begin].index;
      const Statistics s = of_texel(layer_of(texel), texel % texels_per_layer_);
      set_light(index, s, texel);
      return s;
    }
    constexpr std::uint32_t kTask = 1024;
    Children children;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t child = node.children + k;
      if (tree_.nodes[child].size() == 0) continue;
#pragma omp task shared(children) if (tree_.nodes[child].size() > kTask)
      children[k] = summarise(child);
    }
#pragma omp taskwait
    const Statistics s = merge(children);
    set_light(index, s, nearest_texel(node, s.moments.position));
    for (std::uint32_t k = 0; k < 4; ++k)
      if (tree_.nodes[node.children + k].size() == 0) set_empty(node.children + k, lights_[index]);
    return s;
  }

 private:
  const RsmLayer& layer_of(std::uint32_t texel) const {
    return rsm_.layers[texel / texels_per_layer_];
  }

  // Of texels as near as rounding can tell the first: the mean of a few often lies between two.
  std::uint32_t nearest_texel(const TreeNode& node, Vec3 position) const {
    constexpr double kTie = 1e-3;
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      const std::uint32_t texel = tree_.texels[k].index;
      const Vec3 d = to_double(layer_of(texel).pyramid[texel % texels_per_layer_].position) - position;
      if (dot(d, d) >= (1 - kTie) * least) continue;
      least = dot(d, d);
      nearest = texel;
    }
    return nearest;
  }

  void set_light(std::uint32_t index, const Statistics& s, std::uint32_t texel) {
    const TreeNode& node = tree_.nodes[index];
    const RsmLayer& layer = layer_of(texel);
    const interop::Surface& surface = layer.surface[texel % texels_per_layer_];
    const DoubleMoments& m = s.moments;
    Light& light = lights_[index];
    light.position = to_float(m.position);
    light.variance = static_cast<float>(std::max(0.5 * m.spread, variance_floor_));
    light.power_diffuse = to_float(m.power_diffuse);
    if (luminance(m.power_diffuse) > 0) {
      const SgLobe lobe = lobe_decode({m.diffuse_mean, m.diffuse_deficit});
      light.diffuse_axis = to_float(lobe.axis);
      light.diffuse_sharpness = static_cast<float>(lobe.sharpness);
    }
    light.normal = unit(m.normal_mean, surface.normal);
    light.normal_deficit = static_cast<float>(m.normal_deficit);
    light.shading_normal = unit(s.shading_normal, surface.shading_normal);
    light.incident =
        unit(s.incident, to_float(direction_to_source(layer.light, to_double(surface.position))));
    light.alpha = 1;
    if (s.specular() > 0) set_specular(light, s);
    light.origin = surface.position;
    light.texel = static_cast<interop::uint>(texel % texels_per_layer_);
    light.layer = static_cast<interop::uint>(texel / texels_per_layer_);
    light.level = 0.5f * std::log2(static_cast<float>(node.size()));
    light.children = node.children;
  }

  void set_specular(Light& light, const Statistics& s) {
    const DoubleMoments& m = s.moments;
    const SgLobe lobe = lobe_decode({m.specular_mean, m.specular_deficit});
    light.power_specular = to_float(m.power_specular);
    light.specular_axis = to_float(lobe.axis);
    light.specular_sharpness = static_cast<float>(lobe.sharpness);
    light.alpha = static_cast<float>(std::sqrt(s.alpha2));
    const auto& powers = s.specular_by_ndf;
    light.ndf = static_cast<interop::uint>(std::max_element(powers.begin(), powers.end()) - powers.begin());
    // Over a footprint of variance v the direction to a source at distance d varies by v / d^2 per axis, half
    // vectors by a quarter of that; alpha^2 is twice their variance per axis.
    light.lobe_variance = static_cast<float>(s.shading_deficit + 0.25 * m.spread * s.inverse_square);
    light.shading_deficit = static_cast<float>(s.shading_deficit);
  }

  void set_empty(std::uint32_t index, const Light& parent) {
    Light& light = lights_[index];
    light = parent;
    light.variance = static_cast<float>(variance_floor_);
    light.power_diffuse = light.power_specular = light.diffuse_axis = light.specular_axis = {};
    light.diffuse_sharpness = light.specular_sharpness = light.normal_deficit = light.level = 0;
    light.lobe_variance = light.shading_deficit = 0;
    light.alpha = 1;
    light.ndf = interop::NDF_NONE;
    light.children = 0;
  }

  const Rsm& rsm_;
  const TexelTree& tree_;
  std::vector<Light>& lights_;
  std::size_t texels_per_layer_;
  double variance_floor_;
};

}  // namespace

std::vector<Light> tree_lights(const Rsm& rsm, const TexelTree& tree) {
  std::vector<Light> lights(tree.nodes.size());
  Summary summary(rsm, tree, lights);
#pragma omp parallel
#pragma omp single
  if (!lights.empty()) summary.summarise(0);
  return lights;
}

}  // namespace vsgl
