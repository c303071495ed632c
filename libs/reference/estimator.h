#pragma once

// Estimates of one-bounce light at a receiver. docs/reference.md derives them.

#include <cstdint>
#include <string>
#include <vector>

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
  // The scene must outlive it.
  Estimator(const scene::Scene& scene, Strategy strategy, std::uint64_t seed, int points);

  // Traces the light paths that the pixels of a pass share.
  void start_pass(std::uint32_t pass, std::size_t pixels);

  // Mean over one pass's points. Adds the rays traced to `rays`.
  Estimate indirect(const Receiver& x, std::uint32_t pixel, std::uint64_t& rays) const;
  // Light straight from the sources, exact.
  Estimate direct(const Receiver& x, std::uint64_t& rays) const;

  // Rays of the last start_pass().
  std::uint64_t pool_rays() const { return pool_.size(); }

 private:
  LitPoint trace_light_path(double u1, double u2) const;
  // What y sends to the camera by way of x, over the densities of the strategy; shadows are left out.
  Estimate connect(const Receiver& x, const LitPoint& y) const;
  Estimate from_light(const Receiver& x, const LitPoint& y, std::uint64_t& rays) const;
  Estimate from_brdf(const Receiver& x, double u1, double u2, std::uint64_t& rays) const;
  bool in_shadow(Vec3 point, Vec3 normal, const Source& source, Vec3 incident) const;

  trace::Tracer tracer_;
  Strategy strategy_;
  Points points_;
  double lift_;  // m
  std::vector<Source> sources_;
  std::uint32_t pass_ = 0;
  std::vector<LitPoint> pool_;  // sets of as many lit points as a pass has points
};

}  // namespace vsgl::reference
