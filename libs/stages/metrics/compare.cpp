#include "stages/metrics/compare.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "stages/metrics/judging.h"
#include "stages/metrics/pairing.h"

namespace vsgl::metrics {
namespace {

// Compares one pair of files and collects what is found.
class Comparer {
 public:
  Comparer(const ExrFile& test, const ExrFile& reference, const Options& options)
      : test_(test), reference_(reference), options_(options) {}

  Comparison run() {
    for (const PartPair& pair : pair_parts(test_, reference_)) compare_parts(pair);
    check_coverage(options_, out_);
    return std::move(out_);
  }

 private:
  void compare_parts(const PartPair& pair) {
    part_ = (pair.reference ? pair.reference : pair.test)->name;
    level_ = 0;
    if (!pair.test || !pair.reference)
      return fail("missing_part", "",
                  std::string(part_.empty() ? "the unnamed part" : "the part") + " is missing in " +
                      (pair.test ? reference_ : test_).path);
    const std::size_t a = pair.test->levels.size(), b = pair.reference->levels.size();
    for (std::size_t l = 0; l < std::max(a, b); ++l) {
      level_ = static_cast<int>(l);
      if (l >= a || l >= b) {
        fail("missing_level", "", "the mip level is missing in " + (l >= a ? test_ : reference_).path);
      } else {
        compare_levels(pair.test->levels[l], pair.reference->levels[l]);
      }
    }
    compare_layers(pair, test_.path, reference_.path, options_, out_);
  }

  void compare_levels(const ExrLevel& a, const ExrLevel& b) {
    if (a.width != b.width || a.height != b.height)
      return fail("size", "",
                  std::to_string(a.width) + "x" + std::to_string(a.height) + " pixels instead of " +
                      std::to_string(b.width) + "x" + std::to_string(b.height));
    std::set<std::string> names;
    for (const ExrLevel* level : {&a, &b})
      for (const auto& [name, plane] : level->channels)
        if (is_selected(options_, name)) names.insert(name);
    width_ = a.width;
    for (const std::string& name : names) compare_channel(a, b, name);
  }

  void compare_channel(const ExrLevel& a, const ExrLevel& b, const std::string& name) {
    const auto in_a = a.channels.find(name), in_b = b.channels.find(name);
    if (in_a == a.channels.end() || in_b == b.channels.end())
      return fail("missing_channel", name,
                  "the channel is missing in " + (in_a == a.channels.end() ? test_ : reference_).path);
    if (in_a->second.index() != in_b->second.index())
      return fail("channel_type", name, "the channel is FLOAT in one file and UINT in the other");
    if (const auto* floats = std::get_if<std::vector<float>>(&in_a->second)) {
      compare_floats(*floats, std::get<std::vector<float>>(in_b->second), name);
    } else {
      compare_uints(std::get<1>(in_a->second), std::get<1>(in_b->second), name);
    }
  }

  void compare_uints(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                     const std::string& name) {
    ChannelResult result = start(name);
    result.is_uint = true;
    result.pixels = a.size();
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i] && result.differing++ == 0) locate(result, i);
    result.exceeding = result.differing;
    check_threshold(result, 0);
    out_.channels.push_back(std::move(result));
  }

  void compare_floats(const std::vector<float>& a, const std::vector<float>& b, const std::string& name) {
    ChannelResult result = start(name);
    result.non_finite_test = non_finite_count(a);
    result.non_finite_reference = non_finite_count(b);
    if (result.non_finite_test + result.non_finite_reference == 0) {
      measure(a, b, nullptr, result);
    } else {
      measure_finite(a, b, result);
    }
    if (!options_.allow_non_finite && result.non_finite_test + result.non_finite_reference > 0)
      fail("non_finite", name,
           std::to_string(result.non_finite_test) + " values are NaN or infinite in " + test_.path + ", " +
               std::to_string(result.non_finite_reference) + " in " + reference_.path);
    out_.channels.push_back(std::move(result));
  }

  // The same with the pixels left out that are not finite on both sides.
  void measure_finite(const std::vector<float>& a, const std::vector<float>& b, ChannelResult& result) {
    std::vector<float> finite_a, finite_b;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
      finite_a.push_back(a[i]);
      finite_b.push_back(b[i]);
      places.push_back(i);
    }
    if (!places.empty()) measure(finite_a, finite_b, &places, result);
  }

  // `places`: where the pixels are in the image; nullptr: they are all of it.
  void measure(Pixels a, Pixels b, const std::vector<std::size_t>* places, ChannelResult& result) {
    result.pixels = a.size();
    const Maximum maximum = maximum_error(a, b);
    locate(result, places ? (*places)[maximum.index] : maximum.index);
    const double value = options_.threshold ? options_.threshold->value : 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double error = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      if (error > 0) ++result.differing;
      if (error > value) ++result.exceeding;
    }
    check_threshold(result, maximum.error);
    for (const ChannelMetric& metric : channel_metrics()) {
      const double v = metric.evaluate(a, b, options_.relmse_epsilon);
      check_limits(metric, v, part_, level_, result.channel, options_, out_);
      if (is_reported(options_, metric)) result.metrics.emplace_back(&metric, v);
    }
  }

  void check_threshold(const ChannelResult& result, double maximum) {
    if (!options_.threshold) return;
    const Threshold& threshold = *options_.threshold;
    const std::string place =
        " (at " + std::to_string(result.max_x) + "," + std::to_string(result.max_y) + ")";
    const double percent = 100.0 * static_cast<double>(result.exceeding) / static_cast<double>(result.pixels);
    if (percent > threshold.percent)
      fail(
          "threshold", result.channel,
          printed(percent) + "% of the pixels " +
              (result.is_uint ? "differ, the first"
                              : "exceed " + printed(threshold.value) + ", the worst by " + printed(maximum)) +
              place + "; " + printed(threshold.percent) + "% are allowed");
    if (!result.is_uint && threshold.hard_limit && maximum > *threshold.hard_limit)
      fail("hard_limit", result.channel,
           "the largest error " + printed(maximum) + place + " exceeds the hard limit " +
               printed(*threshold.hard_limit));
  }

  ChannelResult start(const std::string& channel) const {
    ChannelResult result;
    result.part = part_;
    result.level = level_;
    result.channel = channel;
    return result;
  }
  void locate(ChannelResult& result, std::size_t index) const {
    result.max_x = static_cast<int>(index % static_cast<std::size_t>(width_));
    result.max_y = static_cast<int>(index / static_cast<std::size_t>(width_));
  }

  void fail(const std::string& kind, const std::string& channel, const std::string& what) {
    out_.failures.push_back(make_failure(kind, part_, level_, channel, what));
  }

  const ExrFile &test_, &reference_;
  const Options& options_;
  Comparison out_;
  std::string part_;  // being compared, for results and messages
  int level_ = 0, width_ = 1;
};

}  // namespace

bool Comparison::identical() const {
  const auto differs = [](const ChannelResult& r) {
    return r.differing > 0 || r.non_finite_test + r.non_finite_reference > 0;
  };
  return failures.empty() && std::none_of(channels.begin(), channels.end(), differs);
}

Comparison compare(const ExrFile& test, const ExrFile& reference, const Options& options) {
  check_selection(options, test, reference);
  return Comparer(test, reference, options).run();
}

}  // namespace vsgl::metrics
