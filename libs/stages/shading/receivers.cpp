#include "stages/shading/receivers.h"

#include <array>

#include "interop/model.h"

namespace vsgl {
namespace {

bool is_black(interop::vec3 c) {
  return c.x == 0 && c.y == 0 && c.z == 0;
}

bool is_bumped(const interop::Surface& s) {
  return s.normal.x != s.shading_normal.x || s.normal.y != s.shading_normal.y ||
         s.normal.z != s.shading_normal.z;
}

interop::vec3 sum(interop::vec3 a, interop::vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace

std::uint32_t receiver_ndf(const interop::Surface& surface) {
  return is_black(surface.specular) ? interop::NDF_NONE : surface.ndf;
}

ReceiverList slice(const ReceiverList& list, std::size_t first, std::size_t count) {
  const auto part = [=](const auto& all) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  return {list.ndf, list.bumped, part(list.pixels), part(list.surfaces)};
}

void add(const std::vector<interop::ShadingSums>& sums, const ReceiverList& list,
         std::vector<interop::ShadingSums>& image) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    interop::ShadingSums& pixel = image[list.pixels[i]];
    pixel.diffuse = sum(pixel.diffuse, sums[i].diffuse);
    pixel.specular = sum(pixel.specular, sums[i].specular);
    pixel.aside += sums[i].aside;
  }
}

std::vector<ReceiverList> sort_receivers(const GBuffer& gbuffer, bool skip) {
  std::array<ReceiverList, interop::NDF_ANY + 1> lists;
  for (std::uint32_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const interop::Surface& s = gbuffer.pixels[i];
    if (s.id == interop::NO_INSTANCE) continue;
    const std::uint32_t ndf = skip ? receiver_ndf(s) : interop::NDF_ANY;
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
