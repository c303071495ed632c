#include "stages/pdf/texels.h"

namespace vsgl {

TexelValues for_each_texel(const Rsm& rsm, const std::function<double(const interop::Moments&)>& value) {
  TexelValues values;
  for (const RsmLayer& layer : rsm.layers) {
    values.emplace_back();
    values.back().reserve(layer.surface.size());
    for (std::size_t k = 0; k < layer.surface.size(); ++k) values.back().push_back(value(layer.pyramid[k]));
  }
  return values;
}

}  // namespace vsgl
