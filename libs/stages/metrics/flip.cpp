#include "stages/metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/metrics/colour.h"
#include "stages/metrics/statistics.h"

namespace vsgl::metrics {
namespace {

constexpr double kPi = std::numbers::pi;

// [Andersson 2020, Sec. 4.1] One channel's contrast sensitivity: a sum of Gaussians
// a sqrt(pi / b) exp(-pi^2 d^2 / b) of the distance d in degrees.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic = {1, 0.0047}, kRedGreen = {1, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

// A 2D Gaussian that is not scaled to the sum 1, as a product of two kernels of sum 1 and their weight.
struct Blur {
  Kernel kernel;
  double weight;
};
Blur blur_of(const Sensitivity& s, double ppd) {
  // The largest b decides the radius of all: three standard deviations.
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * ppd));
  const double sigma = std::sqrt(s.b / (2 * kPi * kPi)) * ppd;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
  return {gaussian_kernel(sigma, radius), s.a * std::sqrt(kPi / s.b) * sum * sum};
}

// Scales the positive taps to the sum 1 and the negative ones to -1.
void balance(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const double tap : kernel) (tap > 0 ? positive : negative) += std::abs(tap);
  for (double& tap : kernel) tap /= tap > 0 ? positive : negative;
}

// [Andersson 2020, Sec. 4.2] Detectors of edges and points: derivatives of a Gaussian as wide as 0.082
// degrees from peak to trough.
struct FeatureKernels {
  Kernel smooth, edge, point;
};
FeatureKernels feature_kernels(double ppd) {
  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels out{gaussian_kernel(sigma, radius), {}, {}};
  for (int x = -radius; x <= radius; ++x) {
    const double g = std::exp(-0.5 * x * x / (sigma * sigma));
    out.edge.push_back(-x * g);
    out.point.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  balance(out.edge);
  balance(out.point);
  return out;
}

// What an observer perceives of one image.
struct Percept {
  RgbGrid colour;      // Hunt-adjusted L*, a*, b*
  Grid edges, points;  // strength of the features
};

// [Andersson 2020, Sec. 4.1] Hunt effect: colours look less colourful in the dark.
Vec3 hunt_lab(Vec3 linear_rgb) {
  const Vec3 lab = to_lab(linear_rgb);
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// |L1 - L2| + distance of (a, b).
double hyab(Vec3 p, Vec3 q) {
  return std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z);
}

Vec3 pixel(const RgbGrid& image, std::size_t i) {
  return {image[0].values[i], image[1].values[i], image[2].values[i]};
}
void set_pixel(RgbGrid& image, std::size_t i, Vec3 v) {
  image[0].values[i] = v.x;
  image[1].values[i] = v.y;
  image[2].values[i] = v.z;
}

// Applies `convert` to each pixel.
template <typename Convert>
RgbGrid converted(const RgbGrid& image, Convert convert) {
  RgbGrid out;
  out.fill(Grid(image[0].width, image[0].height));
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < image[0].values.size(); ++i) set_pixel(out, i, convert(pixel(image, i)));
  return out;
}

// The image as seen from afar: each opponent channel blurred by its contrast sensitivity.
RgbGrid blurred(const RgbGrid& ycxcz, double ppd) {
  const Blur achromatic = blur_of(kAchromatic, ppd), red_green = blur_of(kRedGreen, ppd);
  const Blur wide = blur_of(kBlueYellow[0], ppd), narrow = blur_of(kBlueYellow[1], ppd);
  RgbGrid out = {filter(ycxcz[0], achromatic.kernel, achromatic.kernel),
                 filter(ycxcz[1], red_green.kernel, red_green.kernel),
                 filter(ycxcz[2], wide.kernel, wide.kernel)};
  const Grid second = filter(ycxcz[2], narrow.kernel, narrow.kernel);
  const double share = wide.weight / (wide.weight + narrow.weight);
  for (std::size_t i = 0; i < second.values.size(); ++i)
    out[2].values[i] = share * out[2].values[i] + (1 - share) * second.values[i];
  return out;
}

// Length of the gradient-like vector (horizontal, vertical).
Grid feature_strength(const Grid& lightness, const Kernel& across, const Kernel& along) {
  Grid x = filter(lightness, across, along);
  const Grid y = filter(lightness, along, across);
  for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
  return x;
}

