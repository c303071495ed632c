#include "stages/proxies/sheet.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

namespace vsgl::proxies {
namespace {

constexpr int kPoints = 4096, kRounds = 20;

std::size_t nearest(const std::vector<Vec3>& centers, Vec3 p) {
  const auto distance = [&](Vec3 c) { return dot(p - c, p - c); };
  return static_cast<std::size_t>(std::ranges::min_element(centers, {}, distance) - centers.begin());
}

// The first point, then always the one furthest from all that there are.
std::vector<Vec3> spread_centers(const std::vector<Vec3>& points, int count) {
  std::vector<Vec3> centers{points.front()};
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(centers.size()) < count) {
    for (std::size_t i = 0; i < points.size(); ++i)
      distance[i] = std::min(distance[i], dot(points[i] - centers.back(), points[i] - centers.back()));
    const auto furthest = std::ranges::max_element(distance);
    if (*furthest == 0) break;
    centers.push_back(points[static_cast<std::size_t>(furthest - distance.begin())]);
  }
  return centers;
}

}  // namespace

std::vector<Sphere> fit_sheet(const Triangles& triangles, int count) {
  std::vector<Vec3> points, normals;
  for (const SurfacePoint& point : surface_points(triangles, kPoints)) {
    points.push_back(position(triangles, point));
    normals.push_back(triangles.normal(point.triangle));
  }
  double area = 0;
  for (std::size_t t = 0; t < triangles.count(); ++t) area += triangles.area(t);
  std::vector<Vec3> centers = spread_centers(points, count);
  struct Cluster {
    Vec3 sum, normal;
    double count = 0;
  };
  std::vector<Cluster> clusters;
  for (int round = 0; round < kRounds; ++round) {
    clusters.assign(centers.size(), {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      Cluster& cluster = clusters[nearest(centers, points[i])];
      cluster.sum += points[i];
      cluster.normal += normals[i];
      cluster.count += 1;
    }
    std::erase_if(clusters, [](const Cluster& cluster) { return cluster.count == 0; });
    centers.clear();
    for (const Cluster& cluster : clusters) centers.push_back(cluster.sum / cluster.count);
  }
  std::vector<Sphere> spheres;
  for (const Cluster& cluster : clusters) {
    const double share = area * cluster.count / kPoints, radius = std::sqrt(share / std::numbers::pi);
    spheres.push_back({cluster.sum / cluster.count - radius * normalise(cluster.normal), radius});
  }
  return spheres;
}

}  // namespace vsgl::proxies
