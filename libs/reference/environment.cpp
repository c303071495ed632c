#include "reference/environment.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "interop/model.h"
#include "math/frame.h"
#include "math/interop_vec.h"
#include "reference/accumulator.h"
#include "reference/blockers.h"
#include "reference/points.h"

namespace vsgl::reference {
namespace {

constexpr int kPasses = 16;  // which the variance comes from
constexpr double pi = std::numbers::pi;

void check(const scene::Scene& scene, const GBuffer& gbuffer, const Proxies* proxies,
           const EnvironmentParams& params) {
  const auto require = [](bool sound, ErrorCode code, const std::string& message) {
    if (!sound) throw Error(code, message);
  };
  require(params.samples >= 1 && params.samples <= kMaxSamples, ErrorCode::out_of_range,
          "samples: " + std::to_string(params.samples) + " is not within 1..16777216");
  require(params.blockers == "scene" || params.blockers == "meshes" || params.blockers == "spheres",
          ErrorCode::bad_value, "blockers: \"" + params.blockers + "\" is none of scene, meshes, spheres");
  require(params.bounce == "shadowed" || params.bounce == "unshadowed", ErrorCode::bad_value,
          "bounce: \"" + params.bounce + "\" is none of shadowed, unshadowed");
  require(params.blockers == "scene" || proxies, ErrorCode::bad_value,
          "blockers: \"" + params.blockers + "\" needs the proxies; give what proxy-fit has made");
  require(gbuffer.anchor == scene.anchor, ErrorCode::invalid_data,
          "the G-buffer has another anchor than the scene; bake it from the same scene file");
  require(!proxies || proxies->anchor == scene.anchor, ErrorCode::invalid_data,
          "the proxies have another anchor than the scene; fit them to the same scene file");
}

// The scene without the instances that no proxies stand for.
scene::Scene proxied(const scene::Scene& scene, const Proxies& proxies) {
  scene::Scene out = scene;
  out.instances.clear();
  for (const ProxyObject& object : proxies.objects) {
    const auto index = static_cast<std::size_t>(object.instance);
    if (index >= scene.instances.size() || scene.instances[index].name != object.name)
      throw Error(ErrorCode::invalid_data, "proxies: the scene's instance " + std::to_string(index) +
                                               " is not \"" + object.name +
                                               "\"; fit them to the same scene file");
    out.instances.push_back(scene.instances[index]);
  }
  return out;
}

Vec3 cosine_direction(Vec3 normal, std::array<double, 2> u) {
  const double r = std::sqrt(u[0]), azimuth = 2 * pi * u[1];
  return frame_about(normal).to_world({r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - u[0])});
}

class EnvironmentEstimator {
 public:
  EnvironmentEstimator(const scene::Environment& sky, const Blockers& blockers,
                       const EnvironmentParams& params, int points)
      : sky_(sky),
        blockers_(blockers),
        shadowed_(params.bounce == "shadowed"),
        points_(params.seed, points) {}

  struct Light {
    Vec3 direct, indirect;  // radiance
  };
  // Mean over one pass's points.
  Light estimate(const interop::Surface& pixel, std::uint32_t index, std::uint32_t pass) const {
    const Vec3 normal = to_double(pixel.normal), shading_normal = to_double(pixel.shading_normal);
    const auto view = blockers_.from(to_double(pixel.position), normal, shading_normal);
    const Points::Lattice first = points_.lattice(Stream::brdf, index, pass);
    const Points::Lattice second = points_.lattice(Stream::light, index, pass);
    Light sum;
    for (int i = 0; i < points_.count(); ++i) {
      const Vec3 direction = cosine_direction(shading_normal, first[i]);
      if (dot(direction, normal) <= 0) continue;
      if (const auto hit = view->first(direction))
        sum.indirect += reflected(*hit, second[i]);
      else
        sum.direct += scene::radiance_from(sky_, direction);
    }
    const Vec3 albedo = to_double(pixel.diffuse) / points_.count();
    return {albedo * sum.direct, albedo * sum.indirect};
  }

 private:
  Vec3 reflected(const BlockerPoint& at, std::array<double, 2> u) const {
    const Vec3 direction = cosine_direction(at.shading_normal, u);
    if (dot(direction, at.normal) <= 0 || (shadowed_ && blockers_.hides(at, direction))) return {};
    return at.albedo * scene::radiance_from(sky_, direction);
  }

  const scene::Environment& sky_;
  const Blockers& blockers_;
  bool shadowed_;
  Points points_;
};

}  // namespace

Reference trace_environment(const scene::Scene& scene, const scene::Environment& environment,
                            const Proxies* proxies, const GBuffer& gbuffer, const EnvironmentParams& params,
                            Report& report) {
  check(scene, gbuffer, proxies, params);
  const PhaseTimer timer(report, "environment");
  const scene::Scene meshes = params.blockers == "meshes" ? proxied(scene, *proxies) : scene;
  const auto blockers =
      params.blockers == "spheres" ? sphere_blockers(proxies->spheres()) : mesh_blockers(meshes);
  const int points = (params.samples + kPasses - 1) / kPasses;
  const EnvironmentEstimator estimator(environment, *blockers, params, points);
  Accumulator direct(gbuffer.width, gbuffer.height), indirect(gbuffer.width, gbuffer.height);
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < gbuffer.pixels.size(); ++i)
    if (gbuffer.pixels[i].id != interop::NO_INSTANCE) seen.push_back(i);
#pragma omp parallel for schedule(dynamic, 32)
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (int pass = 0; pass < kPasses; ++pass) {
      const auto light =
          estimator.estimate(gbuffer.pixels[seen[k]], seen[k], static_cast<std::uint32_t>(pass));
      direct.add(seen[k], {light.direct, {}}, pass + 1);
      indirect.add(seen[k], {light.indirect, {}}, pass + 1);
    }
  report.count("relative_error_direct", direct.relative_error(seen, kPasses));
  report.count("relative_error", indirect.relative_error(seen, kPasses));
  if (gbuffer.has_specular())
    report.skipped("specular reflection", "of an environment, diffuse reflection alone is traced");
  Reference out;
  out.strategy = "brdf";
  out.passes = kPasses;
  out.samples = static_cast<std::uint64_t>(kPasses) * static_cast<std::uint64_t>(points);
  out.radiance.width = gbuffer.width;
  out.radiance.height = gbuffer.height;
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    out.radiance.direct.push_back(to_float(direct.diffuse(i)));
    out.radiance.diffuse.push_back(to_float(indirect.diffuse(i)));
    out.variance.push_back(to_float(indirect.variance(i, kPasses)));
  }
  return out;
}

}  // namespace vsgl::reference
