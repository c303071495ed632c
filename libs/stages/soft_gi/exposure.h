#pragma once

#include <array>
#include <vector>

#include "artifact/proxies.h"
#include "interop/proxy.h"

namespace vsgl::soft_gi {

// How much of a sphere its neighbours leave to see, 0..1: entry n for receivers at a distance of 2^n radii.
using Exposure = std::array<float, interop::PROXY_EXPOSURES>;

// The share of the parallel rays towards a sphere, mean over all directions, that meet it before its
// neighbours, which are the spheres whose centres lie within kNeighbourhood times the receiver's distance.
// Spheres that coincide share. So the exposed parts of a cluster cover together what it covers from afar,
// where spherical harmonics of low order do not see that its spheres overlap; from close by they do.
// The same for any number of threads.
inline constexpr double kNeighbourhood = 0.35;
std::vector<Exposure> exposures(const std::vector<ProxySphere>& spheres);

}  // namespace vsgl::soft_gi
