#include "stages/metrics/z_test.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace vsgl::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double square(double x) {
  return x * x;
}

// A difference, its variance and how well that is known.
struct Difference {
  double value = 0, variance = 0;
  double spread = 0;  // sum of variance^2 / degrees of freedom: what Welch and Satterthwaite need

  // [Welch 1947] degrees of freedom of a sum of estimated variances.
  double degrees_of_freedom() const { return spread > 0 ? square(variance) / spread : kInfinity; }
  double score() const { return normal_score(value / std::sqrt(variance), degrees_of_freedom()); }
};

Difference difference_at(const LayerPair& layer, const Uncertainty& test, const Uncertainty& reference,
                         std::size_t pixel, std::size_t channel) {
  Difference d;
  d.value =
      static_cast<double>(layer.test[pixel][channel]) - static_cast<double>(layer.reference[pixel][channel]);
  for (const Uncertainty* u : {&test, &reference}) {
    if (u->variance.empty()) continue;
    const auto variance = static_cast<double>(u->variance[pixel][channel]);
    d.variance += variance;
    if (u->passes) d.spread += square(variance) / (*u->passes - 1);
  }
  return d;
}

// The |score| that one of `tests` independent tests exceeds with probability `significance`.
// [Sidak 1967] each test on its own at 1 - (1 - significance)^(1 / tests).
double sidak_critical(double significance, std::size_t tests) {
  const double each = -std::expm1(std::log1p(-significance) / static_cast<double>(tests));
  return boost::math::quantile(boost::math::complement(boost::math::normal(), 0.5 * each));
}

// [Wilson 1931] The cube root of a chi-square variable over its degrees of freedom n is normal, with mean
// 1 - 2 / (9 n) and variance 2 / (9 n).
double chi_square_score(double chi_square_over_n, double n) {
  const double variance = 2 / (9 * n);
  return (std::cbrt(chi_square_over_n) - (1 - variance)) / std::sqrt(variance);
}

// Differences and scores of one channel.
class ChannelTest {
 public:
  ChannelTest(const LayerPair& layer, const std::vector<char>& left_out, const Uncertainty& test,
              const Uncertainty& reference, std::size_t channel)
      : width_(layer.width), height_(layer.height), left_out_(left_out) {
    for (std::size_t i = 0; i < layer.reference.size(); ++i)
      differences_.push_back(difference_at(layer, test, reference, i, channel));
    score_pixels();
  }

  bool is_tested(std::size_t i) const { return !left_out_[i] && differences_[i].variance > 0; }
  bool is_exact(std::size_t i) const { return !left_out_[i] && differences_[i].variance == 0; }
  double difference(std::size_t i) const { return differences_[i].value; }
  // By a variance that cannot be small by chance alone.
  double cautious_score(std::size_t i) const { return cautious_scores_[i]; }

  ZTest::Channel summary() const {
    ZTest::Channel out;
    double squares = 0;
    Difference sum;
    for (std::size_t i = 0; i < scores_.size(); ++i) {
      if (!is_tested(i)) continue;
      ++out.tested;
      squares += square(scores_[i]);
      sum.value += differences_[i].value;
      sum.variance += differences_[i].variance;
      sum.spread += differences_[i].spread;
    }
    if (out.tested == 0) return out;
    const auto n = static_cast<double>(out.tested);
    out.rms = std::sqrt(squares / n);
    out.rms_score = chi_square_score(squares / n / square(kRmsTolerance), n);
    out.mean_difference = sum.value / n;
    out.mean_standard_error = std::sqrt(sum.variance) / n;
    out.mean_score = sum.score();
    return out;
  }

 private:
  void score_pixels() {
    scores_.resize(differences_.size());
    cautious_scores_.resize(differences_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < scores_.size(); ++i) {
      if (!is_tested(i)) continue;
      Difference d = differences_[i];
      scores_[i] = cautious_scores_[i] = d.score();
      if (d.spread == 0) continue;
      d.value *= std::sqrt(d.variance / std::max(d.variance, variance_around(i)));
      cautious_scores_[i] = d.score();
    }
  }

