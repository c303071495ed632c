#include "reference/estimator.h"

#include <algorithm>

#include "base/error.h"
#include "math/interop_vec.h"

namespace vsgl::reference {
namespace {

// Sets of light paths that a pass shares among its pixels: so many that two pixels seldom have the same.
constexpr std::size_t kMaxSets = 4096;

// A point for the choice of the source, stretched over the chosen one's share.
const Source& choose(const std::vector<Source>& sources, double& u) {
  std::size_t k = 0;
  while (k + 1 < sources.size() && u >= sources[k].probability()) u -= sources[k++].probability();
  u = std::min(u / sources[k].probability(), 1 - 0x1p-53);
  return sources[k];
}

Estimate reflect(const Receiver& x, Receiver::Response response, Vec3 arriving) {
  return {response.diffuse * x.diffuse() * arriving, response.specular * x.specular() * arriving};
}

}  // namespace

Strategy strategy_named(const std::string& name) {
  if (name == "light") return {1, 0};
  if (name == "brdf") return {0, 1};
  if (name == "mis") return {1, 1};
  throw Error(ErrorCode::bad_value, "strategy: \"" + name + "\" is none of light, brdf, mis");
}

Estimator::Estimator(const scene::Scene& scene, Strategy strategy, std::uint64_t seed, int points)
    : tracer_(scene),
      strategy_(strategy),
      points_(seed, points),
      lift_(trace::kLift * scene.radius),
      sources_(make_sources(scene.lights, scene.radius)) {}

LitPoint Estimator::trace_light_path(double u1, double u2) const {
  const Source& source = choose(sources_, u1);
  const Source::Start start = source.sample(u1, u2);
  const auto hit = tracer_.intersect(start.origin, start.direction, start.nearest);
  if (!hit) return {};
  const interop::Surface surface = tracer_.surface(*hit, -start.direction);
  return light_surface(surface, source.arrival(to_double(surface.position)));
}

void Estimator::start_pass(std::uint32_t pass, std::size_t pixels) {
  pass_ = pass;
  if (strategy_.light == 0) return;
  const int count = points_.count();
  const auto sets = static_cast<int>(std::clamp<std::size_t>(pixels, 1, kMaxSets));
  pool_.resize(static_cast<std::size_t>(sets) * static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic, 16)
  for (int set = 0; set < sets; ++set) {
    const Points::Lattice lattice = points_.lattice(Stream::light, static_cast<std::uint32_t>(set), pass);
    for (int i = 0; i < count; ++i) {
      const auto [u1, u2] = lattice[i];
      pool_[static_cast<std::size_t>(set) * static_cast<std::size_t>(count) + static_cast<std::size_t>(i)] =
          trace_light_path(u1, u2);
    }
  }
}

Estimate Estimator::connect(const Receiver& x, const LitPoint& y) const {
  const Vec3 v = y.position - x.position();
  const double distance2 = dot(v, v);
  if (distance2 == 0) return {};
  const Vec3 u = v / std::sqrt(distance2);
  const double geometry = std::max(-dot(y.normal, u), 0.0) / distance2;
  const double brdf_density = strategy_.brdf > 0 ? x.density(u) * geometry : 0;
  const double density = strategy_.light * y.density + brdf_density;
  if (geometry == 0 || density == 0) return {};
  return reflect(x, x.respond(u), geometry / density * y.radiance(-u));
}

Estimate Estimator::from_light(const Receiver& x, const LitPoint& y, std::uint64_t& rays) const {
  if (y.density == 0) return {};
  const Estimate unshadowed = connect(x, y);
  if (unshadowed.is_zero()) return {};
  ++rays;
  return tracer_.occluded(x.position(), x.normal(), y.position, y.normal) ? Estimate{} : unshadowed;
}

bool Estimator::in_shadow(Vec3 point, Vec3 normal, const Source& source, Vec3 incident) const {
  return source.is_directional() ? tracer_.occluded_to_infinity(point, normal, incident)
                                 : tracer_.occluded(point, normal, source.position(), {});
}

Estimate Estimator::from_brdf(const Receiver& x, double u1, double u2, std::uint64_t& rays) const {
  const Vec3 u = x.sample(u1, u2);
  if (dot(x.normal(), u) <= 0) return {};
  ++rays;
  const auto hit = tracer_.intersect(x.position() + lift_ * x.normal(), u);
  if (!hit) return {};
  const interop::Surface surface = tracer_.surface(*hit, -u);
  Estimate sum;
  for (const Source& source : sources_) {
    const Source::Arrival arrival = source.arrival(to_double(surface.position));
    const LitPoint y = light_surface(surface, arrival);
    if (y.density == 0) continue;
    const Estimate unshadowed = connect(x, y);
    if (unshadowed.is_zero()) continue;
    ++rays;
    if (!in_shadow(y.position, y.normal, source, arrival.incident)) sum += unshadowed;
  }
  return sum;
}

Estimate Estimator::indirect(const Receiver& x, std::uint32_t pixel, std::uint64_t& rays) const {
  Estimate sum;
  const int count = points_.count();
  if (strategy_.light > 0) {
    const auto sets = static_cast<std::uint32_t>(pool_.size() / static_cast<std::size_t>(count));
    const LitPoint* set =
        pool_.data() + std::size_t{points_.choice(sets, pixel, pass_)} * static_cast<std::size_t>(count);
    for (int i = 0; i < count; ++i) sum += from_light(x, set[i], rays);
  }
  if (strategy_.brdf > 0) {
    const Points::Lattice lattice = points_.lattice(Stream::brdf, pixel, pass_);
    for (int i = 0; i < count; ++i) {
      const auto [u1, u2] = lattice[i];
      sum += from_brdf(x, u1, u2, rays);
    }
  }
  return {sum.diffuse / count, sum.specular / count};
}

Estimate Estimator::direct(const Receiver& x, std::uint64_t& rays) const {
  Estimate sum;
  for (const Source& source : sources_) {
    const Source::Arrival arrival = source.arrival(x.position());
    const Estimate unshadowed = reflect(x, x.respond(arrival.incident), arrival.irradiance);
    if (unshadowed.is_zero()) continue;
    ++rays;
    if (!in_shadow(x.position(), x.normal(), source, arrival.incident)) sum += unshadowed;
  }
  return sum;
}

}  // namespace vsgl::reference
