#pragma once

// The cut through a light tree that a tile needs, on the CPU. Shared by light-cut and by the visibility of
// cuts.

#include <array>
#include <cstdint>
#include <functional>
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

struct CutCriterion {
  double threshold = 0.003;       // eps: accepted values and differences, relative to the sample's light
  double floor = 0;               // radiance added to the sample's light (2% of the image's mean), W/(m^2 sr)
  std::uint32_t start_level = 3;  // of the tree: its nodes are all evaluated
};

// Which samples see a node: bit k for sample k. Called once for each node that the traversal evaluates.
// Empty: all see all.
using NodeVisibility = std::function<std::uint32_t(std::uint32_t node, const TileSamples& samples)>;

struct TileCut {
  struct Entry {
    std::uint32_t node = 0;
    std::uint32_t visible = 0;  // bit k: sample k sees it
    float share = 0;  // the largest share, over the samples, that its unshadowed light has in all light
  };
  std::vector<Entry> entries;   // nodes that no sample sees are among them: other pixels may
  double error = 0;             // estimate, relative, RMS over the samples
  std::size_t evaluations = 0;  // nodes times samples
};

// Keeps what it needs of a tree and a G-buffer (both must outlive it). cut() may be called from many threads;
// its result depends on nothing else.
class TreeTraversal {
 public:
  TreeTraversal(const GBuffer& gbuffer, const Lights& lights, const std::vector<interop::Cluster>& clusters);
  TileCut cut(int tile, const TileSamples& samples, const CutCriterion& criterion,
              const NodeVisibility& visibility) const;
  // Mean unshadowed radiance of the image (luminance), from the nodes of the start level on some of its
  // pixels.
  double mean_radiance(std::uint32_t start_level) const;

 private:
  const GBuffer& gbuffer_;
  const Lights& lights_;
  const std::vector<interop::Cluster>& clusters_;
};

// eps for a relative error E of the image (docs/shading.md has the calibration), and the level to start at.
CutCriterion criterion_for(double error, const Lights& lights);

}  // namespace vsgl
