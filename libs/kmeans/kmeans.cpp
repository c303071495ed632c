#include "kmeans/kmeans.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/address.h"
#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "kmeans/centre_tree.h"
#include "kmeans/radix_sort.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/kmeans/assign.comp.glsl.h"
#include "spirv/kmeans/centres.comp.glsl.h"
#include "spirv/kmeans/lights.comp.glsl.h"
#include "spirv/kmeans/merge.comp.glsl.h"
#include "spirv/kmeans/sum.comp.glsl.h"

namespace vsgl {
namespace {

using gpu::Buffer;
using gpu::groups_for;
using interop::ClusterPart;
using interop::Feature;
using interop::Light;
using interop::Moments;
using interop::uvec2;

constexpr std::uint32_t group_size = 64, group_side = 8;
// Parts of one cluster that its light still merges one after another.
constexpr std::size_t last_parts = 2 * interop::KMEANS_RUN;
constexpr double settled_share = 1e-3;  // of the lit texels, that changed their cluster

struct CentresPush {
  interop::Texels texels;
  uvec2 chosen_at, centres_at;
};
struct AssignPush {
  interop::Texels texels;
  uvec2 nodes_at, keys_at, moved_at;
};
struct SumPush {
  interop::Texels texels;
  uvec2 keys_at, centres_at, parts_at;
};
struct MergePush {
  uvec2 items_at, parts_at;
  std::uint32_t items;
};
struct LightsPush {
  interop::Texels texels;
  uvec2 keys_at, parts_at, centres_at, lights_at, costs_at;
  std::uint32_t merges;
  float variance_floor;
  std::uint32_t lobe_filter;
};

std::size_t texels_of_layer(int size) {
  return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
}

Buffer upload_moments(LayerMoments layers, int size, gpu::Device& device) {
  const std::size_t texels = texels_of_layer(size), bytes = texels * sizeof(Moments);
  Buffer buffer(device, bytes * layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k)
    buffer.write(k * bytes, std::as_bytes(layers[k].first(texels)));
  return buffer;
}

std::size_t count_lit(LayerMoments layers, int size) {
  std::size_t lit = 0;
  for (const auto& layer : layers)
    lit += static_cast<std::size_t>(std::ranges::count_if(layer.first(texels_of_layer(size)),
                                                          [](const Moments& m) { return m.weight > 0; }));
  return lit;
}

interop::Texels describe(LayerMoments layers, int size, std::size_t clusters, const KmeansParams& params) {
  interop::Texels texels{};
  texels.clusters = static_cast<std::uint32_t>(clusters);
  texels.size = static_cast<std::uint32_t>(size);
  texels.layers = static_cast<std::uint32_t>(layers.size());
  texels.space = params.space;
  texels.scale = static_cast<float>(1 / params.scene_radius);
  // Within a layer squared distances stay below 2 + 4 normal_weight.
  texels.layer_step = static_cast<float>(2 + 2 * std::sqrt(params.normal_weight));
  texels.normal_scale = static_cast<float>(std::sqrt(params.normal_weight));
  return texels;
}

// Room for the parts of each merge: a part a run and cluster. Runs are merged until no cluster has many
// parts.
std::vector<Buffer> make_parts(std::size_t texels, std::size_t clusters, gpu::Device& device) {
  std::vector<Buffer> parts;
  std::size_t items = texels, of_cluster = texels;
  do {
    items = groups_for(items, interop::KMEANS_RUN) + clusters;
    of_cluster = groups_for(of_cluster, interop::KMEANS_RUN);
    parts.emplace_back(device, items * sizeof(ClusterPart));
  } while (of_cluster > last_parts);
  return parts;
}

// The texels on the device, their clusters, and the steps that make them.
class Clustering {
 public:
  Clustering(LayerMoments layers, int size, std::span<const std::uint32_t> centres,
             const KmeansParams& params, gpu::Device& device, Report& report);

  // Assigns the texels to their nearest centres, makes the clusters' lights and moves the centres.
  void iterate(Report& report);
  std::uint32_t texels_moved() { return moved_.download<std::uint32_t>(1).front(); }  // by the last iteration
  Clusters download();

 private:
  void assign(gpu::Commands& commands);
  void merge(gpu::Commands& commands);

