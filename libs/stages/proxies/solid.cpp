// Sphere sets of solids: the inside as voxels, a greedy choice of large balls, refinement as Lloyd's, then
// one more sphere at a time where most is missed, each time moved and resized for the least misfit. After
// [Wang 2006], which minimises the volume outside of spheres that bound the mesh. Deviation: spheres of the
// mesh's volume, which throw shadows of about the right size; bounding ones are fat.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/proxies/polish.h"
#include "stages/proxies/sheet.h"
#include "stages/proxies/voxels.h"

namespace vsgl::proxies {
namespace {

constexpr int kCells = 48;             // voxels along the side of a cube of the box's volume
constexpr double kSheetShare = 0.01;   // of the box inside, below which a mesh is no solid
constexpr double kSlack = 0.02;        // of the mesh's diagonal, by which candidates reach out of it
constexpr double kCandidateGap = 0.5;  // least distance of candidates, in radii of the larger
constexpr int kLloydRounds = 10, kBisections = 20;

using Spheres = std::vector<Sphere>;

// The spheres about local maxima of the distance to the outside, the largest first, those near a larger one
// left out.
Spheres candidates(const Voxels& voxels, double slack) {
  const std::vector<float> distances = squared_distances(voxels);
  Spheres all;
  for (int z = 1; z + 1 < voxels.nz; ++z)
    for (int y = 1; y + 1 < voxels.ny; ++y)
      for (int x = 1; x + 1 < voxels.nx; ++x) {
        const float d = distances[voxels.index(x, y, z)];
        bool is_maximum = d > 0;
        for (int n = 0; is_maximum && n < 27; ++n)
          is_maximum = distances[voxels.index(x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1)] <= d;
        // Half a voxel short of the nearest centre outside.
        if (is_maximum)
          all.push_back(
              {voxels.center(x, y, z), (std::sqrt(static_cast<double>(d)) - 0.5) * voxels.side + slack});
      }
  std::ranges::stable_sort(all, std::ranges::greater{}, &Sphere::radius);
  Spheres kept;
  for (const Sphere& sphere : all)
    if (std::ranges::none_of(kept, [&](const Sphere& larger) {
          return length(larger.center - sphere.center) < kCandidateGap * larger.radius;
        }))
      kept.push_back(sphere);
  return kept;
}

// Voxels inside that a sphere newly covers, less those outside.
long gain(const Voxels& voxels, const std::vector<std::uint8_t>& covered, const Sphere& sphere) {
  long sum = 0;
  voxels.for_each_in(sphere, [&](std::size_t i) {
    if (covered[i] == 0) sum += voxels.inside[i] != 0 ? 1 : -1;
  });
  return sum;
}

Spheres choose(const Voxels& voxels, const Spheres& from, int count, double cover) {
  const double wanted = cover * static_cast<double>(voxels.inside_count());
  std::vector<std::uint8_t> covered(voxels.size());
  std::size_t inside = 0;
  Spheres chosen;
  while (static_cast<int>(chosen.size()) < count && static_cast<double>(inside) < wanted) {
    std::vector<long> gains(from.size());
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t i = 0; i < from.size(); ++i) gains[i] = gain(voxels, covered, from[i]);
    const auto best = std::ranges::max_element(gains);
    if (best == gains.end() || *best <= 0) break;
    chosen.push_back(from[static_cast<std::size_t>(best - gains.begin())]);
    voxels.for_each_in(chosen.back(), [&](std::size_t i) {
      if (covered[i] == 0 && voxels.inside[i] != 0) ++inside;
      covered[i] = 1;
    });
  }
  return chosen;
}

// Each voxel inside goes to the sphere of the least power distance |v - c|^2 - r^2; a sphere becomes the ball
// about its voxels' mean of their volume, half-way. Spheres without voxels are dropped.
void refine(const Voxels& voxels, Spheres& spheres) {
  struct Share {
    Vec3 sum;
    double count = 0;
  };
  std::vector<Share> shares(spheres.size());
  for (int z = 0; z < voxels.nz; ++z)
    for (int y = 0; y < voxels.ny; ++y)
      for (int x = 0; x < voxels.nx; ++x) {
        if (voxels.inside[voxels.index(x, y, z)] == 0) continue;
        const Vec3 v = voxels.center(x, y, z);
        const auto power = [&](const Sphere& sphere) {
          return dot(v - sphere.center, v - sphere.center) - sphere.radius * sphere.radius;
        };
        const auto nearest = std::ranges::min_element(spheres, {}, power);
        Share& share = shares[static_cast<std::size_t>(nearest - spheres.begin())];
        share.sum += v;
        share.count += 1;
      }
  Spheres refined;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (shares[i].count == 0) continue;
    const double volume = shares[i].count * std::pow(voxels.side, 3);
    const double radius = std::cbrt(volume * 3 / (4 * std::numbers::pi));
    refined.push_back({shares[i].sum / shares[i].count, (radius + spheres[i].radius) / 2});
  }
  spheres = refined;
}