Percept perceive(const RgbGrid& linear_rgb, double ppd) {
  const RgbGrid ycxcz = converted(linear_rgb, to_ycxcz);
  Percept out;
  out.colour = converted(blurred(ycxcz, ppd), [](Vec3 opponent) {
    const Vec3 rgb = from_ycxcz(opponent);
    return hunt_lab({std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
  });
  Grid lightness = ycxcz[0];
  for (double& v : lightness.values) v = (v + 16) / 116;
  const FeatureKernels kernels = feature_kernels(ppd);
  out.edges = feature_strength(lightness, kernels.edge, kernels.smooth);
  out.points = feature_strength(lightness, kernels.point, kernels.smooth);
  return out;
}

// [Andersson 2020, Sec. 4.1] Compresses HyAB distances to 0..1: those below 40% of the largest, that of
// green and blue, take the range 0..0.95.
double redistribute(double distance) {
  constexpr double kExponent = 0.7, kKnee = 0.4, kKneeError = 0.95;
  static const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kExponent);
  const double knee = kKnee * largest, error = std::pow(distance, kExponent);
  if (error < knee) return kKneeError * error / knee;
  return std::min(1.0, kKneeError + (1 - kKneeError) * (error - knee) / (largest - knee));
}

RgbGrid shown(const std::vector<Colour>& image, int width, int height, FlipMode mode, double stops) {
  const double scale = std::exp2(stops);
  RgbGrid out;
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = Grid(width, height);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double v = std::max(0.0, static_cast<double>(image[i][c]));
      out[c].values[i] = mode == FlipMode::ldr ? std::min(1.0, v) : tone_map(scale * v);
    }
  }
  return out;
}

std::size_t count_out_of_range(const LayerPair& layer, FlipMode mode) {
  const auto outside = [&](float v) { return v < 0 || (mode == FlipMode::ldr && v > 1); };
  std::size_t count = 0;
  for (const auto* image : {&layer.test, &layer.reference})
    for (const Colour& c : *image)
      if (std::any_of(c.begin(), c.end(), outside)) ++count;
  return count;
}

// [Narkowicz 2016] (x (a x + b)) / (x (c x + d) + e) with the exposure 0.6 divided out.
constexpr double kA = 0.36 * 2.51, kB = 0.6 * 0.03, kC = 0.36 * 2.43, kD = 0.6 * 0.59, kE = 0.14;

// The x with tone_map(x) = t, 0 < t < 1.
double inverse_tone_map(double t) {
  const double p = (kB - kD * t) / (2 * (kA - kC * t)), q = -kE * t / (kA - kC * t);
  return -p + std::sqrt(p * p - q);
}

}  // namespace

double tone_map(double x) {
  // Powers of 1 / x where x is large: no overflow.
  const double y =
      x <= 1 ? (kA * x + kB) * x / ((kC * x + kD) * x + kE) : (kA + kB / x) / (kC + (kD + kE / x) / x);
  return std::min(1.0, y);
}

ExposureRange hdr_exposures(const std::vector<Colour>& reference) {
  constexpr double kTarget = 0.85;
  std::vector<double> positive;
  for (const Colour& c : reference) {
    const double y = luminance_of({std::max(0.0f, c[0]), std::max(0.0f, c[1]), std::max(0.0f, c[2])});
    if (y > 0) positive.push_back(y);
  }
  if (positive.empty()) return {};
  std::sort(positive.begin(), positive.end());
  const double x = inverse_tone_map(kTarget);
  ExposureRange out{std::log2(x / positive.back()), std::log2(x / quantile(positive, 0.5)), 1};
  if (out.stop > out.start) out.count = std::max(2, static_cast<int>(std::ceil(out.stop - out.start)));
  return out;
}

Grid ldr_flip(const RgbGrid& test, const RgbGrid& reference, double ppd) {
  const Percept a = perceive(test, ppd), b = perceive(reference, ppd);
  Grid out(test[0].width, test[0].height);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const double colour = redistribute(hyab(pixel(a.colour, i), pixel(b.colour, i)));
    const double edges = std::abs(a.edges.values[i] - b.edges.values[i]);
    const double points = std::abs(a.points.values[i] - b.points.values[i]);
    const double feature = std::min(1.0, std::sqrt(std::max(edges, points) / std::numbers::sqrt2));
    out.values[i] = std::pow(colour, 1 - feature);
  }
  return out;
}

FlipResult flip(const LayerPair& layer, FlipMode mode, double ppd) {
  FlipResult out;
  out.map = Grid(layer.width, layer.height);
  out.out_of_range = count_out_of_range(layer, mode);
  if (mode == FlipMode::hdr) out.exposures = hdr_exposures(layer.reference);
  if (layer.test == layer.reference) return out;
  for (int i = 0; i < out.exposures.count; ++i) {
    const double stops = out.exposures.stops(i);
    const Grid error = ldr_flip(shown(layer.test, layer.width, layer.height, mode, stops),
                                shown(layer.reference, layer.width, layer.height, mode, stops), ppd);
    for (std::size_t k = 0; k < error.values.size(); ++k)
      out.map.values[k] = std::max(out.map.values[k], error.values[k]);
  }
  return out;
}

}  // namespace vsgl::metrics
