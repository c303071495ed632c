#include <numbers>

#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {
namespace {

// The Cornell box's data of the Cornell University Program of Computer Graphics, in millimetres there. x runs
// to the left as the camera sees it, y up, z away from it. The reflectances are the measured spectra as
// linear RGB.
constexpr Vec3 white{0.747, 0.740, 0.737}, red{0.63, 0.065, 0.05}, green{0.14, 0.45, 0.091};
constexpr double mm = 1e-3;

// The room's corners; the published walls are not quite at right angles.
constexpr double floor_left = 552.8, floor_left_back = 549.6, ceiling_left = 556.0, top = 548.8, back = 559.2;

Vec3 at(double x, double y, double z) {
  return Vec3{x, y, z} * mm;
}

void add_room(Model& model, int floor, int other, int left, int right) {
  Shapes floor_shape("floor", floor);
  floor_shape.quad(at(floor_left, 0, 0), at(0, 0, 0), at(0, 0, back), at(floor_left_back, 0, back));
  Shapes ceiling("ceiling", other);
  ceiling.quad(at(ceiling_left, top, 0), at(ceiling_left, top, back), at(0, top, back), at(0, top, 0));
  Shapes back_wall("back wall", other);
  back_wall.quad(at(floor_left_back, 0, back), at(0, 0, back), at(0, top, back), at(ceiling_left, top, back));
  Shapes right_wall("right wall", right);
  right_wall.quad(at(0, 0, back), at(0, 0, 0), at(0, top, 0), at(0, top, back));
  Shapes left_wall("left wall", left);
  left_wall.quad(at(floor_left, 0, 0), at(floor_left_back, 0, back), at(ceiling_left, top, back),
                 at(ceiling_left, top, 0));
  for (Shapes* shape : {&floor_shape, &ceiling, &back_wall, &right_wall, &left_wall})
    model.add(shape->take());
}

// A block on the floor: its lid's corners, published in the order that faces upwards, and its height. Without
// an underside.
void add_block(Model& model, const std::string& name, int material,
               const std::array<std::array<double, 2>, 4>& lid, double height) {
  Shapes shape(name, material);
  const auto corner = [&](int i, double y) { return at(lid[i % 4][0], y, lid[i % 4][1]); };
  shape.quad(corner(0, height), corner(1, height), corner(2, height), corner(3, height));
  for (int i = 0; i < 4; ++i)
    shape.quad(corner(i + 1, height), corner(i, height), corner(i, 0), corner(i + 1, 0));
  model.add(shape.take());
}

constexpr std::array<std::array<double, 2>, 4> short_block{{{130, 65}, {82, 225}, {240, 272}, {290, 114}}};
constexpr std::array<std::array<double, 2>, 4> tall_block{{{423, 247}, {265, 296}, {314, 456}, {472, 406}}};

Model box(const ModelMaterial& floor, const ModelMaterial& tall, bool blocks) {
  Model model;
  const int white_index = model.add_material({"white", white, {}});
  const int red_index = model.add_material({"red", red, {}});
  const int green_index = model.add_material({"green", green, {}});
  add_room(model, model.add_material(floor), white_index, red_index, green_index);
  if (blocks) {
    add_block(model, "short block", white_index, short_block, 165);
    add_block(model, "tall block", model.add_material(tall), tall_block, 330);
  }
  // The published camera: focal length 35 mm, film 25 x 25 mm.
  model.camera = {at(278, 273, -800), at(278, 273, 0), 2 * std::atan(12.5 / 35) * 180 / std::numbers::pi};
  model.width = model.height = 512;
  // Just below the ceiling, turned towards the red wall: half of the floor and the short block stay in the
  // dark, and some of what it lights is hidden from the camera behind the tall block.
  model.light = {at(278, 540, 240), at(440, 0, 330), 28};
  model.light_inner_deg = 22;
  model.light_intensity_w_sr = 2;
  return model;
}

}  // namespace

Model make_cornell(const GenerateOptions& options) {
  return box({"floor", white, {}}, {"tall block", white, {}}, options.mesh.empty());
}

Model make_cornell_glossy(const GenerateOptions& options) {
  const auto [alpha, ndf] = chosen_lobe(options, 0.2);
  return box({"floor", {0.3, 0.3, 0.3}, {0.5, 0.5, 0.5}, false, alpha, ndf},
             {"tall block", {0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}, false, alpha, ndf}, true);
}

}  // namespace vsgl::scene
