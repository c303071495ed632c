#include "reference/reference.h"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>

#include "base/error.h"
#include "interop/model.h"
#include "math/interop_vec.h"
#include "reference/accumulator.h"
#include "reference/estimator.h"
#include "reference/fingerprint.h"

namespace vsgl::reference {
namespace {

// The error is estimated from this many passes at least, each of so many points at most.
constexpr int kMinPasses = 8, kMaxPassPoints = 32;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check(const scene::Scene& scene, const GBuffer& gbuffer, const ReferenceParams& params) {
  const auto require = [](bool sound, ErrorCode code, const std::string& message) {
    if (!sound) throw Error(code, message);
  };
  require(params.samples >= 1 && params.samples <= kMaxSamples, ErrorCode::out_of_range,
          "samples: " + std::to_string(params.samples) + " is not within 1..16777216");
  require(!params.target_error || *params.target_error > 0, ErrorCode::out_of_range,
          "target error: must be above 0");
  require(!params.time_budget_s || *params.time_budget_s > 0, ErrorCode::out_of_range,
          "time budget: must be above 0");
  require(gbuffer.anchor == scene.anchor, ErrorCode::invalid_data,
          "the G-buffer has another anchor than the scene; bake it from the same scene file");
}

// Points of a pass: a power of two.
int pass_points(int samples) {
  return static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::clamp(samples / kMinPasses, 1, kMaxPassPoints))));
}

std::vector<std::uint32_t> pixels_that_reflect(const GBuffer& gbuffer) {
  std::vector<std::uint32_t> lit;
  for (std::uint32_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const interop::Surface& pixel = gbuffer.pixels[i];
    if (pixel.id != interop::NO_INSTANCE && !Receiver(pixel, gbuffer.camera).is_black()) lit.push_back(i);
  }
  return lit;
}

// The image in the making.
class Job {
 public:
  Job(const scene::Scene& scene, const GBuffer& gbuffer, const ReferenceParams& params, Report& report);

  void trace(const std::function<void(double)>& progress);
  Reference result() const;

 private:
  void one_pass();
  bool is_done() const;
  double share_done() const;
  void save_checkpoint();

  template <typename Work>
  std::uint64_t for_each_pixel(Work work) const;  // sums what `work` returns

  const GBuffer& gbuffer_;
  const ReferenceParams& params_;
  Report& report_;
  int points_, wanted_passes_;
  std::vector<std::uint32_t> lit_;
  Estimator estimator_;
  Accumulator accumulator_;
  std::string key_;
  int passes_ = 0, saved_passes_ = 0;
  std::uint64_t rays_ = 0;
  Clock::time_point start_ = Clock::now(), saved_ = start_;
  std::vector<interop::vec3> direct_;
};

Job::Job(const scene::Scene& scene, const GBuffer& gbuffer, const ReferenceParams& params, Report& report)
    : gbuffer_(gbuffer),
      params_(params),
      report_(report),
      points_(pass_points(params.samples)),
      wanted_passes_(std::max(kMinPasses, (params.samples + points_ - 1) / points_)),
      lit_(pixels_that_reflect(gbuffer)),
      estimator_(scene, gbuffer, lit_, strategy_named(params.strategy), params.seed, points_),
      accumulator_(gbuffer.width, gbuffer.height),
      direct_(gbuffer.pixels.size()) {
  if (params.checkpoint.empty()) return;
  key_ = fingerprint(scene, gbuffer) + " " + params.strategy + " " + std::to_string(params.seed) + " " +
         std::to_string(points_);
  passes_ = saved_passes_ = accumulator_.load(params.checkpoint, key_).value_or(0);
  report.count("resumed_passes", passes_);
}

template <typename Work>
std::uint64_t Job::for_each_pixel(Work work) const {
  std::uint64_t sum = 0;
#pragma omp parallel for schedule(dynamic, 32) reduction(+ : sum)
  for (std::size_t i = 0; i < lit_.size(); ++i)
    sum += work(lit_[i], Receiver(gbuffer_.pixels[lit_[i]], gbuffer_.camera));
  return sum;
}

