#pragma once

#include <functional>
#include <vector>

#include "scene/procedural/model.h"

namespace vsgl::scene {

// Adds surfaces to a mesh. All are counter-clockwise as seen from their front. Textures stand upright: u runs
// to the right and v downwards as one faces the surface, one picture every `tile` metres.
class Shapes {
 public:
  // Without a tile there are no texture coordinates.
  Shapes(std::string name, int material, double tile = 0) : tile_(tile) {
    mesh_.name = std::move(name);
    mesh_.material = material;
  }

  // A flat polygon with four corners (two triangles abc and acd), which need not be exactly planar.
  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
  // A parallelogram of columns x rows cells: origin, origin + u, origin + u + v, origin + v.
  void grid(Vec3 origin, Vec3 u, Vec3 v, int columns, int rows);
  // The outside of a box; `faces` picks from the letters of its sides: x X y Y z Z (lower case: towards
  // minus).
  void box(Vec3 low, Vec3 high, const std::string& faces = "xXyYzZ");
  // A smooth surface over [0,1]^2: `at` gives position and front-side normal. Columns run along s, rows along
  // t; ds x dt of the positions must point to the front. The sizes along s and t, in metres, are for the
  // texture.
  struct Point {
    Vec3 position, normal;
  };
  void surface(int columns, int rows, const std::function<Point(double s, double t)>& at, double size_s = 1,
               double size_t = 1);

  ModelMesh take() { return std::move(mesh_); }

 private:
  // (u, v) in metres, v upwards.
  std::uint32_t vertex(Vec3 position, Vec3 normal, double u, double v);
  void cells(std::uint32_t first, int columns, int rows);
  ModelMesh mesh_;
  double tile_;
};

// The outside of a sphere: a cube's six faces blown up, of 2 cells^2 triangles each.
ModelMesh ball(const std::string& name, int material, Vec3 centre, double radius, int cells = 16);

}  // namespace vsgl::scene
