#include "stages/metrics/seams.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stages/metrics/statistics.h"

namespace vsgl::metrics {
namespace {

// Brightnesses that differ more are an edge of the picture, which hides a seam and has errors of its own.
constexpr double kLikeBrightness = 0.1;
constexpr double kFloor = 0.02;  // as of relmse_rgb
constexpr int kNeighbours[] = {-2, -1, 1, 2};

Seams::Steps steps_of(std::vector<double> steps) {
  std::sort(steps.begin(), steps.end());
  return {quantile(steps, 0.5), quantile(steps, 0.99), steps.back()};
}

// A line between pixels: vertical before column `at`, or horizontal before row `at`; along it from `first` up
// to `last`.
struct Line {
  bool vertical = false;
  int at = 0, first = 0, last = 0;
};

class SeamMeter {
 public:
  SeamMeter(const LayerPair& layer, const std::vector<char>& left_out, int tile)
      : layer_(layer), left_out_(left_out), tile_(tile) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      if (left_out[i]) continue;
      sum += std::abs(luminance_of(layer.reference[i]));
      ++count;
    }
    floor_ = count > 0 ? kFloor * sum / static_cast<double>(count) : 0;
  }

  std::optional<Seams> run() {
    out_.tile = tile_;
    for (const bool vertical : {true, false}) {
      const int size = vertical ? layer_.width : layer_.height,
                length = vertical ? layer_.height : layer_.width;
      for (int at = tile_; at < size; at += tile_)
        for (int first = 0; first < length; first += tile_)
          measure({vertical, at, first, std::min(first + tile_, length)}, size);
    }
    if (borders_.empty()) return std::nullopt;
    out_.borders = borders_.size();
    out_.border = steps_of(borders_);
    out_.interior = steps_of(interiors_);
    out_.excess = steps_of(excesses_);
    return out_;
  }

 private:
  void measure(const Line& border, int size) {
    const std::optional<double> step = step_at(border);
    std::vector<double> inside;
    for (const int offset : kNeighbours) {
      Line line = border;
      line.at += offset;
      if (line.at >= size) continue;
      if (const std::optional<double> beside = step_at(line)) inside.push_back(*beside);
    }
    if (!step || inside.empty()) {
      ++out_.left_out;
      return;
    }
    const double excess =
        *step - std::accumulate(inside.begin(), inside.end(), 0.0) / static_cast<double>(inside.size());
    if (excesses_.empty() || excess > worst_) {
      worst_ = excess;
      out_.worst_is_vertical = border.vertical;
      out_.worst_x = border.vertical ? border.at : border.first;
      out_.worst_y = border.vertical ? border.first : border.at;
    }
    borders_.push_back(*step);
    interiors_.insert(interiors_.end(), inside.begin(), inside.end());
    excesses_.push_back(excess);
  }

  // |mean difference of the relative error across the line|; nothing with less than a quarter of a tile's
  // pairs.
  std::optional<double> step_at(const Line& line) const {
    double sum = 0;
    int pairs = 0;
    for (int k = line.first; k < line.last; ++k) {
      const std::size_t behind = line.vertical ? index(line.at, k) : index(k, line.at),
                        before = line.vertical ? behind - 1 : behind - index(0, 1);
      if (!is_pair(before, behind)) continue;
      sum += relative_error(behind) - relative_error(before);
      ++pairs;
    }
    if (4 * pairs < tile_) return std::nullopt;
    return std::abs(sum / pairs);
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(layer_.width) + static_cast<std::size_t>(x);
  }
  double brightness(std::size_t i) const { return std::abs(luminance_of(layer_.reference[i])) + floor_; }
  double relative_error(std::size_t i) const {
    return (luminance_of(layer_.test[i]) - luminance_of(layer_.reference[i])) / brightness(i);
  }
  bool is_pair(std::size_t a, std::size_t b) const {
    if (left_out_[a] || left_out_[b]) return false;
    const double bright = std::max(brightness(a), brightness(b)),
                 dark = std::min(brightness(a), brightness(b));
    return dark > 0 && bright - dark <= kLikeBrightness * bright;
  }

  const LayerPair& layer_;
  const std::vector<char>& left_out_;
  int tile_;
  double floor_ = 0;
  Seams out_;
  double worst_ = 0;
  std::vector<double> borders_, interiors_, excesses_;
};

}  // namespace

std::optional<Seams> measure_seams(const LayerPair& layer, const std::vector<char>& left_out, int tile) {
  return SeamMeter(layer, left_out, tile).run();
}

}  // namespace vsgl::metrics
