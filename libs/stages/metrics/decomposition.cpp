#include "stages/metrics/decomposition.h"

#include <array>
#include <cmath>

#include "base/error.h"
#include "math/vec.h"

namespace vsgl::metrics {
namespace {

using Json = nlohmann::ordered_json;

// Pixels in double, and the noise of each: the variances of its channels with the weights of luminance.
struct Image {
  std::vector<Vec3> colours;
  std::vector<double> noise;
};

Vec3 wide(const Colour& c) {
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}
// Products of the channels with the weights of luminance: for grey images the product of their luminances.
double product(Vec3 a, Vec3 b) {
  return luminance(a * b);
}

void check_size(const Frame& frame, const Frame& reference, const std::string& name) {
  if (frame.width == reference.width && frame.height == reference.height) return;
  throw Error(ErrorCode::wrong_size, name + ": " + std::to_string(frame.width) + "x" +
                                         std::to_string(frame.height) + " pixels, but the reference has " +
                                         std::to_string(reference.width) + "x" +
                                         std::to_string(reference.height));
}

Image image_of(const Frame& frame) {
  Image out;
  for (const Colour& c : frame.colours) out.colours.push_back(wide(c));
  out.noise.assign(out.colours.size(), 0);
  return out;
}

Image reference_image(const Frame& reference) {
  Image out = image_of(reference);
  for (std::size_t i = 0; i < reference.variance.size(); ++i)
    out.noise[i] = luminance(wide(reference.variance[i]));
  return out;
}

// The mean of independent images; its noise is their variance over their number.
Image mean_of(const std::vector<Frame>& images) {
  if (images.size() == 1) return image_of(images.front());
  const auto n = static_cast<double>(images.size());
  Image out;
  for (std::size_t i = 0; i < images.front().colours.size(); ++i) {
    Vec3 mean;
    for (const Frame& image : images) mean += wide(image.colours[i]) / n;
    double squares = 0;
    for (const Frame& image : images) {
      const Vec3 from_mean = wide(image.colours[i]) - mean;
      squares += product(from_mean, from_mean);
    }
    out.colours.push_back(mean);
    out.noise.push_back(squares / (n - 1) / n);
  }
  return out;
}

// Mean over the channels of the metric relmse.
double relmse(const Image& image, const Frame& reference) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> a, b;
    for (std::size_t i = 0; i < image.colours.size(); ++i) {
      a.push_back(static_cast<float>(to_array(image.colours[i])[c]));
      b.push_back(reference.colours[i][c]);
    }
    sum += relative_mse(a, b, relative_mse_epsilon(b)) / 3;
  }
  return sum;
}

// Sums over a block: those of the whole error, then three for each step.
enum WholeSum { kError, kErrorMean, kReferenceNoise, kReferenceMean, kPixels, kWholeSums };
enum StepSum { kMean, kSquares, kProducts, kStepSums };

class Chain {
 public:
  Chain(const Frame& test, const std::vector<CauseRemoved>& chain, const Frame& reference, Weights weights)
      : reference_(reference), weights_(weights), blocks_(Blocks(reference.width, reference.height)) {
    images_.push_back(image_of(test));
    for (const CauseRemoved& removed : chain) images_.push_back(mean_of(removed.images));
    images_.push_back(reference_image(reference));
    set_epsilon();
    sums_.assign(blocks_.count(), Sums(kWholeSums + kStepSums * steps()));
    for (std::size_t i = 0; i < reference.colours.size(); ++i) add(i);
    total_ = total(sums_);
    if (!(total_[kReferenceMean] > 0))
      throw Error(ErrorCode::invalid_data,
                  "the reference is black: there is nothing that an error could be relative to");
  }

  Decomposition measure() const {
    Decomposition out;
    out.pixels = reference_.colours.size();
    out.reference_mean = total_[kReferenceMean] / total_[kPixels];
    out.mean = total_[kErrorMean] / total_[kReferenceMean];
    out.rms = relative_rms(total_[kError]);
    out.relmse = relmse(images_.front(), reference_);
    out.noise_rms = relative_rms(total_[kReferenceNoise]);
    out.noise_share = ratio(total_, kReferenceNoise, kError);
    for (std::size_t k = 0; k < steps(); ++k) out.steps.push_back(step(k));
    out.remainder = std::move(out.steps.back());
    out.steps.pop_back();
    return out;
  }

 private:
  std::size_t steps() const { return images_.size() - 1; }
  static std::size_t index(std::size_t step, StepSum sum) { return kWholeSums + kStepSums * step + sum; }
  static double ratio(const Sums& sums, std::size_t numerator, std::size_t denominator) {
    return sums[denominator] == 0 ? 0 : sums[numerator] / sums[denominator];
  }
  double relative_rms(double squares) const {
    const double unit = weights_ == Weights::relative ? 1 : total_[kReferenceMean] / total_[kPixels];
    return std::sqrt(std::max(0.0, squares / total_[kPixels])) / unit;
  }

  // As in relmse, of the luminance.
  void set_epsilon() {
    double sum = 0;
    for (const Vec3 colour : images_.back().colours) sum += std::abs(luminance(colour));
    const double floor = 0.01 * sum / static_cast<double>(images_.back().colours.size());
    epsilon_ = floor * floor;
  }
  double weight(Vec3 reference) const {
    if (weights_ == Weights::absolute || epsilon_ == 0) return 1;
    return 1 / (product(reference, reference) + epsilon_);
  }

