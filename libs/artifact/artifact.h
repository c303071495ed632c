#pragma once

// The typed intermediates that the tools exchange; docs/artifacts.md is their contract. Each read_*()
// validates: schema and version, parts, channels, types, sizes, finite values and documented ranges; errors
// name file, part, channel and pixel. Each write() takes the temporary path of an OutputSet.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "artifact/pyramid.h"
#include "base/provenance.h"
#include "interop/chain.h"
#include "interop/cluster.h"
#include "interop/light.h"
#include "interop/model.h"
#include "interop/moments.h"
#include "interop/surface.h"
#include "math/light_source.h"
#include "math/vec.h"

namespace vsgl {

// What the camera sees: width x height pixels, row by row from the top-left. Positions relative to `anchor`
// (world, m).
struct GBuffer {
  int width = 0, height = 0;
  Vec3 anchor;
  Vec3 camera;              // position relative to the anchor
  double scene_radius = 1;  // of the scene's bounding sphere, m
  std::vector<interop::Surface> pixels;

  bool has_specular() const;  // any pixel with an NDF
};
void write(const std::filesystem::path& path, const GBuffer& gbuffer, const Provenance& provenance);
GBuffer read_gbuffer(const std::filesystem::path& path);

// One view of one light. surface and flux: size x size texels, those outside width x height are empty.
struct RsmLayer {
  std::string name;  // "key", or "lamp.px" for a cube face: names the EXR parts
  LightSource light;
  std::vector<interop::Surface> surface;
  std::vector<interop::Moments> pyramid;  // all levels, see pyramid.h
};
struct Rsm {
  int size = 0;               // power of two: texels a side, padding included
  int width = 0, height = 0;  // rendered part
  Vec3 anchor;
  double scene_radius = 1;
  std::vector<RsmLayer> layers;

  std::size_t texel_count() const {
    return layers.size() * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  }
  bool has_specular() const;
};
void write(const std::filesystem::path& path, const Rsm& rsm, const Provenance& provenance);
Rsm read_rsm(const std::filesystem::path& path);

// Sampling density over the texels of all layers, mean 1 over all of them (or all zero: nothing emits), with
// its mean pyramid.
struct Pdf {
  int size = 0;
  std::string method;
  struct Layer {
    std::string name;            // of the RSM layer
    std::vector<float> pyramid;  // means; level 0 first
  };
  std::vector<Layer> layers;
};
void write(const std::filesystem::path& path, const Pdf& pdf, const Provenance& provenance);
Pdf read_pdf(const std::filesystem::path& path);

// What a list of lights holds: lights on surfaces, or lights of an environment, infinitely far away. Those
// have no position; their power is what arrives on a plane that faces them, W/m^2, and their diffuse lobe its
// directions, with the axis along the light. Their anchor is 0 and their scene's radius 1: they fit any
// scene.
enum class LightsKind { points, environment };

// Markov chains that sample an RSM (vsgl-gen --method metropolis) and go on in the next frame.
struct Chains {
  std::vector<interop::Chain> states;
  int steps = 0;  // mutations of each, so far
};

// Virtual lights, or a tree of them: all nodes, level by level from the root. `anchor` as in the RSM.
struct Lights {
  LightsKind kind = LightsKind::points;
  std::string method;  // of vsgl-gen
  Vec3 anchor;
  double scene_radius = 1;
  int requested = 0;  // samples drawn; lights without power are dropped
  std::vector<interop::Light> lights;
  std::vector<std::uint32_t>
      levels;     // of a tree: first light of each level, and the number of lights; empty: a list
  Chains chains;  // of the method metropolis

  bool has_specular() const;
  bool is_tree() const { return !levels.empty(); }
};
// A level of a tree as a list that lacks no power: the level's nodes and the leaves above it, in their order.
// `levels` as in Lights.
std::vector<std::uint32_t> level_nodes(std::span<const interop::Light> lights,
                                       std::span<const std::uint32_t> levels, std::size_t level);
void write(const std::filesystem::path& path, const Lights& lights, const Provenance& provenance);
Lights read_lights(const std::filesystem::path& path);

// Shadow maps of all lights in one atlas: tile i at column i % columns, row i / columns; hemi-octahedral
// about `axis`.
struct ShadowMaps {
  int tile = 64;    // texels a side
  int columns = 0;  // tiles a row of the atlas
  Vec3 anchor;
  double bias_disk_radius = 0;  // rho: radius of a point's disk, m (absolute bias is rho/4)
  double normal_offset = 1;     // in texels
  double slope_bias = 0.1;      // in texels per tangent, tangent clamped at 1.5
  double relative_bias = 0.02;
  struct View {
    interop::vec3 origin;  // m, relative to the anchor
    interop::vec3 axis;    // unit: hemisphere that the map covers
  };
  std::vector<View> views;
  std::vector<float> inverse_distance;  // 1/m, 0 = empty (unoccluded); (columns*tile) x (rows*tile)

