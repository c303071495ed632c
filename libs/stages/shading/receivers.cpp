#include "stages/shading/receivers.h"

#include <array>

#include "interop/model.h"
#include "interop/shading.h"

namespace vsgl {
namespace {

bool is_black(interop::vec3 c) {
  return c.x == 0 && c.y == 0 && c.z == 0;
}

bool is_bumped(const interop::Surface& s) {
  return s.normal.x != s.shading_normal.x || s.normal.y != s.shading_normal.y ||
         s.normal.z != s.shading_normal.z;
}

}  // namespace

std::vector<ReceiverList> sort_receivers(const GBuffer& gbuffer, bool skip) {
  std::array<ReceiverList, interop::NDF_ANY + 1> lists;
  for (std::uint32_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const interop::Surface& s = gbuffer.pixels[i];
    if (s.id == interop::NO_INSTANCE) continue;
    const std::uint32_t ndf = !skip ? interop::NDF_ANY : is_black(s.specular) ? interop::NDF_NONE : s.ndf;
    ReceiverList& list = lists[ndf];
    list.ndf = ndf;
    list.bumped = list.bumped || !skip || is_bumped(s);
    list.pixels.push_back(i);
    list.surfaces.push_back(s);
  }
  std::vector<ReceiverList> out;
  for (ReceiverList& list : lists)
    if (!list.pixels.empty()) out.push_back(std::move(list));
  return out;
}

}  // namespace vsgl
