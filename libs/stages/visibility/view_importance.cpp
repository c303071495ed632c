#include "stages/visibility/view_importance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/interop_vec.h"
#include "math/sampling.h"

namespace vsgl::visibility {
namespace {

constexpr std::size_t kPairs = 256;
constexpr double kAdaptive = 0.5;    // share of the points that follow the view
constexpr float kReach = 0.05f;      // of a segment's length: there its importance is a quarter
constexpr double kNearClamp = 0.05;  // of the scene's radius, added to distances of pairs

// A light and a pixel that it may reach.
struct Segment {
  interop::vec3 start, along;
  float weight, squared_length;
};

// Index of the share u in [0,1) of a running sum.
std::size_t draw(const std::vector<double>& sum, double u) {
  const auto at = std::upper_bound(sum.begin(), sum.end(), u * sum.back());
  return std::min<std::size_t>(at - sum.begin(), sum.size() - 1);
}

template <class Items, class Weight>
std::vector<double> running_sum(const Items& items, Weight weight) {
  std::vector<double> sum(items.size());
  std::transform_inclusive_scan(items.begin(), items.end(), sum.begin(), std::plus<>(), weight);
  return sum;
}

// Geometric term between both surfaces, unshadowed, 1/m^2.
double transfer(const interop::Light& light, const interop::Surface& pixel, double softening) {
  const Vec3 v = to_double(pixel.position) - to_double(light.origin);
  const double d2 = dot(v, v);
  const double cosines =
      std::max(dot(v, to_double(light.normal)), 0.0) * std::max(-dot(v, to_double(pixel.normal)), 0.0);
  return d2 > 0 ? cosines / d2 / (d2 + softening) : 0;
}

// Pairs of a light, drawn by its power, and a pixel, drawn by its reflectance.
std::vector<Segment> draw_segments(const Lights& lights, const GBuffer& gbuffer, std::uint64_t seed) {
  const auto power = running_sum(lights.lights, [](const interop::Light& light) {
    return luminance(to_double(light.power_diffuse)) + luminance(to_double(light.power_specular));
  });
  const auto reflectance = running_sum(gbuffer.pixels, [](const interop::Surface& s) {
    return s.id == interop::NO_INSTANCE ? 0
                                        : luminance(to_double(s.diffuse)) + luminance(to_double(s.specular));
  });
  std::vector<Segment> segments;
  if (power.back() <= 0 || reflectance.back() <= 0) return segments;
  const double softening = std::pow(kNearClamp * lights.scene_radius, 2);
  const double shift = std::ldexp(
      pcg3d({static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), 0})[0], -32);
  for (std::size_t i = 0; i < kPairs; ++i) {
    const double first = (static_cast<double>(i) + 0.5) / kPairs;
    const double second = std::fmod(static_cast<double>(i) * 0.6180339887498949 + shift, 1.0);
    const interop::Light& light = lights.lights[draw(power, first)];
    const interop::Surface& pixel = gbuffer.pixels[draw(reflectance, second)];
    const double weight = transfer(light, pixel, softening);
    const Vec3 along = to_double(pixel.position) - to_double(light.origin);
    if (weight > 0)
      segments.push_back(
          {light.origin, to_float(along), static_cast<float>(weight), static_cast<float>(dot(along, along))});
  }
  return segments;
}

// Sum over segments, by their weights: 1 halfway along one, 1/4 at kReach of its length beside that, 0 at its
// ends, which are what it leaves and reaches and not what shadows it.
double nearness(Vec3 place, const std::vector<Segment>& segments) {
  const interop::vec3 p = to_float(place);
  constexpr float spread = kReach * kReach;
  float sum = 0;
  for (const Segment& s : segments) {
    const interop::vec3 v{p.x - s.start.x, p.y - s.start.y, p.z - s.start.z};
    const float t =
        std::clamp((v.x * s.along.x + v.y * s.along.y + v.z * s.along.z) / s.squared_length, 0.0f, 1.0f);
    const interop::vec3 off{v.x - t * s.along.x, v.y - t * s.along.y, v.z - t * s.along.z};
    const float reach = spread * s.squared_length;
    const float near = reach / (reach + off.x * off.x + off.y * off.y + off.z * off.z);
    sum += s.weight * near * near * 4 * t * (1 - t);
  }
  return static_cast<double>(sum);
}

}  // namespace

ViewImportance view_importance(const std::vector<Vec3>& centres, const std::vector<double>& areas,
                               const Lights& lights, const GBuffer& gbuffer, std::uint64_t seed) {
  const std::vector<Segment> segments = draw_segments(lights, gbuffer, seed);
  ViewImportance out{areas, segments.size()};
  if (segments.empty()) return out;
  std::vector<double> near(centres.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < centres.size(); ++i) near[i] = nearness(centres[i], segments);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double mean = std::inner_product(areas.begin(), areas.end(), near.begin(), 0.0) / area;
  for (std::size_t i = 0; i < areas.size(); ++i) out.weights[i] *= 1 - kAdaptive + kAdaptive * near[i] / mean;
  return out;
}

}  // namespace vsgl::visibility
