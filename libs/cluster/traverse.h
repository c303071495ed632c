#pragma once

// The cut through a light tree that a tile needs, on the CPU. Shared by light-cut and by the visibility of
// cuts.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "interop/cluster.h"

namespace vsgl {

// Pixels of a tile on which the cut is decided: {0, 5, 10, 15}^2, so that the corners of neighbouring tiles
// nearly touch. Sample 4 j + i is pixel (5 i, 5 j), or, where that is background or beyond the image, the
// nearest pixel of its cell that is not; a cell without any has none.
inline constexpr int kTileSamples = 16;
struct TileSamples {
  std::array<std::uint32_t, kTileSamples> pixel{};  // of the image
  std::uint32_t present = 0;                        // bit k: sample k exists
};
TileSamples tile_samples(const GBuffer& gbuffer, int tile);
// The 4x4 pixels from (left, top) on, those that are in the image and no background.
TileSamples block_pixels(const GBuffer& gbuffer, int left, int top);

struct CutCriterion {
  // Of the tile, estimated: eps is lowered until it is no larger.
  double error = std::numeric_limits<double>::infinity();
  double caution = 1;             // multiplies the estimate
  float threshold = 0.003F;       // eps at first: accepted values and differences over the sample's light
  float floor = 0;                // radiance added to the sample's light (2% of the image's mean), W/(m^2 sr)
  std::uint32_t start_level = 3;  // of the tree: its nodes, and the leaves above, are all evaluated
};

// Which samples see a node: bit k for sample k. Called once for each node that the traversal evaluates.
// Empty: all see all.
using NodeVisibility = std::function<std::uint32_t(std::uint32_t node, const TileSamples& samples)>;

// The light that a tile's cut sends to the pixels of the ring that it shares with its neighbours (borders.h).
struct TileRing {
  std::array<float, kTileSamples> light{};  // luminance, W/(m^2 sr)
  std::uint32_t present = 0;                // bit k: place k has a pixel that counts
  std::size_t entries = 0;                  // of the cut
};

struct TileCut {
  struct Entry {
    std::uint32_t node = 0;
    std::uint32_t visible = 0;  // bit k: sample k sees it
    float share = 0;  // the largest share, over the samples, that its unshadowed light has in all light
  };
  // Each lit leaf is one of them or below exactly one. In ascending order of nodes; those that no sample sees
  // are among them: other pixels may.
  std::vector<Entry> entries;
  double error = 0;  // estimate, relative, RMS over the samples
  TileRing ring;     // of cut_all()
  std::size_t samples = 0;
  std::size_t evaluations = 0;  // nodes times samples
};

// Adds all tiles of an image, row by row.
void append(Cut& cut, std::span<const TileCut> tiles);

// A cut is chosen by luminance. All inputs must outlive it; clusters: of pack_clusters(lights). cut() may be
// called from many threads; its result depends on nothing else, and is the same on every processor.
class TreeTraversal {
 public:
  // Throws invalid_data when `lights` is not a tree.
  TreeTraversal(const GBuffer& gbuffer, const Lights& lights, const std::vector<interop::Cluster>& clusters);

  // For a relative error of the image (RMSE over its mean; docs/cut.md has the calibration): floor from the
  // mean unshadowed light on some of the pixels, and the level to start at.
  CutCriterion criterion(double error) const;

  TileCut cut(const TileSamples& samples, const CutCriterion& criterion,
              const NodeVisibility& visibility) const;
  // What `tile`, whose cut that is, sends to its ring. Entries whose share is below `small` are not looked at
  // from there where the tile's samples agree.
  TileRing ring(int tile, const TileCut& cut, const NodeVisibility& visibility, float small) const;
  // Of all tiles, row by row, where every sample sees every node.
  std::vector<TileCut> cut_all(const CutCriterion& criterion) const;

 private:
  std::vector<std::uint32_t> start_nodes(std::uint32_t level) const;
  // Mean luminance of the unshadowed radiance over the samples of some tiles.
  double mean_light(std::span<const std::uint32_t> nodes) const;

  const GBuffer& gbuffer_;
  const std::vector<interop::Cluster>& clusters_;
  const Lights& lights_;
  bool sharp_ = false;  // some specular lobe, lit or seen, is narrow
};

}  // namespace vsgl
