#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "math/interop_vec.h"
#include "scene/instances.h"
#include "scene/transform.h"
#include "stages/proxies/proxies.h"
#include "stages/proxies/sphere_set.h"
#include "trace/surface_resolver.h"

namespace vsgl {
namespace {

using proxies::Sphere;
using proxies::SphereSet;
using proxies::Triangles;

constexpr int kSurfacePoints = 4096;
constexpr double kFlatShare = 0.02;  // of its extent, below which an instance is flat
constexpr double kLargeShare = 0.1;  // of the scene's area, above which it is large

void check(const scene::Scene& scene, const ProxyParams& params) {
  if (params.count < 1 || params.count > 256)
    throw Error(ErrorCode::out_of_range, "count: " + std::to_string(params.count) + " is not 1..256");
  if (!(params.cover >= 0.1 && params.cover <= 1))
    throw Error(ErrorCode::out_of_range, "cover: " + std::to_string(params.cover) + " is not 0.1..1");
  if (!(params.overlap_cost >= 0 && params.overlap_cost <= 1))
    throw Error(ErrorCode::out_of_range,
                "overlap_cost: " + std::to_string(params.overlap_cost) + " is not 0..1");
  for (const std::string& name : params.receivers)
    if (std::ranges::find(scene.instances, name, &scene::Instance::name) == scene.instances.end())
      throw Error(ErrorCode::bad_value, "receivers: the scene has no node \"" + name + "\"");
}

template <class Vertices>
Triangles triangles_of(const Vertices& vertices, const std::vector<std::uint32_t>& indices) {
  Triangles out{{}, indices};
  for (const scene::Vertex& vertex : vertices) out.positions.push_back(scene::position_of(vertex));
  return out;
}

double area_of(const Triangles& triangles) {
  double sum = 0;
  for (std::size_t t = 0; t < triangles.count(); ++t) sum += triangles.area(t);
  return sum;
}

// Large and flat, along any of its mesh's axes.
bool is_large_and_flat(const scene::InstanceOrigin& origin, double area, double scene_area) {
  const auto [low, high] = bounds(triangles_of(origin.mesh->vertices, origin.mesh->indices));
  const Vec3 extent = high - low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  return std::min({extent.x, extent.y, extent.z}) < kFlatShare * longest && area > kLargeShare * scene_area;
}

// Moved with the mesh; a transform that stretches keeps the spheres' volumes.
std::vector<Sphere> moved(const std::vector<Sphere>& spheres, const Mat4& transform) {
  const double scale = std::cbrt(std::abs(scene::determinant(transform)));
  std::vector<Sphere> out;
  for (const Sphere& sphere : spheres) out.push_back({transform.point(sphere.center), scale * sphere.radius});
  return out;
}

// Fits and measures the spheres of instances.
class Fitter {
 public:
  Fitter(const scene::Scene& scene, const ProxyParams& params)
      : scene_(scene), params_(params), resolver_(scene) {}

  ProxyObject fit(std::size_t index, const scene::InstanceOrigin& origin) {
    const scene::Instance& instance = scene_.instances[index];
    const SphereSet& set = set_of(*origin.mesh);
    const std::vector<Sphere> spheres = moved(set.spheres, origin.transform);
    ProxyObject out{instance.name, static_cast<int>(index), set.sheet, {}, {}};
    out.errors.volume_outside = set.volume_outside;
    out.errors.volume_missed = set.volume_missed;
    for (const Sphere& sphere : spheres) out.spheres.push_back({sphere.center, sphere.radius, {}});
    if (!spheres.empty()) measure_surface(index, spheres, out);
    return out;
  }

  std::size_t meshes() const { return sets_.size(); }

 private:
  // Each mesh is fitted once.
  const SphereSet& set_of(const scene::Mesh& mesh) {
    const auto [entry, fresh] = sets_.try_emplace(&mesh);
    if (fresh)
      entry->second = fit_spheres(triangles_of(mesh.vertices, mesh.indices), params_.count, params_.cover,
                                  params_.overlap_cost);
    return entry->second;
  }

  // Distances to the spheres, and the reflectance of the points next to each.
  void measure_surface(std::size_t index, const std::vector<Sphere>& spheres, ProxyObject& out) const {
    const scene::Instance& instance = scene_.instances[index];
    const Triangles triangles = triangles_of(instance.vertices, instance.indices);
    struct Share {
      Vec3 sum;
      double count = 0;
    };
    std::vector<Share> shares(spheres.size());
    Share all;
    double squares = 0;
    for (const auto& point : surface_points(triangles, kSurfacePoints)) {
      const Vec3 p = position(triangles, point);
      const double distance = std::abs(signed_distance(spheres, p));
      squares += distance * distance;
      out.errors.surface_distance_max = std::max(out.errors.surface_distance_max, distance);
      const Vec3 albedo =
          to_double(resolver_
                        .surface({static_cast<std::uint32_t>(index), point.triangle, point.b, point.c, 0},
                                 triangles.normal(point.triangle))
                        .diffuse);
      for (Share* share : {&all, &shares[nearest_sphere(spheres, p)]}) {
        share->sum += albedo;
        share->count += 1;
      }
    }
    out.errors.surface_distance_rms = std::sqrt(squares / kSurfacePoints);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Share& share = shares[i].count > 0 ? shares[i] : all;
      out.spheres[i].albedo = share.sum / share.count;
    }
  }

  const scene::Scene& scene_;
  const ProxyParams& params_;
  trace::SurfaceResolver resolver_;
  std::map<const scene::Mesh*, SphereSet> sets_;
};

void describe(const Proxies& proxies, std::size_t meshes, Report& report) {
  double outside = 0, missed = 0, rms = 0;
  for (const ProxyObject& object : proxies.objects) {
    outside = std::max(outside, object.errors.volume_outside);
    missed = std::max(missed, object.errors.volume_missed);
    rms = std::max(rms, object.errors.surface_distance_rms);
  }
  report.count("meshes", meshes);
  report.count("objects", proxies.objects.size());
  report.count("spheres", proxies.spheres().size());
  report.count("worst_volume_outside", outside);
  report.count("worst_volume_missed", missed);
  report.count("worst_surface_distance_rms_m", rms);
  for (const ProxyReceiverOnly& receiver : proxies.receivers)
    report.skipped("spheres of " + receiver.name, "it only receives light");
}

}  // namespace

Proxies fit_proxies(const scene::SceneSequence& sequence, int frame, const ProxyParams& params,
                    Report& report) {
  const scene::Scene scene = sequence.at(frame);
  const std::vector<scene::InstanceOrigin> origins = sequence.origins(frame);
  check(scene, params);
  const PhaseTimer timer(report, "fit spheres");
  std::vector<double> areas;
  double scene_area = 0;
  for (const scene::Instance& instance : scene.instances) {
    areas.push_back(area_of(triangles_of(instance.vertices, instance.indices)));
    scene_area += areas.back();
  }
  Proxies out;
  out.anchor = scene.anchor;
  out.scene_radius = scene.radius;
  Fitter fitter(scene, params);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const std::string& name = scene.instances[i].name;
    const bool named = std::ranges::find(params.receivers, name) != params.receivers.end();
    if (named || is_large_and_flat(origins[i], areas[i], scene_area))
      out.receivers.push_back({name, static_cast<int>(i)});
    else
      out.objects.push_back(fitter.fit(i, origins[i]));
  }
  describe(out, fitter.meshes(), report);
  return out;
}

}  // namespace vsgl
