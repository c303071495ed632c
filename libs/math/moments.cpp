#include "math/moments.h"

#include "math/interop_vec.h"

namespace vsgl {

DoubleMoments to_double(const interop::Moments& m) {
  const auto d = [](float v) { return static_cast<double>(v); };
  return {to_double(m.flux),           to_double(m.power_diffuse),
          to_double(m.power_specular), d(m.weight),
          to_double(m.position),       d(m.spread),
          to_double(m.diffuse_mean),   d(m.diffuse_deficit),
          to_double(m.specular_mean),  d(m.specular_deficit),
          to_double(m.normal_mean),    d(m.normal_deficit)};
}

DoubleMoments merge_moments(std::span<const DoubleMoments> taps, std::span<const double> shares) {
  DoubleMoments m;
  for (std::size_t k = 0; k < taps.size(); ++k) {
    m.flux += shares[k] * taps[k].flux;
    m.power_diffuse += shares[k] * taps[k].power_diffuse;
    m.power_specular += shares[k] * taps[k].power_specular;
    m.weight += shares[k] * taps[k].weight;
  }
  const auto weighted_by = [&](auto weight, Vec3 DoubleMoments::*mean, double DoubleMoments::*spread) {
    return merge_mean_spread(
        taps.size(), [&](std::size_t k) { return shares[k] * weight(taps[k]); },
        [&](std::size_t k) { return taps[k].*mean; }, [&](std::size_t k) { return taps[k].*spread; });
  };
  const auto weight = [](const DoubleMoments& t) { return t.weight; };
  const auto diffuse = [](const DoubleMoments& t) { return luminance(t.power_diffuse); };
  const auto specular = [](const DoubleMoments& t) { return luminance(t.power_specular); };
  const MeanSpread position = weighted_by(weight, &DoubleMoments::position, &DoubleMoments::spread);
  const MeanSpread diffuse_lobe =
      weighted_by(diffuse, &DoubleMoments::diffuse_mean, &DoubleMoments::diffuse_deficit);
  const MeanSpread specular_lobe =
      weighted_by(specular, &DoubleMoments::specular_mean, &DoubleMoments::specular_deficit);
  const MeanSpread normal = weighted_by(weight, &DoubleMoments::normal_mean, &DoubleMoments::normal_deficit);
  m.position = position.mean, m.spread = position.spread;
  m.diffuse_mean = diffuse_lobe.mean, m.diffuse_deficit = diffuse_lobe.spread;
  m.specular_mean = specular_lobe.mean, m.specular_deficit = specular_lobe.spread;
  m.normal_mean = normal.mean, m.normal_deficit = normal.spread;
  return m;
}

}  // namespace vsgl
