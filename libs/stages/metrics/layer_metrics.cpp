#include "stages/metrics/layer_metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/vec.h"
#include "stages/metrics/ssim.h"

namespace vsgl::metrics {
namespace {

double square(double x) {
  return x * x;
}
// 0 / 0 is 0: where nothing differs there is no error.
double ratio(double numerator, double denominator) {
  return numerator == 0 ? 0 : numerator / denominator;
}
double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

// Sum over the channels of f(channel's value).
template <typename F>
double channel_sum(const Colour& colour, F f) {
  return f(static_cast<double>(colour[0])) + f(static_cast<double>(colour[1])) +
         f(static_cast<double>(colour[2]));
}
double squared_difference(const Colour& a, const Colour& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += square(static_cast<double>(a[c]) - static_cast<double>(b[c]));
  return sum;
}

// Measures the pixels of a layer that count.
class LayerMeter {
 public:
  LayerMeter(LayerPair& layer, const Uncertainty& test, const Uncertainty& reference)
      : left_out_(blacken_non_finite(layer)), layer_(layer), test_(test), reference_(reference) {
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (!left_out_[i]) pixels_.push_back(i);
  }

  std::size_t pixels() const { return pixels_.size(); }

  LayerResult::Flip measure_flip(FlipMode mode, double pixels_per_degree) const {
    const FlipResult result = flip(layer_, mode, pixels_per_degree);
    const std::vector<double> values = counted(result.map), rising = sorted(values);
    return {
        mode,
        pixels_per_degree,
        result.exposures,
        result.out_of_range,
        mean(values),
        rising.back(),
        {weighted_quantile(rising, 0.25), weighted_quantile(rising, 0.5), weighted_quantile(rising, 0.75)}};
  }

  LayerResult::Ssim measure_ssim() const {
    const double exposure = automatic_exposure(layer_);
    const std::vector<double> values = counted(ssim(layer_, exposure));
    return {exposure, mean(values), *std::min_element(values.begin(), values.end())};
  }

  void measure_relative(LayerResult& out) const {
    const double epsilon = relative_epsilon();
    struct Pixel {
      double error, denoised;
    };
    std::vector<Pixel> found;
    for (const std::size_t i : pixels_) {
      const Colour& b = layer_.reference[i];
      const double squares = squared_difference(layer_.test[i], b);
      const double scale = channel_sum(b, square) + epsilon;
      const double noise =
          reference_.variance.empty() ? 0 : channel_sum(reference_.variance[i], [](double v) { return v; });
      found.push_back({ratio(squares, scale), ratio(squares - noise, scale)});
    }
    std::ranges::stable_sort(found, {}, &Pixel::error);
    const auto mean_of = [&](std::size_t count, double Pixel::*value) {
      double sum = 0;
      for (std::size_t i = 0; i < count; ++i) sum += found[i].*value;
      return sum / static_cast<double>(count);
    };
    const std::size_t all = found.size(), kept = all - all / 1000;
    out.relmse = mean_of(all, &Pixel::error);
    out.relmse_trimmed = mean_of(kept, &Pixel::error);
    if (reference_.variance.empty()) return;
    out.relmse_denoised = mean_of(all, &Pixel::denoised);
    out.relmse_trimmed_denoised = mean_of(kept, &Pixel::denoised);
  }

  void measure_bias(LayerResult& out) const {
    const double a = mean(luminances(layer_.test)), b = mean(luminances(layer_.reference));
    out.luminance_bias = a == b ? 1 : a / b;
    if (b == 0 || (test_.variance.empty() && reference_.variance.empty())) return;
    const double variance = mean_variance(test_) + square(out.luminance_bias) * mean_variance(reference_);
    out.luminance_bias_error = std::sqrt(variance) / std::abs(b);
  }

  void measure_distributions(LayerResult& out) const {
    const std::vector<double> a = luminances(layer_.test), b = luminances(layer_.reference);
    double sum = 0;
    for (const double v : b) sum += std::abs(v);
    const double floor = 0.01 * sum / static_cast<double>(b.size());
    std::vector<double> absolute, relative;
    for (std::size_t i = 0; i < b.size(); ++i) {
      absolute.push_back(std::abs(a[i] - b[i]));
      relative.push_back(ratio(absolute.back(), std::abs(b[i]) + floor));
    }
    out.absolute = errors_of(absolute);
    out.relative = errors_of(relative);
    out.values_test = log_histogram(a);
    out.values_reference = log_histogram(b);
  }

  std::optional<Seams> measure_seams(int tile) const {
    return metrics::measure_seams(layer_, left_out_, tile);
  }

  std::optional<ZTest> measure_z(double significance) const {
    if (test_.variance.empty() && reference_.variance.empty()) return std::nullopt;
    return z_test(layer_, left_out_, test_, reference_, significance);
  }

 private:
  std::vector<double> counted(const Grid& grid) const {
    std::vector<double> out;
    for (const std::size_t i : pixels_) out.push_back(grid.values[i]);
    return out;
  }
  std::vector<double> luminances(const std::vector<Colour>& image) const {
    std::vector<double> out;
    for (const std::size_t i : pixels_) out.push_back(luminance_of(image[i]));
    return out;
  }

  // Of the sum over three channels: each (2% of the mean |value|)^2.
  double relative_epsilon() const {
    double sum = 0;
    for (const std::size_t i : pixels_)
      sum += channel_sum(layer_.reference[i], [](double v) { return std::abs(v); });
    return 3 * square(0.02 * sum / static_cast<double>(3 * pixels_.size()));
  }

