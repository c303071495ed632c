#pragma once

#include <functional>
#include <vector>

#include "scene/procedural/model.h"

namespace vsgl::scene {

// Adds surfaces to a mesh. All are counter-clockwise as seen from their front.
class Shapes {
 public:
  explicit Shapes(std::string name, int material, bool textured = false) : textured_(textured) {
    mesh_.name = std::move(name);
    mesh_.material = material;
  }

  // A flat polygon with four corners (two triangles abc and acd), which need not be exactly planar.
  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
  // A parallelogram of columns x rows cells: origin, origin + u, origin + u + v, origin + v. Texture
  // coordinates count metres along u and v, divided by `tile`.
  void grid(Vec3 origin, Vec3 u, Vec3 v, int columns, int rows, double tile = 1);
  // The outside of a box; `faces` picks from the letters of its sides: x X y Y z Z (lower case: towards
  // minus).
  void box(Vec3 low, Vec3 high, const std::string& faces = "xXyYzZ");
  // A smooth surface over [0,1]^2: `at` gives position and front-side normal. Columns run along s, rows along
  // t; ds x dt of the positions must point to the front.
  struct Point {
    Vec3 position, normal;
  };
  void surface(int columns, int rows, const std::function<Point(double s, double t)>& at);

  ModelMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(Vec3 position, Vec3 normal, double u, double v);
  void cells(std::uint32_t first, int columns, int rows);
  ModelMesh mesh_;
  bool textured_;
};

}  // namespace vsgl::scene