void Job::one_pass() {
  const auto pass = static_cast<std::uint32_t>(passes_++);
  rays_ += for_each_pixel([&](std::uint32_t pixel, const Receiver& x) {
    std::uint64_t rays = 0;
    accumulator_.add(pixel, estimator_.indirect(x, pixel, pass, rays), passes_);
    return rays;
  });
}

bool Job::is_done() const {
  if (passes_ >= wanted_passes_) return true;
  // A variance takes two passes.
  if (params_.time_budget_s && passes_ >= 2 && seconds_since(start_) >= *params_.time_budget_s) return true;
  return params_.target_error && passes_ >= kMinPasses &&
         accumulator_.relative_error(lit_, passes_) <= *params_.target_error;
}

// By whichever limit is nearest.
double Job::share_done() const {
  double share = static_cast<double>(passes_) / wanted_passes_;
  if (params_.time_budget_s) share = std::max(share, seconds_since(start_) / *params_.time_budget_s);
  if (params_.target_error) {
    const double left = accumulator_.relative_error(lit_, passes_) / *params_.target_error;
    share = std::max(share, 1 / (left * left));
  }
  return std::min(share, 1.0);
}

void Job::save_checkpoint() {
  if (params_.checkpoint.empty() || saved_passes_ == passes_) return;
  accumulator_.save(params_.checkpoint, key_, passes_);
  saved_passes_ = passes_;
  saved_ = Clock::now();
}

void Job::trace(const std::function<void(double)>& progress) {
  {
    const PhaseTimer timer(report_, "direct light");
    rays_ += for_each_pixel([&](std::uint32_t pixel, const Receiver& x) {
      std::uint64_t rays = 0;
      const Estimate light = estimator_.direct(x, rays);
      direct_[pixel] = to_float(light.diffuse + light.specular);
      return rays;
    });
  }
  const PhaseTimer timer(report_, "indirect light");
  while (!is_done()) {
    one_pass();
    if (progress) progress(share_done());
    if (seconds_since(saved_) >= params_.checkpoint_interval_s) save_checkpoint();
  }
  save_checkpoint();
  const double error = accumulator_.relative_error(lit_, passes_);
  report_.count("samples", static_cast<std::uint64_t>(passes_) * static_cast<std::uint64_t>(points_));
  report_.count("passes", passes_);
  report_.count("relative_error", error);
  report_.count("rays", rays_);
  report_.count("rays_per_s", static_cast<double>(rays_) / seconds_since(start_));
  if (params_.target_error && error > *params_.target_error)
    report_.warn("the target error was not reached: the relative error is " + std::to_string(error));
}

Reference Job::result() const {
  const std::size_t count = accumulator_.size();
  Reference out;
  out.strategy = params_.strategy;
  out.samples = static_cast<std::uint64_t>(passes_) * static_cast<std::uint64_t>(points_);
  out.passes = passes_;
  out.radiance.width = gbuffer_.width;
  out.radiance.height = gbuffer_.height;
  out.radiance.direct = direct_;
  for (std::size_t i = 0; i < count; ++i) {
    out.radiance.diffuse.push_back(to_float(accumulator_.diffuse(i)));
    out.variance.push_back(to_float(accumulator_.variance(i, passes_)));
  }
  if (!gbuffer_.has_specular()) return out;
  for (std::size_t i = 0; i < count; ++i) out.radiance.specular.push_back(to_float(accumulator_.specular(i)));
  return out;
}

}  // namespace

Reference trace_reference(const scene::Scene& scene, const GBuffer& gbuffer, const ReferenceParams& params,
                          Report& report, const std::function<void(double)>& progress) {
  check(scene, gbuffer, params);
  Job job(scene, gbuffer, params, report);
  job.trace(progress);
  return job.result();
}

}  // namespace vsgl::reference