  // Of the image's mean luminance. The channels of a pixel come from the same paths: their errors are taken
  // to rise and fall together, the largest variance that their luminance can have.
  double mean_variance(const Uncertainty& uncertainty) const {
    if (uncertainty.variance.empty()) return 0;
    double sum = 0;
    for (const std::size_t i : pixels_) {
      const Colour& v = uncertainty.variance[i];
      sum += square(luminance_of({std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2])}));
    }
    return sum / square(static_cast<double>(pixels_.size()));
  }

  static LayerResult::Errors errors_of(const std::vector<double>& errors) {
    LayerResult::Errors out;
    const std::vector<double> rising = sorted(errors);
    for (std::size_t k = 0; k < kPercentiles.size(); ++k)
      out.percentiles[k] = quantile(rising, kPercentiles[k] / 100);
    out.histogram = log_histogram(errors);
    return out;
  }

  std::vector<char> left_out_;
  const LayerPair& layer_;
  const Uncertainty &test_, &reference_;
  std::vector<std::size_t> pixels_;  // that count, rising
};

// The largest of the channels.
double largest_rms(const ZTest& z) {
  double out = 0;
  for (const ZTest::Channel& channel : z.channels) out = std::max(out, channel.rms);
  return out;
}

}  // namespace

std::span<const LayerMetric> layer_metrics() {
  using Value = std::optional<double>;
  static constexpr LayerMetric kMetrics[] = {
      {{"flip", "mean FLIP, 0..1", 0, Better::lower},
       [](const LayerResult& r) { return r.flip ? Value(r.flip->mean) : Value(); }},
      {{"flip_median", "FLIP of the pixel below which half of all FLIP lies", 0, Better::lower},
       [](const LayerResult& r) { return r.flip ? Value(r.flip->weighted_quartiles[1]) : Value(); }},
      {{"flip_max", "largest FLIP", 0, Better::lower},
       [](const LayerResult& r) { return r.flip ? Value(r.flip->max) : Value(); }},
      {{"ssim", "mean SSIM of the perceived luminance", 1, Better::higher},
       [](const LayerResult& r) { return r.ssim ? Value(r.ssim->mean) : Value(); }},
      {{"relmse_rgb", "mean |a-b|^2 / (|b|^2 + 3e) of the colours, e = (mean|b| / 50)^2", 0, Better::lower},
       [](const LayerResult& r) { return Value(r.relmse); }},
      {{"relmse_trimmed", "relmse_rgb without the worst 0.1% of the pixels", 0, Better::lower},
       [](const LayerResult& r) { return Value(r.relmse_trimmed); }},
      {{"relmse_denoised", "relmse_rgb less the reference's own noise", 0, Better::lower},
       [](const LayerResult& r) { return r.relmse_denoised; }},
      {{"relmse_trimmed_denoised", "relmse_trimmed less the reference's own noise", 0, Better::lower},
       [](const LayerResult& r) { return r.relmse_trimmed_denoised; }},
      {{"luminance_bias", "mean luminance of a / that of b", 1, Better::nearer},
       [](const LayerResult& r) { return Value(r.luminance_bias); }},
      {{"z_rms", "root mean square of the z-scores, largest of the channels", 0, Better::lower},
       [](const LayerResult& r) { return r.z ? Value(largest_rms(*r.z)) : Value(); }},
      {{"seam_p99", "step of the error at tile borders beyond the interior's, 99th percentile", 0,
        Better::lower},
       [](const LayerResult& r) { return r.seams ? Value(r.seams->excess.p99) : Value(); }},
      {{"seam_max", "the largest such step", 0, Better::lower},
       [](const LayerResult& r) { return r.seams ? Value(r.seams->excess.max) : Value(); }},
  };
  return kMetrics;
}

std::vector<const Metric*> all_metrics() {
  std::vector<const Metric*> out;
  for (const ChannelMetric& metric : channel_metrics()) out.push_back(&metric);
  for (const LayerMetric& metric : layer_metrics()) out.push_back(&metric);
  return out;
}

const Metric* find_metric(std::string_view name) {
  for (const Metric* metric : all_metrics())
    if (metric->name == name) return metric;
  return nullptr;
}

std::optional<LayerResult> measure_layer(LayerPair layer, const Uncertainty& test,
                                         const Uncertainty& reference, const LayerOptions& options) {
  const bool has_variance = layer.name == "indirect";
  const Uncertainty exact;
  const LayerMeter meter(layer, has_variance ? test : exact, has_variance ? reference : exact);
  if (meter.pixels() == 0) return std::nullopt;
  LayerResult out;
  out.layer = layer.name;
  out.width = layer.width;
  out.height = layer.height;
  out.pixels = meter.pixels();
  out.non_finite = layer.reference.size() - meter.pixels();
  if (options.with_flip) out.flip = meter.measure_flip(options.flip_mode, options.flip_pixels_per_degree);
  if (options.with_ssim) out.ssim = meter.measure_ssim();
  meter.measure_relative(out);
  meter.measure_bias(out);
  meter.measure_distributions(out);
  if (options.seam_tile > 0) out.seams = meter.measure_seams(options.seam_tile);
  if (options.with_z) out.z = meter.measure_z(options.significance);
  return out;
}

}  // namespace vsgl::metrics
