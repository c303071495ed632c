#include "math/light_source.h"

#include <algorithm>

namespace vsgl {

double spot_falloff(const LightSource& light, double cosine) {
  if (light.type != LightType::spot) return 1;
  if (light.cos_inner <= light.cos_outer) return cosine >= light.cos_outer ? 1 : 0;
  const double t = (cosine - light.cos_outer) / std::max(1e-3, light.cos_inner - light.cos_outer);
  return std::pow(std::clamp(t, 0.0, 1.0), 2);
}

Vec3 intensity_towards(const LightSource& light, Vec3 to) {
  return spot_falloff(light, dot(to, light.forward)) * light.intensity;
}

Vec3 direction_to_source(const LightSource& light, Vec3 point) {
  return light.type == LightType::directional ? -light.forward : normalise(light.position - point);
}

}  // namespace vsgl
