#include "stages/visibility/raytraced.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "math/interop_vec.h"
#include "stages/visibility/representative.h"
#include "stages/visibility/views.h"
#include "trace/tracer.h"

namespace vsgl::visibility {
namespace {

using trace::SurfacePoint;

constexpr std::size_t word_bits = 32;

constexpr double reach = 4;               // scene radii that rays towards an environment go
constexpr double deepest_elevation = -4;  // standard deviations of a lobe below the horizon that still count

// A light that rays go to.
struct Emitter {
  SurfacePoint point;  // of an environment light: position 0, the normal along the light
  bool traced = true;
  double distant = 0;    // m: how far rays go towards an environment light; 0: another light
  double deviation = 0;  // of an environment light's directions, rad
};

Emitter environment_emitter(const interop::Light& light, double scene_radius) {
  const double sharpness = std::max(static_cast<double>(light.diffuse_sharpness), 1.0);
  return {{{}, to_double(light.diffuse_axis)}, true, reach * scene_radius, 1 / std::sqrt(sharpness)};
}

std::vector<Emitter> make_emitters(const VisibilityInputs& inputs, bool skip_powerless,
                                   const trace::Tracer& tracer, Report& report) {
  const Lights& lights = inputs.lights;
  std::vector<Emitter> emitters;
  emitters.reserve(lights.lights.size());
  std::size_t skipped = 0;
  for (const interop::Light& light : lights.lights) {
    const bool traced = !skip_powerless || has_power(light);
    emitters.push_back(lights.kind == LightsKind::environment
                           ? environment_emitter(light, inputs.scene.radius)
                           : Emitter{representative(light, lights.scene_radius, tracer)});
    emitters.back().traced = traced;
    skipped += !traced;
  }
  if (skipped > 0) report.skipped("rays to " + std::to_string(skipped) + " lights", "they have no power");
  return emitters;
}

// Behind the horizon of either surface the surface itself is in between.
bool face_each_other(const SurfacePoint& a, const SurfacePoint& b) {
  const Vec3 v = b.position - a.position;
  return dot(v, a.normal) > 0 && dot(v, b.normal) < 0;
}

// Where a ray from the pixel to the light ends; nowhere if the pixel turns away. The ray to an environment
// light goes along its axis to a point outside the scene, that is no surface. An axis at or below the horizon
// is raised above it by half the lobe's deviation: shading adds up what of the lobe is above.
std::optional<SurfacePoint> target(const SurfacePoint& pixel, const Emitter& light) {
  if (light.distant == 0)
    return face_each_other(pixel, light.point) ? std::optional(light.point) : std::nullopt;
  const Vec3 axis = -light.point.normal;
  const double elevation = dot(axis, pixel.normal);
  if (elevation < deepest_elevation * light.deviation) return std::nullopt;
  const double raise = std::max(0.5 * light.deviation - elevation, 0.0);
  return SurfacePoint{pixel.position + light.distant * normalise(axis + raise * pixel.normal), {}};
}

struct Word {
  std::uint32_t visible = 0;
  std::size_t rays = 0;
};

// Which of up to 32 lights a pixel sees.
Word trace_word(const trace::Tracer& tracer, const SurfacePoint& pixel, std::span<const Emitter> emitters) {
  std::array<SurfacePoint, word_bits> targets;
  std::array<std::uint32_t, word_bits> bits;
  Word word;
  for (std::uint32_t i = 0; i < emitters.size(); ++i) {
    const auto end = emitters[i].traced ? target(pixel, emitters[i]) : std::nullopt;
    if (!end) continue;
    targets[word.rays] = *end;
    bits[word.rays++] = i;
  }
  const std::uint32_t hidden = tracer.occluded(pixel, std::span(targets).first(word.rays));
  for (std::size_t k = 0; k < word.rays; ++k) word.visible |= (~hidden >> k & 1U) << bits[k];
  return word;
}

// Fills the words of all pixels; returns the number of rays.
std::size_t trace_words(const trace::Tracer& tracer, const GBuffer& gbuffer,
                        std::span<const Emitter> emitters, VisibilityBits& bits) {
  const auto width = static_cast<std::size_t>(gbuffer.width);
  const auto tasks = static_cast<std::size_t>(bits.words_per_pixel()) * static_cast<std::size_t>(bits.height);
  std::size_t rays = 0;
#pragma omp parallel for schedule(dynamic, 4) reduction(+ : rays)
  for (std::size_t task = 0; task < tasks; ++task) {
    const std::size_t first = task / static_cast<std::size_t>(bits.height) * word_bits;
    const std::size_t row = task % static_cast<std::size_t>(bits.height);
    const auto lights = emitters.subspan(first, std::min(word_bits, emitters.size() - first));
    for (std::size_t x = 0; x < width; ++x) {
      const interop::Surface& s = gbuffer.pixels[row * width + x];
      if (s.id == interop::NO_INSTANCE) continue;
      const Word word = trace_word(tracer, {to_double(s.position), to_double(s.normal)}, lights);
      bits.words[task * width + x] = word.visible;
      rays += word.rays;
    }
  }
  return rays;
}

void report_bits(const VisibilityBits& bits, const GBuffer& gbuffer, std::size_t rays, Report& report) {
  const auto seen = static_cast<std::size_t>(
      std::count_if(gbuffer.pixels.begin(), gbuffer.pixels.end(),
                    [](const interop::Surface& s) { return s.id != interop::NO_INSTANCE; }));
  if (seen < gbuffer.pixels.size())
    report.skipped("background", std::to_string(gbuffer.pixels.size() - seen) + " pixels see nothing");
  const std::size_t pairs = seen * static_cast<std::size_t>(bits.lights);
  std::size_t visible = 0;
  for (const std::uint32_t word : bits.words) visible += static_cast<std::size_t>(std::popcount(word));
  report.count("pairs", pairs);
  report.count("rays", rays);
  if (pairs > 0) report.count("visible_fraction", static_cast<double>(visible) / static_cast<double>(pairs));
}

}  // namespace

Visibility trace_visibility(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device*,
                            Report& report) {
  const GBuffer& gbuffer = *inputs.gbuffer;
  const Lights& lights = inputs.lights;
  VisibilityBits bits;
  bits.width = gbuffer.width;
  bits.height = gbuffer.height;
  bits.lights = static_cast<int>(lights.lights.size());
  bits.anchor = inputs.scene.anchor;
  bits.words.resize(gbuffer.pixels.size() * static_cast<std::size_t>(bits.words_per_pixel()));
  std::optional<trace::Tracer> tracer;
  {
    const PhaseTimer timer(report, "build");
    tracer.emplace(inputs.scene);
  }
  const PhaseTimer timer(report, "rays");
  const auto emitters = make_emitters(inputs, params.skip_powerless, *tracer, report);
  const std::size_t rays = trace_words(*tracer, gbuffer, emitters, bits);
  report_bits(bits, gbuffer, rays, report);
  return bits;
}

}  // namespace vsgl::visibility
