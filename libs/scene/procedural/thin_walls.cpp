#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {

// A room of 6 x 3 x 4 m. A wall without thickness at x = 0 leaves a doorway at its far end (small z), one of
// 1 cm at x = 1.6 at its near end. The light stands to the left of both: what reaches the right must come
// through the doorways.
Model make_thin_walls(const GenerateOptions&) {
  Model model;
  const int white = model.add_material({"white", {0.75, 0.75, 0.75}, {}});
  const int blue = model.add_material({"blue", {0.2, 0.3, 0.65}, {}});
  const int orange = model.add_material({"orange", {0.75, 0.4, 0.15}, {}});
  const Vec3 low{-3, 0, -2}, high{3, 3, 2};

  // Seen from inside: each side with its corners the other way round than a box's.
  Shapes room("room", white);
  room.quad({low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, low.y, low.z}, {low.x, low.y, low.z});
  room.quad({low.x, high.y, low.z}, {high.x, high.y, low.z}, {high.x, high.y, high.z},
            {low.x, high.y, high.z});
  room.quad({low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z});
  room.quad({high.x, low.y, high.z}, {low.x, low.y, high.z}, {low.x, high.y, high.z},
            {high.x, high.y, high.z});
  Shapes left("left wall", orange);
  left.quad({low.x, low.y, high.z}, {low.x, low.y, low.z}, {low.x, high.y, low.z}, {low.x, high.y, high.z});
  Shapes right("right wall", blue);
  right.quad({high.x, low.y, low.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z},
             {high.x, high.y, low.z});
  Shapes sheet("sheet", white);
  sheet.quad({0, 0, high.z}, {0, 0, low.z + 1}, {0, high.y, low.z + 1}, {0, high.y, high.z});
  Shapes slab("slab", white);
  slab.box({1.6, 0, low.z}, {1.61, high.y, -0.4}, "xXZ");
  for (Shapes* shape : {&room, &left, &right, &sheet, &slab}) model.add(shape->take());

  model.camera = {{2.8, 1.6, 1.75}, {-0.6, 1.2, -1.2}, 58};
  model.light = {{-1.2, 2.8, 0.8}, {-1.5, 0, -1.2}, 40};
  model.light_inner_deg = 30;
  model.light_intensity_w_sr = 30;
  return model;
}

}  // namespace vsgl::scene
