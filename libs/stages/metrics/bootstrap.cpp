#include "stages/metrics/bootstrap.h"

#include <algorithm>
#include <cstdint>
#include <random>

#include "stages/metrics/statistics.h"

namespace vsgl::metrics {

Blocks::Blocks(int width, int height)
    : width_(width), columns_((width + kSide - 1) / kSide), rows_((height + kSide - 1) / kSide) {}

std::size_t Blocks::of(std::size_t pixel) const {
  const std::size_t x = pixel % width_, y = pixel / width_;
  return y / kSide * columns_ + x / kSide;
}

Sums total(const std::vector<Sums>& blocks) {
  Sums out(blocks.front().size());
  for (const Sums& block : blocks)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += block[i];
  return out;
}

Interval bootstrap_interval(const std::vector<Sums>& blocks,
                            const std::function<double(const Sums&)>& statistic) {
  constexpr int kResamples = 1000;
  constexpr std::uint64_t kSeed = 20160101;
  // The engine's numbers are the same everywhere; those of std::uniform_int_distribution are not.
  std::mt19937_64 engine(kSeed);
  std::vector<double> values;
  for (int i = 0; i < kResamples; ++i) {
    Sums sums(blocks.front().size());
    for (std::size_t drawn = 0; drawn < blocks.size(); ++drawn) {
      const Sums& block = blocks[(engine() >> 32) * blocks.size() >> 32];
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += block[k];
    }
    values.push_back(statistic(sums));
  }
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace vsgl::metrics
