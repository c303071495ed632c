#include "reference/sphere_lights.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "interop/model.h"
#include "math/frame.h"
#include "math/interop_vec.h"
#include "reference/accumulator.h"
#include "reference/estimator.h"

namespace vsgl::reference {
namespace {

using scene::SphereLight;

constexpr int kPasses = 16;  // which the variance comes from

// A sphere as a point sees it.
struct Cone {
  Vec3 axis;
  double distance = 0;       // of the centre, m
  double one_minus_cos = 2;  // of the half angle; 2 from inside the sphere: all directions

  Cone(const SphereLight& sphere, Vec3 point) {
    const Vec3 v = sphere.position - point;
    distance = length(v);
    axis = distance > 0 ? v / distance : Vec3{0, 0, 1};
    const double sine2 = distance > sphere.radius ? sphere.radius * sphere.radius / (distance * distance) : 2;
    if (sine2 < 1) one_minus_cos = sine2 / (1 + std::sqrt(1 - sine2));
  }
  double density() const { return 1 / (2 * std::numbers::pi * one_minus_cos); }
  bool holds(Vec3 u) const { return 1 - dot(u, axis) <= one_minus_cos; }
  Vec3 sample(std::array<double, 2> point) const {
    const double below = point[0] * one_minus_cos, r = std::sqrt(std::max(below * (2 - below), 0.0));
    const double angle = 2 * std::numbers::pi * point[1];
    return frame_about(axis).to_world({r * std::cos(angle), r * std::sin(angle), 1 - below});
  }
  // Where the ray along u, which the cone holds, meets the sphere; from inside, where it leaves it.
  double hit(const SphereLight& sphere, Vec3 u) const {
    const double along = distance * dot(axis, u);
    const double half =
        std::sqrt(std::max(along * along - distance * distance + sphere.radius * sphere.radius, 0.0));
    return distance > sphere.radius ? along - half : along + half;
  }
};

class SphereEstimator {
 public:
  SphereEstimator(const scene::Scene& scene, Strategy strategy, std::uint64_t seed, int points)
      : tracer_(scene), spheres_(scene.sphere_lights), strategy_(strategy), points_(seed, points) {}

  // Mean over one pass's points.
  Estimate estimate(const Receiver& x, std::uint32_t pixel, std::uint32_t pass) const {
    Estimate sum;
    const Points::Lattice by_brdf = points_.lattice(Stream::brdf, pixel, pass);
    for (int i = 0; strategy_.brdf > 0 && i < points_.count(); ++i) {
      const Vec3 u = x.sample(by_brdf[i][0], by_brdf[i][1]);
      for (const SphereLight& sphere : spheres_) {
        const Cone cone(sphere, x.position());
        if (cone.holds(u)) sum += arriving(x, sphere, cone, u);
      }
    }
    for (std::size_t k = 0; strategy_.light > 0 && k < spheres_.size(); ++k) {
      const Cone cone(spheres_[k], x.position());
      const auto item = static_cast<std::uint32_t>(pixel * spheres_.size() + k);
      const Points::Lattice by_light = points_.lattice(Stream::light, item, pass);
      for (int i = 0; i < points_.count(); ++i)
        sum += arriving(x, spheres_[k], cone, cone.sample(by_light[i]));
    }
    const double count = points_.count();
    return {sum.diffuse / count, sum.specular / count};
  }

 private:
  // Light of the sphere from direction u over the density of the directions.
  Estimate arriving(const Receiver& x, const SphereLight& sphere, const Cone& cone, Vec3 u) const {
    const Receiver::Response response = x.respond(u);
    if (response.diffuse == 0 && response.specular == 0) return {};
    if (tracer_.occluded(x.position(), x.normal(), x.position() + cone.hit(sphere, u) * u, {})) return {};
    const double brdf_density = strategy_.brdf > 0 ? x.density(u) : 0;
    const Vec3 light = sphere.radiance / (strategy_.light * cone.density() + brdf_density);
    return {response.diffuse * x.diffuse() * light, response.specular * x.specular() * light};
  }

  trace::Tracer tracer_;
  const std::vector<SphereLight>& spheres_;
  Strategy strategy_;
  Points points_;
};

Reference to_reference(const Accumulator& sums, const GBuffer& gbuffer, const ReferenceParams& params,
                       int points) {
  Reference out;
  out.strategy = params.strategy;
  out.passes = kPasses;
  out.samples = static_cast<std::uint64_t>(kPasses) * static_cast<std::uint64_t>(points);
  out.radiance.width = gbuffer.width;
  out.radiance.height = gbuffer.height;
  out.radiance.direct.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    out.radiance.diffuse.push_back(to_float(sums.diffuse(i)));
    out.variance.push_back(to_float(sums.variance(i, kPasses)));
    if (gbuffer.has_specular()) out.radiance.specular.push_back(to_float(sums.specular(i)));
  }
  return out;
}

}  // namespace

Reference trace_sphere_lights(const scene::Scene& scene, const GBuffer& gbuffer,
                              const ReferenceParams& params, Report& report) {
  if (params.samples < 1 || params.samples > kMaxSamples)
    throw Error(ErrorCode::out_of_range,
                "samples: " + std::to_string(params.samples) + " is not within 1..16777216");
  if (!(gbuffer.anchor == scene.anchor))
    throw Error(ErrorCode::invalid_data,
                "the G-buffer has another anchor than the scene; bake it from the same scene file");
  if (scene.sphere_lights.empty())
    throw Error(ErrorCode::bad_light, "sphere_lights: the scene has none; add one under \"sphere_lights\"");
  const PhaseTimer timer(report, "sphere lights");
  const int points = (params.samples + kPasses - 1) / kPasses;
  const SphereEstimator estimator(scene, strategy_named(params.strategy), params.seed, points);
  Accumulator sums(gbuffer.width, gbuffer.height);
#pragma omp parallel for schedule(dynamic, 32)
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    if (gbuffer.pixels[i].id == interop::NO_INSTANCE) continue;
    const Receiver x(gbuffer.pixels[i], gbuffer.camera);
    const auto pixel = static_cast<std::uint32_t>(i);
    for (int pass = 0; pass < kPasses; ++pass)
      sums.add(i, estimator.estimate(x, pixel, static_cast<std::uint32_t>(pass)), pass + 1);
  }
  report.count("sphere_lights", scene.sphere_lights.size());
  return to_reference(sums, gbuffer, params, points);
}

}  // namespace vsgl::reference