struct Union {
  std::size_t inside = 0, outside = 0;  // voxels
};
Union measure(const Voxels& voxels, const Spheres& spheres) {
  std::vector<std::uint8_t> covered(voxels.size());
  Union out;
  for (const Sphere& sphere : spheres)
    voxels.for_each_in(sphere, [&](std::size_t i) {
      if (covered[i] != 0) return;
      covered[i] = 1;
      ++(voxels.inside[i] != 0 ? out.inside : out.outside);
    });
  return out;
}

Spheres scaled(Spheres spheres, double factor) {
  for (Sphere& sphere : spheres) sphere.radius *= factor;
  return spheres;
}

// By one factor for all radii, so that the union has the mesh's volume: then its mean projected area, and
// with it the shadow in even light, is about right.
Spheres fit_volume(const Voxels& voxels, const Spheres& spheres) {
  const std::size_t wanted = voxels.inside_count();
  double low = 0.25, high = 4;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(low * high);
    const Union size = measure(voxels, scaled(spheres, middle));
    (size.inside + size.outside < wanted ? low : high) = middle;
  }
  return scaled(spheres, high);
}

Spheres settled(const Voxels& voxels, double overlap_cost, Spheres spheres) {
  polish(voxels, overlap_cost, spheres);
  return fit_volume(voxels, spheres);
}

// About the voxel inside that lies furthest out of the spheres, the first of several, a sphere that touches
// them.
Sphere most_missed(const Voxels& voxels, const Spheres& spheres) {
  Sphere out;
  for (int z = 0; z < voxels.nz; ++z)
    for (int y = 0; y < voxels.ny; ++y)
      for (int x = 0; x < voxels.nx; ++x) {
        if (voxels.inside[voxels.index(x, y, z)] == 0) continue;
        const double distance = signed_distance(spheres, voxels.center(x, y, z));
        if (distance > out.radius) out = {voxels.center(x, y, z), distance};
      }
  return out;
}

}  // namespace

SphereSet fit_spheres(const Triangles& triangles, int count, double cover, double overlap_cost) {
  SphereSet out;
  const auto [low, high] = bounds(triangles);
  if (surface_points(triangles, 1).empty()) return out;
  const Voxels voxels = voxelise(triangles, kCells);
  const std::size_t inside = voxels.inside_count();
  if (static_cast<double>(inside) < kSheetShare * static_cast<double>(voxels.of_box)) {
    out.sheet = true;
    out.spheres = fit_sheet(triangles, count);
    return out;
  }
  const auto volume = static_cast<double>(inside);
  const double slack = kSlack * length(high - low);
  out.spheres = choose(voxels, candidates(voxels, slack), count, cover);
  for (int round = 0; round < kLloydRounds; ++round) refine(voxels, out.spheres);
  out.spheres = settled(voxels, overlap_cost, out.spheres);
  while (true) {
    const Union size = measure(voxels, out.spheres);
    out.volume_outside = static_cast<double>(size.outside) / volume;
    out.volume_missed = static_cast<double>(inside - size.inside) / volume;
    if (static_cast<int>(out.spheres.size()) >= count || out.volume_missed <= 1 - cover) return out;
    Spheres more = out.spheres;
    more.push_back(most_missed(voxels, more));
    more = settled(voxels, overlap_cost, more);
    if (more.size() <= out.spheres.size()) return out;  // no room for another
    out.spheres = more;
  }
}

}  // namespace vsgl::proxies
