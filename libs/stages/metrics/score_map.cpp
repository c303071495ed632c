#include "stages/metrics/score_map.h"

#include <cmath>
#include <limits>

namespace vsgl::metrics {
namespace {

// Of one channel of one pixel. [Welch 1947] degrees of freedom of a sum of estimated variances.
double score(const LayerPair& layer, const Uncertainty& test, const Uncertainty& reference, std::size_t i,
             std::size_t channel) {
  double variance = 0, spread = 0;
  for (const Uncertainty* u : {&test, &reference}) {
    if (u->variance.empty()) continue;
    const auto v = static_cast<double>(u->variance[i][channel]);
    variance += v;
    if (u->passes) spread += v * v / (*u->passes - 1);
  }
  if (variance == 0) return 0;
  const double difference =
      static_cast<double>(layer.test[i][channel]) - static_cast<double>(layer.reference[i][channel]);
  if (!std::isfinite(difference)) return difference;
  const double freedom = spread > 0 ? variance * variance / spread : std::numeric_limits<double>::infinity();
  return normal_score(difference / std::sqrt(variance), freedom);
}

}  // namespace

std::vector<float> score_map(const LayerPair& layer, const Uncertainty& test, const Uncertainty& reference) {
  std::vector<float> out(layer.reference.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double s = score(layer, test, reference, i, c);
      if (!(std::abs(s) <= std::abs(worst))) worst = s;
    }
    out[i] = static_cast<float>(worst);
  }
  return out;
}

}  // namespace vsgl::metrics
