#include "stages/metrics/flicker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "math/vec.h"
#include "stages/metrics/spectrum.h"

namespace vsgl::metrics {
namespace {

using Difference = std::array<double, 3>;

constexpr double kPop = 0.1;             // relative change that is seen as a pop
constexpr double kRelativeFloor = 0.05;  // of the mean luminance, added to a pixel's own
constexpr int kSpectrumFrames = 64, kSpectrumBlock = 8;
constexpr double kVisibleLow = 5, kVisibleHigh = 20;  // Hz

double square(double x) {
  return x * x;
}
Difference operator-(const Colour& a, const Colour& b) {
  Difference out;
  for (int c = 0; c < 3; ++c) out[c] = static_cast<double>(a[c]) - static_cast<double>(b[c]);
  return out;
}
Difference operator-(const Difference& a, const Difference& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double luminance_of(const Difference& d) {
  return luminance({d[0], d[1], d[2]});
}
// Squares of the channels with the weights of luminance: for grey differences the square of their luminance.
// Deviation: not the square of the luminance itself, whose noise depends on how the channels' noise
// correlates; that of this sum follows from the variances alone.
double squares(const Difference& d) {
  return luminance({d[0] * d[0], d[1] * d[1], d[2] * d[2]});
}
double noise_of(const Frame& frame, std::size_t pixel) {
  return frame.variance.empty() ? 0 : metrics::luminance_of(frame.variance[pixel]);
}
bool is_black(const Colour& colour) {
  return colour == Colour{};
}

// Counts of values in steps of 0.54%, from 2^-30 to 2^10; smaller and larger ones go to the ends.
class FineHistogram {
 public:
  void add(double value) {
    const double position = value > 0 ? (std::log2(value) + kOctaves) * kSteps : -1;
    ++counts_[static_cast<std::size_t>(std::clamp(position + 1, 0.0, static_cast<double>(kBins - 1)))];
  }
  // Takes away values that are 0.
  void remove_zeros(std::size_t count) { counts_[0] -= count; }
  // The middle of the step that holds it. 0 where it is too small to tell.
  double quantile(double q) const {
    std::size_t all = 0, seen = 0;
    for (const std::size_t count : counts_) all += count;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += counts_[bin];
      if (static_cast<double>(seen) >= q * static_cast<double>(all))
        return bin == 0 ? 0 : std::exp2((static_cast<double>(bin) - 0.5) / kSteps - kOctaves);
    }
    return 0;
  }

 private:
  static constexpr double kSteps = 128, kOctaves = 30;
  static constexpr std::size_t kBins = 128 * 40 + 1;
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(kBins);
};

// Sums of a block of pixels.
enum BlockSum { kChange, kNoise, kRelative, kTerms, kBlockSums };

double flicker_of(const Sums& sums, double mean) {
  if (sums[kTerms] == 0) return 0;  // only blocks of background were drawn
  return std::sqrt(std::max(0.0, (sums[kChange] - sums[kNoise]) / sums[kTerms])) / mean;
}

class FlickerMeter {
 public:
  FlickerMeter(int frames, const Frames& test, const Frames& reference, double frame_rate_hz)
      : frames_(frames), read_test_(test), read_reference_(reference), frame_rate_hz_(frame_rate_hz) {}

  FlickerResult measure() {
    measure_reference();
    Frame test_before, before, now = reference(0), next;
    for (int t = 0; t < frames_; ++t) {
      next = t + 1 < frames_ ? reference(t + 1) : Frame();
      Frame test = check(read_test_(t));
      add_frame(test, now);
      check_timing(t, test, before, now, next);
      if (t > 0) {
        add_step(test_before, test, before, now);
        check_repetition(t, test_before, test, before, now);
      }
      test_before = std::move(test);
      before = std::move(now);
      now = std::move(next);
    }
    finish();
    return std::move(out_);
  }

 private:
  Frame reference(int t) { return check(read_reference_(t)); }

  Frame check(Frame frame) const {
    if (frame.width != width_ || frame.height != height_)
      throw Error(ErrorCode::wrong_size, "the frames are of different size: " + std::to_string(frame.width) +
                                             "x" + std::to_string(frame.height) + " and " +
                                             std::to_string(width_) + "x" + std::to_string(height_));
    return frame;
  }

  // What all else is relative to.
  void measure_reference() {
    double sum = 0;
    for (int t = 0; t < frames_; ++t) {
      const Frame frame = read_reference_(t);
      if (t == 0) allocate(frame);
      check(frame);
      for (std::size_t i = 0; i < lit_.size(); ++i) {
        sum += metrics::luminance_of(frame.colours[i]);
        if (!is_black(frame.colours[i])) lit_[i] = 1;
      }
    }
    const auto lit = std::count(lit_.begin(), lit_.end(), 1);
    if (lit == 0 || !(sum > 0))
      throw Error(ErrorCode::invalid_data,
                  "the reference is black in all frames: there is nothing that flicker could be relative to");
    out_.mean = sum / static_cast<double>(lit) / frames_;
  }

