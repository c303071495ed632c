#include "stages/metrics/score_map.h"

#include <cmath>

namespace vsgl::metrics {

std::vector<float> score_map(const LayerPair& layer, const Uncertainty& test, const Uncertainty& reference) {
  std::vector<float> out(layer.reference.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double worst = 0;
    for (std::size_t c = 0; c < 3 && !std::isnan(worst); ++c) {
      const double score = value_score(layer, test, reference, i, c).value_or(0);
      if (std::isnan(score) || std::abs(score) > std::abs(worst)) worst = score;
    }
    out[i] = static_cast<float>(worst);
  }
  return out;
}

}  // namespace vsgl::metrics
