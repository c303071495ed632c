#include "image/exposure.h"

#include <algorithm>
#include <cmath>

namespace vsgl {

double automatic_exposure(std::vector<double> luminances) {
  std::erase_if(luminances, [](double v) { return !(std::isfinite(v) && v > 0); });
  if (luminances.empty()) return 0;
  const auto nth = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() * 95 / 100);
  std::nth_element(luminances.begin(), nth, luminances.end());
  return std::log2(0.8 / *nth);
}

}  // namespace vsgl