  int rows() const { return columns == 0 ? 0 : (static_cast<int>(views.size()) + columns - 1) / columns; }
};
void write(const std::filesystem::path& path, const ShadowMaps& maps, const Provenance& provenance);
ShadowMaps read_shadow_maps(const std::filesystem::path& path);

// Exact visibility of every light from every pixel. Bit i % 32 of word i / 32 of a pixel belongs to light i:
// 1 = visible. Background pixels see nothing.
struct VisibilityBits {
  int width = 0, height = 0;
  int lights = 0;
  Vec3 anchor;
  std::vector<std::uint32_t> words;  // word by word, each width * height pixels row by row

  int words_per_pixel() const { return (lights + 31) / 32; }
  bool visible(std::size_t light, std::size_t pixel) const {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return (words[light / 32 * pixels + pixel] >> (light % 32) & 1U) != 0;
  }
};
void write(const std::filesystem::path& path, const VisibilityBits& bits, const Provenance& provenance);
VisibilityBits read_visibility_bits(const std::filesystem::path& path);

// The nodes of a light tree that each tile of an image needs, as light-cut chooses them, and which of a
// tile's pixels see them, where ismap has found that out.
struct Cut {
  static constexpr std::size_t kRing =
      16;  // pixels around a tile where its light is made that of its neighbours
  struct Tile {
    std::uint32_t first = 0, count = 0;  // entries of this tile
    float error = 0;                     // estimated relative error (RMS over the tile) of what was cut off
    // What the tile's light is multiplied by on its ring (cluster/borders.h), from where it fades into the
    // tile.
    std::array<float, kRing> gain{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  };
  int width = 0,
      height = 0;  // of the image; tiles of interop::TILE pixels a side, row by row, cut off at its edges
  Vec3 anchor;
  int lights = 0;    // of the tree
  double error = 0;  // that was aimed at, relative
  std::vector<Tile> tiles;
  std::vector<std::uint32_t> nodes;  // of every entry: the light's index
  std::vector<std::uint32_t>
      masks;  // of every entry: which mask, 0: all pixels see the node. Empty: visibility is not known
  std::vector<std::uint32_t> mask_words;  // MASK_WORDS a mask, 1 = visible; mask 0 has all bits set
  // Visible share of each pixel's light, 0..1: multiplies all that the entries shade, besides their masks.
  // Row by row, 1 for background; empty: 1 everywhere. A cut with it has masks, too.
  std::vector<float> visibility;

  int columns() const {
    return (width + static_cast<int>(interop::TILE) - 1) / static_cast<int>(interop::TILE);
  }
  int rows() const {
    return (height + static_cast<int>(interop::TILE) - 1) / static_cast<int>(interop::TILE);
  }
  bool has_visibility() const { return !mask_words.empty(); }
};
void write(const std::filesystem::path& path, const Cut& cut, const Provenance& provenance);
Cut read_cut(const std::filesystem::path& path);

// Every pixel sees every light.
struct Unshadowed {
  int lights = 0;
  Vec3 anchor;
};
void write(const std::filesystem::path& path, const Unshadowed& unshadowed, const Provenance& provenance);

// How the lights are seen: what ismap writes and shade looks up. `read_visibility` tells them apart by
// schema.
using Visibility = std::variant<ShadowMaps, VisibilityBits, Cut, Unshadowed>;
void write(const std::filesystem::path& path, const Visibility& visibility, const Provenance& provenance);
Visibility read_visibility(const std::filesystem::path& path);

// Radiance per pixel, W/(m^2 sr). Empty vectors are layers that were not computed and are not in the file.
struct Indirect {
  int width = 0, height = 0;
  std::vector<interop::vec3> diffuse,
      specular;  // of the indirect light; the file also holds their sum `indirect`
  std::vector<interop::vec3> direct;
  std::vector<float> cancellation;    // fraction of the pixel's indirect luminance from lights whose SG
                                      // approximation was cancelled
  std::vector<float> cut_size;        // entries of the cut of the pixel's tile
  std::vector<float> error_estimate;  // relative, of what the cut of the pixel's tile leaves out
  int passes = 1;                     // of progressive rendering, whose mean this is
};
void write(const std::filesystem::path& path, const Indirect& indirect, const Provenance& provenance);
Indirect read_indirect(const std::filesystem::path& path);

// Ground truth: `radiance` without its cancellation layer, and the variance of the mean of its indirect
// light.
struct Reference {
  Indirect radiance;
  std::vector<interop::vec3> variance;  // per channel, (W/(m^2 sr))^2, of diffuse + specular
  std::string strategy;                 // light | brdf | mis
  std::uint64_t samples = 0;            // a pixel and strategy
  int passes = 0;                       // independent estimates that the variance comes from, >= 2
};
void write(const std::filesystem::path& path, const Reference& reference, const Provenance& provenance);
Reference read_reference(const std::filesystem::path& path);

}  // namespace vsgl
