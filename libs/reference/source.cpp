#include "reference/source.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "trace/tracer.h"

namespace vsgl::reference {
namespace {

using std::numbers::pi;

// The disk of a directional light is a little larger than the scene, so that rounding cuts nothing off.
constexpr double kDiskMargin = 1.001;

}  // namespace

Source::Source(const LightSource& light, double scene_radius)
    : light_(light),
      frame_(frame_about(normalise(light.forward))),
      disk_radius_(kDiskMargin * scene_radius),
      near_(trace::kNear * scene_radius) {
  if (is_directional()) {
    power_ = luminance(light.intensity) * pi * disk_radius_ * disk_radius_;
    return;
  }
  if (light.type == LightType::spot) {
    cone_end_ = light.cos_outer;
    // The fall-off of spot_falloff(): a parabola over this width, or a hard edge.
    cone_width_ = light.cos_inner > light.cos_outer ? std::max(1e-3, light.cos_inner - light.cos_outer) : 0;
    cone_full_ = std::min(cone_end_ + cone_width_, 1.0);
    const double rise = cone_full_ - cone_end_;
    rim_ = cone_width_ > 0 ? rise * rise * rise / (3 * cone_width_ * cone_width_) : 0;
  } else {
    cone_full_ = -1;
  }
  solid_angle_ = 2 * pi * (rim_ + 1 - cone_full_);
  power_ = luminance(light.intensity) * solid_angle_;
}

Source::Start Source::sample(double u1, double u2) const {
  const double phi = 2 * pi * u2;
  if (is_directional()) {
    const double r = disk_radius_ * std::sqrt(u1);
    return {frame_.to_world({r * std::cos(phi), r * std::sin(phi), -disk_radius_}), frame_.z, 0};
  }
  // The inverse of the integral of the fall-off over cosines, from the cone's edge inwards.
  const double mass = u1 * (rim_ + 1 - cone_full_);
  const double cosine =
      mass < rim_ ? cone_end_ + std::cbrt(3 * cone_width_ * cone_width_ * mass) : cone_full_ + (mass - rim_);
  const double c = std::clamp(cosine, -1.0, 1.0), s = std::sqrt(1 - c * c);
  return {light_.position, frame_.to_world({s * std::cos(phi), s * std::sin(phi), c}), near_};
}

Source::Arrival Source::arrival(Vec3 point) const {
  if (is_directional())
    return {-frame_.z, light_.intensity, probability_ / (pi * disk_radius_ * disk_radius_)};
  const Vec3 v = light_.position - point;
  const double d2 = dot(v, v), d = std::sqrt(d2);
  if (d <= near_) return {};
  const Vec3 incident = v / d;
  const double falloff = spot_falloff(light_, -dot(incident, frame_.z)) / d2;
  return {incident, falloff * light_.intensity, falloff * probability_ / solid_angle_};
}

std::vector<Source> make_sources(const std::vector<LightSource>& lights, double scene_radius) {
  std::vector<Source> sources;
  double sum = 0;
  for (const LightSource& light : lights) {
    const Source source(light, scene_radius);
    if (!(source.power() > 0)) continue;
    sources.push_back(source);
    sum += source.power();
  }
  if (sources.empty()) throw Error(ErrorCode::bad_light, "no light of the scene emits anything; add one");
  for (Source& source : sources) source.set_probability(source.power() / sum);
  return sources;
}

}  // namespace vsgl::reference
