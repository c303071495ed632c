#pragma once

#include "stages/proxies/voxels.h"

namespace vsgl::proxies {

// Moves and resizes spheres, a step of one of them at a time, while that lessens their misfit and overlap:
// the voxels that are in the union and not inside, or inside and not in the union, and `overlap_cost` for
// each sphere beyond a voxel's first. Steps of 4 voxels, 2, 1 and 1/2. Spheres that hold nothing that no
// other holds are dropped.
void polish(const Voxels& voxels, double overlap_cost, std::vector<Sphere>& spheres);

}  // namespace vsgl::proxies
