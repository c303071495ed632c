#include "stages/visibility/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Of a point of the tree and a pixel: the distance and, times it, the cosines at both ends.
struct Meeting {
  float emission, arrival, distance;

  float least() const { return std::min(emission, arrival); }
  bool faces() const { return least() > kGrazing * distance; }
};

Meeting meeting(interop::vec3 point, interop::vec3 normal, const interop::Surface& pixel) {
  const interop::vec3 v = minus(pixel.position, point);
  return {product(v, normal), -product(v, pixel.normal), std::sqrt(product(v, v))};
}

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
  for (int level = 0;; ++level) {
    const Meeting m = meeting(point->position, point->normal, receiver);
    if (m.faces()) return point->lit ? point : nullptr;
    const bool others_may = m.emission > -point->spread * (m.distance + point->extent) &&
                            m.arrival > -point->extent && point->children != 0;
    if (!others_may || level == kSearchedLevels) return nullptr;
    const Point* first = &points_[point->children];
    const auto rank = [&](const Point& p) {
      return p.lit ? meeting(p.position, p.normal, receiver).least() : -std::numeric_limits<float>::max();
    };
    point =
        std::max_element(first, first + 4, [&](const Point& a, const Point& b) { return rank(a) < rank(b); });
  }
}

std::uint32_t Sight::facing(std::span<const Pair> pairs) const {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    bits |= static_cast<std::uint32_t>(facing_point(pairs[i]) != nullptr) << i;
  return bits;
}

}  // namespace vsgl::visibility
