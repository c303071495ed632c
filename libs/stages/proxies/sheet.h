#pragma once

#include "stages/proxies/sphere_set.h"

namespace vsgl::proxies {

// Spheres behind an open surface: clusters of its points by k-means, each a sphere of the cluster's area as
// its disk that touches the cluster's mean from behind.
std::vector<Sphere> fit_sheet(const Triangles& triangles, int count);

}  // namespace vsgl::proxies
