#pragma once

// The two ends of a one-bounce path, and what they exchange: a lit point y sends light to a receiver x.

#include <optional>

#include "interop/surface.h"
#include "reference/source.h"
#include "reference/specular.h"

namespace vsgl::reference {

// A surface point y in the light of one source.
struct LitPoint {
  Vec3 position, normal;  // geometric, on the side of the source
  Vec3 shading_normal;
  Vec3 irradiance;         // by the shading normal, W/m^2
  Vec3 diffuse, specular;  // reflectances
  Specular lobe;           // where specular is not 0; fixed direction: towards the source
  bool glossy = false;
  double density = 0;  // of light paths, 1/m^2; 0: no lit point

  // Radiance in the unit direction `w`, W/(m^2 sr); 0 on the other side.
  Vec3 radiance(Vec3 w) const;
};

// A surface in the light of a source; density 0 where none falls on the side of `surface`'s normal, or
// nothing is reflected.
LitPoint light_surface(const interop::Surface& surface, const Source::Arrival& arrival);

// The visible surface point x of a pixel.
class Receiver {
 public:
  Receiver(const interop::Surface& pixel, Vec3 camera);

  Vec3 position() const { return position_; }
  Vec3 normal() const { return normal_; }  // geometric
  Vec3 diffuse() const { return diffuse_; }
  Vec3 specular() const { return specular_; }
  bool is_black() const { return diffuse_ == Vec3{} && specular_ == Vec3{}; }

  // BRDF times cosine for unit reflectance, 1/sr; nothing arrives below the geometric horizon.
  struct Response {
    double diffuse = 0, specular = 0;
  };
  Response respond(Vec3 u) const;

  // A direction from a point of the unit square, by the reflectances of both lobes; it may lie below the
  // horizon.
  Vec3 sample(double u1, double u2) const;
  // Density of sample(), 1/sr.
  double density(Vec3 u) const;

 private:
  Vec3 position_, normal_, shading_normal_;
  Vec3 diffuse_, specular_;
  Specular lobe_;
  double specular_share_ = 0;  // probability of the specular lobe
};

}  // namespace vsgl::reference
