#include "reference/estimator.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "math/interop_vec.h"

namespace vsgl::reference {
namespace {

constexpr std::uint32_t kTile = 8;    // pixels a side
constexpr std::size_t kLearners = 4;  // pixels of a tile that tell where its light comes from

// The source that has the point in its share.
const Source& source_at(const std::vector<Source>& sources, double u1) {
  std::size_t k = sources.size() - 1;
  while (k > 0 && u1 < sources[k].first()) --k;
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

Estimator::Estimator(const scene::Scene& scene, const GBuffer& gbuffer, const std::vector<std::uint32_t>& lit,
                     Strategy strategy, std::uint64_t seed, int points)
    : tracer_(scene),
      strategy_(strategy),
      points_(seed, points),
      lift_(trace::kLift * scene.radius),
      sources_(make_sources(scene.lights, scene.radius)),
      width_(static_cast<std::uint32_t>(gbuffer.width)),
      columns_((width_ + kTile - 1) / kTile) {
  if (strategy_.light > 0) learn(gbuffer, lit);
}

LitPoint Estimator::trace_light_path(std::array<double, 2> u) const {
  const Source& source = source_at(sources_, u[0]);
  const Source::Start start = source.sample(u[0], u[1]);
  const auto hit = tracer_.intersect(start.origin, start.direction, start.nearest);
  if (!hit) return {};
  const interop::Surface surface = tracer_.surface(*hit, -start.direction);
  return light_surface(surface, source.arrival(to_double(surface.position)));
}

std::size_t Estimator::tile_of(std::uint32_t pixel) const {
  return std::size_t{pixel / width_ / kTile} * columns_ + pixel % width_ / kTile;
}

void Estimator::learn(const GBuffer& gbuffer, const std::vector<std::uint32_t>& lit) {
  const auto rows = (static_cast<std::size_t>(gbuffer.height) + kTile - 1) / kTile;
  guide_ = Guide(rows * columns_);
  std::vector<LitPoint> pilots(Guide::kCells);
#pragma omp parallel for schedule(dynamic, 64)
  for (int cell = 0; cell < Guide::kCells; ++cell) {
    const auto [x, y] = points_.point(Stream::pilot, static_cast<std::uint32_t>(cell), 0);
    pilots[static_cast<std::size_t>(cell)] = trace_light_path(Guide::point_in(cell, x, y));
  }
  std::vector<std::vector<std::uint32_t>> pixels_of(rows * columns_);
  for (const std::uint32_t pixel : lit) pixels_of[tile_of(pixel)].push_back(pixel);
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t tile = 0; tile < pixels_of.size(); ++tile) {
    const std::vector<std::uint32_t>& pixels = pixels_of[tile];
    const std::size_t learners = std::min(kLearners, pixels.size());
    std::array<double, Guide::kCells> weights{};
    for (std::size_t i = 0; i < learners; ++i) {
      const std::uint32_t pixel = pixels[(2 * i + 1) * pixels.size() / (2 * learners)];
      add_importance(Receiver(gbuffer.pixels[pixel], gbuffer.camera), pilots, weights);
    }
    guide_.set(tile, weights);
  }
}

// Adds the share of x's light, before shadows, that comes through each cell.
void Estimator::add_importance(const Receiver& x, const std::vector<LitPoint>& pilots,
                               std::array<double, Guide::kCells>& weights) const {
  std::array<double, Guide::kCells> light{};
  for (std::size_t cell = 0; cell < Guide::kCells; ++cell) {
    if (pilots[cell].density == 0) continue;
    const Estimate sent = connect(x, pilots[cell], 1);
    light[cell] = luminance(sent.diffuse + sent.specular);
  }
  const double sum = std::accumulate(light.begin(), light.end(), 0.0);
  for (std::size_t cell = 0; sum > 0 && cell < Guide::kCells; ++cell) weights[cell] += light[cell] / sum;
}

Estimate Estimator::connect(const Receiver& x, const LitPoint& y, double guidance) const {
  const Vec3 v = y.position - x.position();
  const double distance2 = dot(v, v);
  if (distance2 == 0) return {};
  const Vec3 u = v / std::sqrt(distance2);
  const double geometry = std::max(-dot(y.normal, u), 0.0) / distance2;
  const double brdf_density = strategy_.brdf > 0 ? x.density(u) * geometry : 0;
  const double density = strategy_.light * guidance * y.density + brdf_density;
  if (geometry == 0 || density == 0) return {};
  return reflect(x, x.respond(u), geometry / density * y.radiance(-u));
}

Estimate Estimator::from_light(const Receiver& x, std::size_t tile, std::array<double, 2> point,
                               std::uint64_t& rays) const {
  const std::array<double, 2> start = guide_.warp(tile, point);
  ++rays;
  const LitPoint y = trace_light_path(start);
  if (y.density == 0) return {};
  const Estimate unshadowed = connect(x, y, guide_.density(tile, start));
  if (unshadowed.is_zero()) return {};
  ++rays;
  return tracer_.occluded(x.position(), x.normal(), y.position, y.normal) ? Estimate{} : unshadowed;
}

bool Estimator::in_shadow(Vec3 point, Vec3 normal, const Source& source, Vec3 incident) const {
  return source.is_directional() ? tracer_.occluded_to_infinity(point, normal, incident)
                                 : tracer_.occluded(point, normal, source.position(), {});
}

Estimate Estimator::from_brdf(const Receiver& x, std::size_t tile, std::array<double, 2> point,
                              std::uint64_t& rays) const {
  const Vec3 u = x.sample(point[0], point[1]);
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
    const double guidance =
        strategy_.light > 0 ? guide_.density(tile, source.start_of_path_to(y.position)) : 0;
    const Estimate unshadowed = connect(x, y, guidance);
    if (unshadowed.is_zero()) continue;
    ++rays;
    if (!in_shadow(y.position, y.normal, source, arrival.incident)) sum += unshadowed;
  }
  return sum;
}

Estimate Estimator::indirect(const Receiver& x, std::uint32_t pixel, std::uint32_t pass,
                             std::uint64_t& rays) const {
  Estimate sum;
  const int count = points_.count();
  const std::size_t tile = tile_of(pixel);
  if (strategy_.light > 0) {
    const Points::Lattice lattice = points_.lattice(Stream::light, pixel, pass);
    for (int i = 0; i < count; ++i) sum += from_light(x, tile, lattice[i], rays);
  }
  if (strategy_.brdf > 0) {
    const Points::Lattice lattice = points_.lattice(Stream::brdf, pixel, pass);
    for (int i = 0; i < count; ++i) sum += from_brdf(x, tile, lattice[i], rays);
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
