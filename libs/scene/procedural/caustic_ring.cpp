#include <cmath>
#include <numbers>

#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {
namespace {

constexpr int segments = 64;  // with four sides, two ends and the floor: 518 triangles
constexpr double inner = 1.0, outer = 1.06, height = 0.5;

// The half at x < 0 of an upright ring: the open side faces +x, where the light comes from.
ModelMesh half_ring(int material) {
  Shapes shape("ring", material);
  const auto radial = [](double s) {
    const double angle = std::numbers::pi * (0.5 + s);
    return Vec3{std::cos(angle), 0, std::sin(angle)};
  };
  const Vec3 up{0, 1, 0};
  shape.surface(segments, 1, [&](double s, double t) {  // inside, towards the axis
    return Shapes::Point{radial(s) * inner + up * (height * t), -radial(s)};
  });
  shape.surface(segments, 1, [&](double s, double t) {  // outside
    return Shapes::Point{radial(1 - s) * outer + up * (height * t), radial(1 - s)};
  });
  shape.surface(segments, 1, [&](double s, double t) {  // upper rim
    return Shapes::Point{radial(s) * std::lerp(inner, outer, t) + up * height, up};
  });
  shape.surface(segments, 1, [&](double s, double t) {  // lower rim
    return Shapes::Point{radial(s) * std::lerp(outer, inner, t), -up};
  });
  for (const double end : {0.0, 1.0}) {
    const Vec3 near = radial(end) * (end > 0 ? outer : inner), far = radial(end) * (end > 0 ? inner : outer);
    shape.quad(far, near, near + up * height, far + up * height);
  }
  return shape.take();
}

}  // namespace

Model make_caustic_ring(const GenerateOptions& options) {
  const auto [alpha, ndf] = chosen_lobe(options, 0.05);
  Model model;
  const int floor = model.add_material({"floor", {0.6, 0.6, 0.6}, {}});
  const int metal = model.add_material({"metal", {0.92, 0.8, 0.55}, {}, true, alpha, ndf});
  Shapes ground("floor", floor);
  ground.quad({-2.5, 0, 2.5}, {2.5, 0, 2.5}, {2.5, 0, -2.5}, {-2.5, 0, -2.5});
  model.add(ground.take());
  model.add(half_ring(metal));
  model.camera = {{1.6, 3.0, 1.3}, {-0.2, 0.1, 0}, 38};
  // Low enough for the ring's inside to throw its light on the floor within half a radius, where the cusp is.
  model.light = {{4.0, 2.3, 0}, {-0.7, 0.2, 0}, 17};
  model.light_inner_deg = 15;
  model.light_intensity_w_sr = 40;
  return model;
}

}  // namespace vsgl::scene