  // Mean over the tested pixels among the nine.
  double variance_around(std::size_t i) const {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    double sum = 0;
    int count = 0;
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
        const std::size_t k =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
        if (!is_tested(k)) continue;
        sum += differences_[k].variance;
        ++count;
      }
    return sum / count;
  }

  int width_, height_;
  const std::vector<char>& left_out_;
  std::vector<Difference> differences_;
  std::vector<double> scores_, cautious_scores_;  // 0 where there is nothing to test
};

void judge_values(const ChannelTest& test, std::size_t channel, std::size_t pixels, ZTest& out) {
  for (std::size_t i = 0; i < pixels; ++i) {
    if (test.is_exact(i)) {
      if (test.difference(i) == 0) {
        ++out.exact;
      } else if (out.exact_differing++ == 0) {
        out.first_exact_pixel = i;
      }
    } else if (test.is_tested(i)) {
      const double score = test.cautious_score(i);
      if (std::abs(score) > out.critical) ++out.exceeding;
      if (std::abs(score) <= std::abs(out.worst_score)) continue;
      out.worst_score = score;
      out.worst_pixel = i;
      out.worst_channel = channel;
    }
  }
}

}  // namespace

std::optional<double> value_score(const LayerPair& layer, const Uncertainty& test,
                                  const Uncertainty& reference, std::size_t pixel, std::size_t channel) {
  const Difference d = difference_at(layer, test, reference, pixel, channel);
  return d.variance > 0 ? std::optional(d.score()) : std::nullopt;
}

double normal_score(double t, double degrees_of_freedom) {
  using boost::math::complement;
  // Beyond it the chance of a value so large is not a number of double precision any more.
  constexpr double kSmallest = 1e-300;
  if (!std::isfinite(degrees_of_freedom) || !std::isfinite(t)) return t;
  const boost::math::students_t student(degrees_of_freedom);
  const double chance = std::max(kSmallest, boost::math::cdf(complement(student, std::abs(t))));
  return std::copysign(boost::math::quantile(complement(boost::math::normal(), chance)), t);
}

Uncertainty uncertainty_of(const ExrPart& part, const std::string& path) {
  Uncertainty out;
  if (has_channel(part, "variance.R")) out.variance = colours_of(part, "variance").value_or(out.variance);
  for (const Colour& v : out.variance)
    if (!std::all_of(v.begin(), v.end(), [](float x) { return std::isfinite(x) && x >= 0; }))
      throw Error(ErrorCode::invalid_data,
                  path +
                      ": variance: a value is negative or not finite; write the file "
                      "again with the tool that made it");
  const auto passes = part.attributes.find("reference.passes");
  if (passes == part.attributes.end()) return out;
  const int* count = std::get_if<int>(&passes->second);
  if (!count || *count < 2)
    throw Error(ErrorCode::invalid_data, path +
                                             ": reference.passes: must be a whole number of at least 2, for "
                                             "a variance to be known; trace more passes");
  out.passes = *count;
  return out;
}

ZTest z_test(const LayerPair& layer, const std::vector<char>& left_out, const Uncertainty& test,
             const Uncertainty& reference, double significance) {
  const std::size_t pixels = layer.reference.size();
  std::vector<ChannelTest> tests;
  for (std::size_t c = 0; c < 3; ++c) tests.emplace_back(layer, left_out, test, reference, c);
  ZTest out;
  out.significance = significance;
  for (std::size_t c = 0; c < 3; ++c) {
    out.channels[c] = tests[c].summary();
    if (out.channels[c].tested > 0) out.tests += out.channels[c].tested + 2;
  }
  if (out.tests > 0) out.critical = sidak_critical(significance, out.tests);
  for (std::size_t c = 0; c < 3; ++c) judge_values(tests[c], c, pixels, out);
  return out;
}

}  // namespace vsgl::metrics
