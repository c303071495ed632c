#pragma once

#include <array>
#include <vector>

#include "math/frame.h"
#include "math/light_source.h"

namespace vsgl::reference {

// A light of the scene as the start of paths.
class Source {
 public:
  explicit Source(const LightSource& light, double scene_radius);

  // Power that its paths carry, W, luminance.
  double power() const { return power_; }
  // All light paths start at points of the unit square; a source has those whose first coordinate is within a
  // share of 0..1 that is its probability.
  double first() const { return first_; }
  double probability() const { return probability_; }
  void set_share(double first, double probability);

  // Start and unit direction of a path, from a point of its share of the unit square: directions in
  // proportion to the intensity, or for directional light places on a disk that holds the scene.
  struct Start {
    Vec3 origin, direction;
    double nearest;  // what is nearer casts no shadow, m
  };
  Start sample(double u1, double u2) const;

  // What a point receives unless it is in shadow.
  struct Arrival {
    Vec3 incident;       // unit, towards the source
    Vec3 irradiance;     // on a plane facing the source, W/m^2
    double density = 0;  // of light paths on that plane, 1/m^2; 0: no light comes here
  };
  Arrival arrival(Vec3 point) const;
  // The point of the unit square whose path goes to `point`, where arrival() has a density.
  std::array<double, 2> start_of_path_to(Vec3 point) const;

  bool is_directional() const { return light_.type == LightType::directional; }
  Vec3 position() const { return light_.position; }

 private:
  LightSource light_;
  Frame frame_;             // z = forward
  double disk_radius_;      // directional, m
  double near_;             // m
  double cone_end_ = -1;    // cosine at which intensity reaches 0; -1 for point lights
  double cone_width_ = 0;   // in cosines, over which it rises to its full value
  double cone_full_ = 1;    // cosine from which it is full, or 1
  double rim_ = 0;          // integral of the fall-off over cosines, rising part
  double solid_angle_ = 1;  // integral of the fall-off, sr
  double power_ = 0, first_ = 0, probability_ = 1;
};

// The lights of a scene that emit anything, with probabilities in proportion to their power. Throws bad_light
// when there is none.
std::vector<Source> make_sources(const std::vector<LightSource>& lights, double scene_radius);

}  // namespace vsgl::reference