  gpu::Device& device_;
  interop::Texels texels_;
  std::uint32_t count_;  // texels
  float variance_floor_;
  std::uint32_t lobe_filter_;
  gpu::ComputePipeline assign_, sum_, merge_, finish_;
  RadixSort sort_;
  CentreTree tree_;
  Buffer moments_, clusters_, centres_, moved_, lights_, costs_;
  std::vector<Buffer> parts_;  // of each merge
};

gpu::SpecializationConstants constants_for(const KmeansParams& params) {
  return {{0, params.normal_weight > 0 ? 1u : 0u}};
}

Clustering::Clustering(LayerMoments layers, int size, std::span<const std::uint32_t> centres,
                       const KmeansParams& params, gpu::Device& device, Report& report)
    : device_(device),
      texels_(describe(layers, size, centres.size(), params)),
      count_(static_cast<std::uint32_t>(layers.size() * texels_of_layer(size))),
      variance_floor_(static_cast<float>(params.variance_floor)),
      lobe_filter_(params.lobe_filter),
      assign_(device, assign_comp_spv, {}, sizeof(AssignPush), constants_for(params)),
      sum_(device, sum_comp_spv, {}, sizeof(SumPush), constants_for(params)),
      merge_(device, merge_comp_spv, {}, sizeof(MergePush)),
      finish_(device, lights_comp_spv, {}, sizeof(LightsPush), constants_for(params)),
      sort_(device, count_, static_cast<int>(std::bit_width(centres.size()))),
      tree_(device, texels_.clusters),
      moments_(upload_moments(layers, size, device)),
      clusters_(device, count_ * sizeof(std::uint32_t)),
      centres_(device, centres.size() * sizeof(Feature)),
      moved_(device, sizeof(std::uint32_t)),
      lights_(device, centres.size() * sizeof(Light)),
      costs_(device, centres.size() * sizeof(float)),
      parts_(make_parts(count_, centres.size(), device)) {
  texels_.moments_at = address_of(moments_);
  texels_.clusters_at = address_of(clusters_);
  clusters_.clear();
  const Buffer chosen = Buffer::from(device, centres);
  const CentresPush push{texels_, address_of(chosen), address_of(centres_)};
  const gpu::ComputePipeline pipeline(device, centres_comp_spv, {}, sizeof push, constants_for(params));
  gpu::Commands commands(device);
  if (needs_encoding(lobe_filter_)) encode_lobes(moments_, count_, lobe_filter_, device, commands);
  commands.dispatch("centres", pipeline, {}, push, {groups_for(texels_.clusters, group_size), 1, 1});
  commands.submit(report);
}

void Clustering::iterate(Report& report) {
  for (Buffer* results : {&moved_, &lights_, &costs_}) results->clear();
  for (Buffer& parts : parts_) parts.clear();
  gpu::Commands commands(device_);
  tree_.record(commands, centres_, "tree");
  assign(commands);
  sort_.record(commands, "sort");
  merge(commands);
  commands.submit(report);
}

void Clustering::assign(gpu::Commands& commands) {
  AssignPush push{texels_, address_of(tree_.nodes()), address_of(sort_.keys()), address_of(moved_)};
  push.texels.order_at = address_of(sort_.values());
  const std::uint32_t groups = groups_for(texels_.size, group_side);
  commands.dispatch("assign", assign_, {}, push, {groups, groups, texels_.layers});
}

void Clustering::merge(gpu::Commands& commands) {
  interop::Texels sorted = texels_;
  sorted.order_at = address_of(sort_.sorted_values());
  const uvec2 keys_at = address_of(sort_.sorted_keys()), centres_at = address_of(centres_);
  std::uint32_t runs = groups_for(count_, interop::KMEANS_RUN);
  const SumPush sum{sorted, keys_at, centres_at, address_of(parts_.front())};
  commands.dispatch("merge", sum_, {}, sum, {groups_for(runs, group_size), 1, 1});
  for (std::size_t k = 1; k < parts_.size(); ++k) {
    const std::uint32_t items = runs + texels_.clusters;
    runs = groups_for(items, interop::KMEANS_RUN);
    const MergePush push{address_of(parts_[k - 1]), address_of(parts_[k]), items};
    commands.dispatch("merge", merge_, {}, push, {groups_for(runs, group_size), 1, 1});
  }
  const LightsPush push{sorted,
                        keys_at,
                        address_of(parts_.back()),
                        centres_at,
                        address_of(lights_),
                        address_of(costs_),
                        static_cast<std::uint32_t>(parts_.size()),
                        variance_floor_,
                        lobe_filter_};
  commands.dispatch("merge", finish_, {}, push, {groups_for(texels_.clusters, group_size), 1, 1});
}

Clusters Clustering::download() {
  Clusters clusters;
  clusters.lights = lights_.download<Light>(texels_.clusters);
  clusters.cluster_of = clusters_.download<std::uint32_t>(count_);
  for (const float cost : costs_.download<float>(texels_.clusters))
    clusters.cost += static_cast<double>(cost);
  return clusters;
}

}  // namespace

Clusters cluster_texels(LayerMoments layers, int size, std::span<const std::uint32_t> centres,
                        const KmeansParams& params, gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "cluster");
  const auto settled = static_cast<std::size_t>(settled_share * static_cast<double>(count_lit(layers, size)));
  Clustering clustering(layers, size, centres, params, device, report);
  clustering.iterate(report);
  int iterations = 0;
  for (bool moving = true; moving && iterations < params.iterations; ++iterations) {
    clustering.iterate(report);
    moving = clustering.texels_moved() > settled;
  }
  Clusters clusters = clustering.download();
  clusters.iterations = iterations;
  return clusters;
}

}  // namespace vsgl
