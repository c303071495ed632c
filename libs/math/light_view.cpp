#include "math/light_view.h"

#include "base/error.h"
#include "math/interop_vec.h"

namespace vsgl {
namespace {

interop::uint view_kind(LightType type) {
  switch (type) {
    case LightType::spot:
      return interop::VIEW_SPOT;
    case LightType::directional:
      return interop::VIEW_DIRECTIONAL;
    case LightType::point:
      return interop::VIEW_POINT;
  }
  throw Error(ErrorCode::internal, "unknown type of light");
}

}  // namespace

interop::View light_view(const LightSource& light, int width, int height) {
  interop::View view{};
  view.origin = to_float(light.position);
  view.kind = view_kind(light.type);
  view.right = to_float(light.right);
  view.extent_x = static_cast<float>(light.extent_x);
  view.up = to_float(light.up);
  view.extent_y = static_cast<float>(light.extent_y);
  view.forward = to_float(light.forward);
  view.intensity = to_float(light.intensity);
  view.cos_inner = static_cast<float>(light.cos_inner);
  view.cos_outer = static_cast<float>(light.cos_outer);
  view.width = static_cast<interop::uint>(width);
  view.height = static_cast<interop::uint>(height);
  return view;
}

}  // namespace vsgl