  void add(std::size_t pixel) {
    Sums& sums = sums_[blocks_.of(pixel)];
    const Image &first = images_.front(), &last = images_.back();
    const Vec3 error = first.colours[pixel] - last.colours[pixel];
    const double w = weight(last.colours[pixel]);
    sums[kError] += w * product(error, error);
    sums[kErrorMean] += luminance(error);
    sums[kReferenceNoise] += w * last.noise[pixel];
    sums[kReferenceMean] += luminance(last.colours[pixel]);
    sums[kPixels] += 1;
    for (std::size_t k = 0; k < steps(); ++k) {
      const Image &before = images_[k], &after = images_[k + 1];
      const Vec3 change = before.colours[pixel] - after.colours[pixel];
      sums[index(k, kMean)] += luminance(change);
      sums[index(k, kSquares)] += w * (product(change, change) - before.noise[pixel] - after.noise[pixel]);
      sums[index(k, kProducts)] += w * product(change, error);
      // The reference's noise is in the last step and in the whole error: a row of its own.
      if (k + 1 == steps()) sums[index(k, kProducts)] -= w * last.noise[pixel];
    }
  }

  Step step(std::size_t k) const {
    const auto interval = [&](StepSum sum, WholeSum whole) {
      return bootstrap_interval(sums_, [&](const Sums& sums) { return ratio(sums, index(k, sum), whole); });
    };
    Step out;
    out.mean = ratio(total_, index(k, kMean), kReferenceMean);
    out.mean_interval = interval(kMean, kReferenceMean);
    out.rms = relative_rms(total_[index(k, kSquares)]);
    out.power = ratio(total_, index(k, kSquares), kError);
    out.power_interval = interval(kSquares, kError);
    out.share = ratio(total_, index(k, kProducts), kError);
    out.share_interval = interval(kProducts, kError);
    out.relmse_after = relmse(images_[k + 1], reference_);
    return out;
  }

  const Frame& reference_;
  Weights weights_;
  double epsilon_ = 0;  // added to squares of the reference
  Blocks blocks_;
  std::vector<Image> images_;  // from the one under test to the reference
  std::vector<Sums> sums_;     // of each block
  Sums total_;
};

void check(const Frame& test, const std::vector<CauseRemoved>& chain, const Frame& reference) {
  check_size(test, reference, "the image under test");
  const std::vector<Frame> first{test};
  const std::vector<Frame>* before = &first;
  for (const CauseRemoved& removed : chain) {
    for (std::size_t i = 0; i < removed.images.size(); ++i) {
      check_size(removed.images[i], reference, removed.files[i]);
      if (removed.images.size() > 1 && before->size() == 1 &&
          before->front().colours == removed.images[i].colours)
        throw Error(ErrorCode::invalid_data,
                    removed.files[i] + ": is the image before the step \"" + removed.cause +
                        "\", whose error its mean would hide; average over other seeds");
    }
    before = &removed.images;
  }
}

Json interval_json(const Interval& interval) {
  return {interval.low, interval.high};
}

Json step_json(const Step& step) {
  return {{"cause", step.cause},
          {"files", step.files},
          {"mean", step.mean},
          {"mean_interval", interval_json(step.mean_interval)},
          {"rms", step.rms},
          {"power", step.power},
          {"power_interval", interval_json(step.power_interval)},
          {"share", step.share},
          {"share_interval", interval_json(step.share_interval)},
          {"relmse_after", std::isfinite(step.relmse_after) ? Json(step.relmse_after) : Json()}};
}

}  // namespace

Decomposition decompose(const Frame& test, const std::vector<CauseRemoved>& chain, const Frame& reference,
                        const std::string& remainder, Weights weights) {
  check(test, chain, reference);
  Decomposition out = Chain(test, chain, reference, weights).measure();
  for (std::size_t k = 0; k < chain.size(); ++k) {
    out.steps[k].cause = chain[k].cause;
    out.steps[k].files = chain[k].files;
  }
  out.remainder.cause = remainder;
  return out;
}

bool is_explained(const Decomposition& result, const std::optional<double>& limit) {
  return limit ? result.remainder.power <= *limit : !result.unexplained();
}

Json to_json(const Decomposition& result, const DecompositionNames& names,
             const std::optional<double>& limit) {
  Json out{{"$schema", "vsgltools/decomposition/1"},
           {"test", names.test},
           {"reference", names.reference},
           {"layer", names.layer},
           {"weights", names.weights == Weights::relative ? "relative" : "absolute"},
           {"result", is_explained(result, limit) ? "explained" : "unexplained"},
           {"pixels", result.pixels},
           {"reference_mean", result.reference_mean}};
  out["total"] = {{"mean", result.mean},
                  {"rms", result.rms},
                  {"relmse", std::isfinite(result.relmse) ? Json(result.relmse) : Json()}};
  out["steps"] = Json::array();
  for (const Step& step : result.steps) out["steps"].push_back(step_json(step));
  out["remainder"] = step_json(result.remainder);
  out["remainder"]["files"] = {names.reference};
  out["noise"] = {{"rms", result.noise_rms}, {"share", result.noise_share}};
  out["limit"] = limit ? Json(*limit) : Json();
  return out;
}

}  // namespace vsgl::metrics
