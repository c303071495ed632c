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

// A point of the unit disk.
struct DiskPoint {
  double x, y;
  double area() const { return x * x + y * y; }  // share of the disk that is nearer to the centre
};

// [Shirley 1997] The unit square onto the unit disk, areas in proportion and neighbours kept together; and
// back.
DiskPoint square_to_disk(double u1, double u2) {
  const double a = 2 * u1 - 1, b = 2 * u2 - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b, turn = wide ? pi / 4 * b / a : pi / 2 - pi / 4 * a / b;
  return {r * std::cos(turn), r * std::sin(turn)};
}

std::array<double, 2> disk_to_square(DiskPoint p) {
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double main = wide ? p.x : p.y, other = wide ? p.y : p.x;
  const double r = std::copysign(std::sqrt(p.area()), main);
  const double across = main == 0 ? 0 : r * 4 / pi * std::atan(other / main);
  const double a = wide ? r : across, b = wide ? across : r;
  return {std::clamp((a + 1) / 2, 0.0, 1.0), std::clamp((b + 1) / 2, 0.0, 1.0)};
}

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

void Source::set_share(double first, double probability) {
  first_ = first;
  probability_ = probability;
}

Source::Start Source::sample(double u1, double u2) const {
  const DiskPoint p = square_to_disk(std::clamp((u1 - first_) / probability_, 0.0, 1.0), u2);
  if (is_directional()) return {frame_.to_world(disk_radius_ * Vec3{p.x, p.y, -1}), frame_.z, 0};
  // The inverse of the integral of the fall-off over cosines, which grows from the cone's edge inwards.
  const double mass = (1 - p.area()) * (rim_ + 1 - cone_full_);
  const double cosine =
      mass < rim_ ? cone_end_ + std::cbrt(3 * cone_width_ * cone_width_ * mass) : cone_full_ + (mass - rim_);
  const double c = std::clamp(cosine, -1.0, 1.0);
  const double s = p.area() > 0 ? std::sqrt((1 - c * c) / p.area()) : 0;
  return {light_.position, frame_.to_world({s * p.x, s * p.y, c}), near_};
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

std::array<double, 2> Source::start_of_path_to(Vec3 point) const {
  Vec3 local = frame_.to_local(is_directional() ? point / disk_radius_ : normalise(point - light_.position));
  if (!is_directional()) {
    const double rise = local.z - cone_end_;
    const double mass = local.z < cone_full_ ? rise * rise * rise / (3 * cone_width_ * cone_width_)
                                             : rim_ + local.z - cone_full_;
    const double area = std::max(1 - mass / (rim_ + 1 - cone_full_), 0.0),
                 s2 = local.x * local.x + local.y * local.y;
    local *= s2 > 0 ? std::sqrt(area / s2) : 0;
  }
  const auto [u1, u2] = disk_to_square({local.x, local.y});
  return {first_ + probability_ * u1, u2};
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
  double below = 0;
  for (Source& source : sources) {
    source.set_share(below / sum, source.power() / sum);
    below += source.power();
  }
  return sources;
}

}  // namespace vsgl::reference
