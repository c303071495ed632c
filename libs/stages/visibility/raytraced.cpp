#include "stages/visibility/raytraced.h"

#include <algorithm>
#include <array>
#include <bit>
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

// A light that rays go to.
struct Emitter {
  SurfacePoint point;
  bool traced = true;
};

std::vector<Emitter> make_emitters(const Lights& lights, bool skip_powerless, const trace::Tracer& tracer,
                                   Report& report) {
  std::vector<Emitter> emitters;
  emitters.reserve(lights.lights.size());
  std::size_t skipped = 0;
  for (const interop::Light& light : lights.lights) {
    const bool traced = !skip_powerless || has_power(light);
    emitters.push_back({representative(light, lights.scene_radius, tracer), traced});
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
    if (!emitters[i].traced || !face_each_other(pixel, emitters[i].point)) continue;
    targets[word.rays] = emitters[i].point;
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
  bits.anchor = lights.anchor;
  bits.words.resize(gbuffer.pixels.size() * static_cast<std::size_t>(bits.words_per_pixel()));
  std::optional<trace::Tracer> tracer;
  {
    const PhaseTimer timer(report, "build");
    tracer.emplace(inputs.scene);
  }
  const PhaseTimer timer(report, "rays");
  const auto emitters = make_emitters(lights, params.skip_powerless, *tracer, report);
  const std::size_t rays = trace_words(*tracer, gbuffer, emitters, bits);
  report_bits(bits, gbuffer, rays, report);
  return bits;
}

}  // namespace vsgl::visibility
