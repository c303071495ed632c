#include "math/progressive.h"

#include "math/sampling.h"

namespace vsgl {

double radius2_scale(const Pass& pass) {
  double scale = 1;
  for (int j = 1; j < pass.number; ++j) scale *= (j + pass.alpha) / (j + 1);
  return scale;
}

std::uint64_t pass_seed(std::uint64_t seed, const Pass& pass) {
  if (pass.number == 1) return seed;
  const auto words = pcg3d({static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                            static_cast<std::uint32_t>(pass.number)});
  return static_cast<std::uint64_t>(words[0]) << 32 | words[1];
}

}  // namespace vsgl