  void allocate(const Frame& frame) {
    width_ = frame.width;
    height_ = frame.height;
    lit_.assign(frame.colours.size(), 0);
    means_.assign(lit_.size(), {});
    spreads_.assign(lit_.size(), 0);
    blocks_.emplace(width_, height_);
    out_.block_changes.assign(blocks_->count(), Sums(kBlockSums));
    out_.frames = frames_;
  }

  // [Welford 1962] means and spreads of the errors over time.
  void add_frame(const Frame& test, const Frame& now) {
    ++added_;
    std::vector<double> luminances(lit_.size());
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      if (!is_black(test.colours[i])) lit_[i] = 1;
      const Difference error = test.colours[i] - now.colours[i];
      luminances[i] = luminance_of(error);
      error_sum_ += luminances[i];
      noise_sum_ += noise_of(now, i);
      const Difference from_mean = error - means_[i];
      for (int c = 0; c < 3; ++c) means_[i][c] += from_mean[c] / added_;
      spreads_[i] += squares(from_mean) * (added_ - 1) / added_;
    }
    if (frames_ >= kSpectrumFrames) add_signals(luminances);
  }

  // The mean error of each block of 8 x 8 pixels, one more moment.
  void add_signals(const std::vector<double>& luminances) {
    const int columns = (width_ + kSpectrumBlock - 1) / kSpectrumBlock;
    const int rows = (height_ + kSpectrumBlock - 1) / kSpectrumBlock;
    std::vector<double> sums(columns * rows), counts(sums.size());
    for (std::size_t i = 0; i < luminances.size(); ++i) {
      const std::size_t block = i / width_ / kSpectrumBlock * columns + i % width_ / kSpectrumBlock;
      sums[block] += luminances[i];
      ++counts[block];
    }
    signals_.resize(sums.size());
    for (std::size_t block = 0; block < sums.size(); ++block)
      signals_[block].push_back(sums[block] / counts[block]);
  }

  void add_step(const Frame& test_before, const Frame& test, const Frame& before, const Frame& now) {
    double sum = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const Difference change =
          (test.colours[i] - now.colours[i]) - (test_before.colours[i] - before.colours[i]);
      const double noise = noise_of(now, i) + noise_of(before, i);
      const double scale = std::abs(metrics::luminance_of(now.colours[i])) + kRelativeFloor * out_.mean;
      Sums& block = out_.block_changes[blocks_->of(i)];
      block[kChange] += squares(change);
      block[kNoise] += noise;
      block[kRelative] += (squares(change) - noise) / square(scale);
      sum += squares(change);
      const double relative = std::abs(luminance_of(change)) / scale;
      steps_.add(relative);
      if (relative > kPop) ++out_.pops;
    }
    step_sums_.push_back(sum);
  }

  // Does the frame look more like the reference's one before or after? Its error there must be half as large
  // in power, so that neither noise nor small motion are mistaken for a shift in time.
  void check_timing(int t, const Frame& test, const Frame& before, const Frame& now, const Frame& next) {
    const double here = distance(test, now);
    for (const auto& [frame, offset] : {std::pair{&before, -1}, std::pair{&next, 1}})
      if (!frame->colours.empty() && here > 0 && distance(test, *frame) < here / 2)
        out_.misaligned.push_back({t, offset});
  }

