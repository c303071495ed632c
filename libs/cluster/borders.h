#pragma once

// Neighbouring tiles have cuts of their own, which err differently: where they meet, the light of one surface
// would step. Each tile's cut is evaluated on the pixels of a ring that its neighbours share; gains bring the
// results together there, and fade into the tile.

#include <span>

#include "artifact/artifact.h"
#include "cluster/traverse.h"

namespace vsgl {

// The pixels {0, 4, 8, 12, 16}^2 of a tile one of whose coordinates is 0 or 16, row by row. Those at 16
// belong to its neighbours, and each pixel is in the rings of all tiles that it touches; in the last tiles
// the image's last pixels stand in for those beyond. Present are those that the surface of the tile's nearest
// pixel reaches and that have no narrow specular lobe.
TileSamples ring_samples(const GBuffer& gbuffer, int tile);

// Sets the gains of the cut's tiles, row by row, from what their cuts send to their rings: to the mean of the
// tiles that share a pixel, weighted by the squares of the sizes of their cuts, as errors fall about as fast
// as cuts grow. Where they differ by more than 1.5 times the error that the cut aims at: 1.
void set_gains(Cut& cut, std::span<const TileRing> rings);

// What the light of a pixel's tile is multiplied by: the gains on the sides of the tile, linear between those
// of the ring, continued inwards. Those on other surfaces than the pixel's count as 1.
float gain_at(const GBuffer& gbuffer, const Cut& cut, std::uint32_t pixel);

}  // namespace vsgl
