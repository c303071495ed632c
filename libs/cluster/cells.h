#pragma once

// The pixels between a tile's samples. Private to this library.

#include <vector>

#include "artifact/artifact.h"
#include "cluster/evaluate.h"
#include "cluster/traverse.h"

namespace vsgl {

// The 4x4 pixels that a sample stands for, those that are there, and a sphere that holds them.
struct Cell {
  std::size_t sample = 0;
  interop::vec3 centre;  // m, relative to the anchor
  float radius = 0;      // m
  SampleReceivers receivers;
};
// A cell for each sample of the tile.
std::vector<Cell> cells_of(const GBuffer& gbuffer, const TileSamples& samples);

}  // namespace vsgl
