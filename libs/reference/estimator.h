#pragma once

// Estimates of one-bounce light at a receiver. docs/reference.md derives them.

#include <cstdint>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "reference/guide.h"
#include "reference/paths.h"
#include "reference/points.h"
#include "trace/tracer.h"

namespace vsgl::reference {

// Which densities a path's contribution is divided by, 0 or 1 each: the balance heuristic [Veach 1995] for
// one sample of each technique.
struct Strategy {
  double light, brdf;
};
// Throws bad_value unless `name` is light, brdf or mis.
Strategy strategy_named(const std::string& name);

// Reflected radiance, W/(m^2 sr).
struct Estimate {
  Vec3 diffuse, specular;

  bool is_zero() const { return diffuse == Vec3{} && specular == Vec3{}; }
  Estimate& operator+=(const Estimate& other) {
    diffuse += other.diffuse;
    specular += other.specular;
    return *this;
  }
};

// The scene as the estimators see it; const members may be called from many threads.
class Estimator {
 public:
  // Scene and G-buffer must outlive it. `lit`: pixels that reflect light. `points`: of a pass, for each pixel
  // and kind of path. Looks where the light comes from that each part of the image sees.
  Estimator(const scene::Scene& scene, const GBuffer& gbuffer, const std::vector<std::uint32_t>& lit,
            Strategy strategy, std::uint64_t seed, int points);

  // Mean over one pass's points. Adds the rays traced to `rays`.
  Estimate indirect(const Receiver& x, std::uint32_t pixel, std::uint32_t pass, std::uint64_t& rays) const;
  // Light straight from the sources, exact.
  Estimate direct(const Receiver& x, std::uint64_t& rays) const;

 private:
  LitPoint trace_light_path(std::array<double, 2> u) const;
  void learn(const GBuffer& gbuffer, const std::vector<std::uint32_t>& lit);
  void add_importance(const Receiver& x, const std::vector<LitPoint>& pilots,
                      std::array<double, Guide::kCells>& weights) const;
  std::size_t tile_of(std::uint32_t pixel) const;
  // What y sends to the camera by way of x, over the densities of the strategy; shadows are left out.
  // `guidance`: how much denser light paths to y are than without a guide.
  Estimate connect(const Receiver& x, const LitPoint& y, double guidance) const;
  Estimate from_light(const Receiver& x, std::size_t tile, std::array<double, 2> point,
                      std::uint64_t& rays) const;
  Estimate from_brdf(const Receiver& x, std::size_t tile, std::array<double, 2> point,
                     std::uint64_t& rays) const;
  bool in_shadow(Vec3 point, Vec3 normal, const Source& source, Vec3 incident) const;

  trace::Tracer tracer_;
  Strategy strategy_;
  Points points_;
  double lift_;  // m
  std::vector<Source> sources_;
  std::uint32_t width_, columns_;  // of the image: pixels and tiles a row
  Guide guide_;
};

}  // namespace vsgl::reference
