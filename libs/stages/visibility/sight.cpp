#include "stages/visibility/sight.h"

#include <algorithm>
#include <cmath>

#include "stages/visibility/views.h"

namespace vsgl::visibility {
namespace {

// Cosines below this count as behind the horizon: what lies in the receiver's own plane does not light it.
constexpr float kGrazing = 1e-4F;
// Normal deficits up to this are rounding.
constexpr float kFlatDeficit = 1e-6F;
// Levels below a node that are searched for a point that faces the pixel.
constexpr int kSearchedLevels = 3;

interop::vec3 minus(interop::vec3 a, interop::vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
float product(interop::vec3 a, interop::vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Of a point of the tree and a pixel: the cosines at both ends times the distance.
struct Meeting {
  interop::vec3 v{};
  float emission = 0, arrival = 0;

  Meeting() = default;
  Meeting(interop::vec3 point, interop::vec3 normal, const interop::Surface& pixel)
      : v(minus(pixel.position, point)), emission(product(v, normal)), arrival(-product(v, pixel.normal)) {}

  float least() const { return std::min(emission, arrival); }
  float distance() const { return std::sqrt(product(v, v)); }
  bool faces() const { return least() > 0 && least() > kGrazing * distance(); }
};

}  // namespace

Sight::Sight(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals)
    : gbuffer_(gbuffer) {
  points_.reserve(tree.lights.size());
  for (std::uint32_t i = 0; i < tree.lights.size(); ++i) {
    const interop::Light& light = tree.lights[i];
    const bool flat = light.normal_deficit <= kFlatDeficit;
    points_.push_back({.position = light.origin,
                       .normal = normals[i],
                       .children = light.children,
                       .extent = 3 * std::sqrt(light.variance),
                       .spread = flat ? 0 : 2 * std::sqrt(light.normal_deficit),
                       .lit = has_power(light)});
  }
}

const Sight::Point* Sight::facing_point(Pair pair) const {
  const Point* point = &points_[pair.node];
  const interop::Surface& receiver = pixel(pair);
  Meeting met(point->position, point->normal, receiver);
  for (int level = 0;; ++level) {
    if (met.faces()) return point->lit ? point : nullptr;
    const bool others_may = level < kSearchedLevels && point->children != 0 && met.arrival > -point->extent &&
                            met.emission > -point->spread * (met.distance() + point->extent);
    if (!others_may) return nullptr;
    // The lit child that faces the pixel most; of unlit ones the first.
    const Point* first = &points_[point->children];
    point = first;
    for (const Point* child = first; child < first + 4; ++child) {
      const Meeting m(child->position, child->normal, receiver);
      if (child != first && (!child->lit || (point->lit && m.least() <= met.least()))) continue;
      point = child;
      met = m;
    }
  }
}

std::uint32_t Sight::facing(std::span<const Pair> pairs) const {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    bits |= static_cast<std::uint32_t>(facing_point(pairs[i]) != nullptr) << i;
  return bits;
}

}  // namespace vsgl::visibility
