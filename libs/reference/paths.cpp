#include "reference/paths.h"

#include <algorithm>
#include <numbers>

#include "interop/geometry.h"
#include "interop/model.h"
#include "math/interop_vec.h"
#include "math/microfacet.h"

namespace vsgl::reference {
namespace {

constexpr double inverse_pi = std::numbers::inv_pi;

}  // namespace

Vec3 LitPoint::radiance(Vec3 w) const {
  if (dot(normal, w) <= 0) return {};
  Vec3 reflected = inverse_pi * diffuse;
  if (glossy) reflected += lobe.brdf_cos(w) / std::max(dot(shading_normal, w), cos_min) * specular;
  return irradiance * reflected;
}

LitPoint light_surface(const interop::Surface& surface, const Source::Arrival& arrival) {
  LitPoint y;
  y.normal = to_double(surface.normal);
  y.shading_normal = to_double(surface.shading_normal);
  const double cosine = dot(y.normal, arrival.incident),
               bent = std::min(dot(y.shading_normal, arrival.incident), double{interop::KAPPA_MAX} * cosine);
  y.diffuse = to_double(surface.diffuse);
  y.specular = to_double(surface.specular);
  if (cosine <= 0 || bent <= 0 || (y.diffuse == Vec3{} && y.specular == Vec3{})) return y;
  y.position = to_double(surface.position);
  y.irradiance = bent * arrival.irradiance;
  y.density = cosine * arrival.density;
  y.glossy = surface.ndf != interop::NDF_NONE;
  if (y.glossy) y.lobe = Specular(surface.ndf, surface.alpha, y.shading_normal, arrival.incident);
  return y;
}

Receiver::Receiver(const interop::Surface& pixel, Vec3 camera)
    : position_(to_double(pixel.position)),
      normal_(to_double(pixel.normal)),
      shading_normal_(to_double(pixel.shading_normal)),
      diffuse_(to_double(pixel.diffuse)) {
  if (pixel.ndf == interop::NDF_NONE) return;
  specular_ = to_double(pixel.specular);
  lobe_ = Specular(pixel.ndf, pixel.alpha, shading_normal_, normalise(camera - position_));
  specular_share_ = luminance(specular_) / (luminance(specular_) + luminance(diffuse_));
}

Receiver::Response Receiver::respond(Vec3 u) const {
  if (dot(normal_, u) <= 0) return {};
  return {inverse_pi * std::max(dot(shading_normal_, u), 0.0), specular_share_ > 0 ? lobe_.brdf_cos(u) : 0};
}

Vec3 Receiver::sample(double u1, double u2) const {
  if (u1 < specular_share_) return lobe_.sample(u1 / specular_share_, u2);
  const double r2 = (u1 - specular_share_) / (1 - specular_share_), r = std::sqrt(r2),
               phi = 2 * std::numbers::pi * u2;
  const Frame frame = frame_about(shading_normal_);
  return frame.to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - r2))});
}

double Receiver::density(Vec3 u) const {
  const double diffuse = (1 - specular_share_) * inverse_pi * std::max(dot(shading_normal_, u), 0.0);
  return specular_share_ > 0 ? diffuse + specular_share_ * lobe_.density(u) : diffuse;
}

}  // namespace vsgl::reference