  double distance(const Frame& test, const Frame& other) const {
    double sum = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i)
      sum += squares(test.colours[i] - other.colours[i]) - noise_of(other, i);
    return sum;
  }

  void check_repetition(int t, const Frame& test_before, const Frame& test, const Frame& before,
                        const Frame& now) {
    if (test.colours != test_before.colours) return;
    double change = 0, noise = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      change += squares(now.colours[i] - before.colours[i]);
      noise += noise_of(now, i) + noise_of(before, i);
    }
    if (change - noise > change / 2) out_.repeated.push_back(t);
  }

  void finish() {
    out_.pixels = static_cast<std::size_t>(std::count(lit_.begin(), lit_.end(), 1));
    for (std::size_t i = 0; i < lit_.size(); ++i)
      if (lit_[i]) out_.block_changes[blocks_->of(i)][kTerms] += frames_ - 1;
    finish_flicker();
    finish_split();
    steps_.remove_zeros((lit_.size() - out_.pixels) * (frames_ - 1));
    out_.step_p99 = steps_.quantile(0.99);
    out_.step_p999 = steps_.quantile(0.999);
    if (frames_ >= kSpectrumFrames) finish_spectrum();
  }

  void finish_flicker() {
    const Sums sums = total(out_.block_changes);
    const auto statistic = [&](const Sums& s) { return flicker_of(s, out_.mean); };
    out_.flicker = statistic(sums);
    out_.flicker_interval = bootstrap_interval(out_.block_changes, statistic);
    out_.flicker_raw = std::sqrt(sums[kChange] / sums[kTerms]) / out_.mean;
    out_.flicker_relative = std::sqrt(std::max(0.0, sums[kRelative] / sums[kTerms]));
    for (const double sum : step_sums_)
      out_.step_rms.push_back(std::sqrt(sum / static_cast<double>(out_.pixels)) / out_.mean);
  }

  // The mean of F errors is itself off by 1/F of their spread, which belongs to the fluctuation.
  void finish_split() {
    double bias = 0, fluctuation = -noise_sum_ / frames_;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const double variance = spreads_[i] / (frames_ - 1);
      bias += squares(means_[i]) - variance / frames_;
      fluctuation += variance;
    }
    const auto relative_rms = [&](double sum) {
      return std::sqrt(std::max(0.0, sum / static_cast<double>(out_.pixels))) / out_.mean;
    };
    out_.bias_mean = error_sum_ / static_cast<double>(out_.pixels) / frames_ / out_.mean;
    out_.bias_rms = relative_rms(bias);
    out_.fluctuation = relative_rms(fluctuation);
    out_.rmse = relative_rms(bias + fluctuation);
  }

  void finish_spectrum() {
    const PowerSpectrum spectrum(frames_);
    FlickerResult::Spectrum power;
    std::size_t lit = 0;
    for (const auto& signal : signals_) {
      if (std::all_of(signal.begin(), signal.end(), [](double v) { return v == 0; })) continue;
      ++lit;
      const std::vector<double> bins = spectrum.of(signal);
      for (std::size_t k = 1; k <= bins.size(); ++k) {
        const double frequency_hz = static_cast<double>(k) / frames_ * frame_rate_hz_;
        power.all += bins[k - 1];
        if (4 * k > static_cast<std::size_t>(frames_)) power.fast += bins[k - 1];
        if (frequency_hz >= kVisibleLow && frequency_hz <= kVisibleHigh) power.visible += bins[k - 1];
      }
    }
    for (double* sum : {&power.all, &power.fast, &power.visible})
      *sum = lit == 0 ? 0 : std::sqrt(*sum / static_cast<double>(lit)) / out_.mean;
    out_.spectrum = power;
  }

  int frames_;
  const Frames &read_test_, &read_reference_;
  double frame_rate_hz_;
  int width_ = 0, height_ = 0;
  FlickerResult out_;
  std::optional<Blocks> blocks_;
  std::vector<char> lit_;          // by pixel: not black in some frame
  std::vector<Difference> means_;  // by pixel, of the errors so far
  std::vector<double> spreads_;    // sums of their squared distances from the mean
  int added_ = 0;
  double error_sum_ = 0, noise_sum_ = 0;
  std::vector<double> step_sums_;
  FineHistogram steps_;
  std::vector<std::vector<double>> signals_;  // by block of 8 x 8 pixels
};

}  // namespace

FlickerResult measure_flicker(int frames, const Frames& test, const Frames& reference, double frame_rate_hz) {
  if (frames < 2 || !(frame_rate_hz > 0))
    throw Error(ErrorCode::internal, "measure_flicker: fewer than two frames, or no frame rate");
  return FlickerMeter(frames, test, reference, frame_rate_hz).measure();
}

Interval flicker_difference(const FlickerResult& first, const FlickerResult& second) {
  if (first.block_changes.size() != second.block_changes.size())
    throw Error(ErrorCode::wrong_size, "the two sequences are of different size");
  std::vector<Sums> pairs = first.block_changes;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i].insert(pairs[i].end(), second.block_changes[i].begin(), second.block_changes[i].end());
  return bootstrap_interval(pairs, [&](const Sums& sums) {
    const auto middle = sums.begin() + kBlockSums;
    return flicker_of({sums.begin(), middle}, first.mean) - flicker_of({middle, sums.end()}, second.mean);
  });
}

std::span<const FlickerMetric> flicker_metrics() {
  using Result = FlickerResult;
  static constexpr FlickerMetric kMetrics[] = {
      {{"flicker", "rms change of the error from frame to frame / mean of b, less b's noise", 0,
        Better::lower},
       [](const Result& r) { return r.flicker; }},
      {{"flicker_raw", "flicker with b's noise", 0, Better::lower},
       [](const Result& r) { return r.flicker_raw; }},
      {{"flicker_relative", "flicker with each pixel relative to its own luminance", 0, Better::lower},
       [](const Result& r) { return r.flicker_relative; }},
      {{"bias_rms", "rms of the pixels' mean errors over time / mean of b", 0, Better::lower},
       [](const Result& r) { return r.bias_rms; }},
      {{"fluctuation", "rms of the errors about those / mean of b", 0, Better::lower},
       [](const Result& r) { return r.fluctuation; }},
      {{"step_p99", "99th percentile of the relative change of luminance", 0, Better::lower},
       [](const Result& r) { return r.step_p99; }},
      {{"step_p999", "99.9th percentile of it", 0, Better::lower},
       [](const Result& r) { return r.step_p999; }},
      {{"pops", "how often it exceeds 10%", 0, Better::lower},
       [](const Result& r) { return static_cast<double>(r.pops); }},
  };
  return kMetrics;
}

}  // namespace vsgl::metrics
