#include "scene/procedural/shapes.h"

#include <cmath>
#include <numbers>

namespace vsgl::scene {
namespace {

std::array<float, 3> single(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

std::uint32_t Shapes::vertex(Vec3 position, Vec3 normal, double u, double v) {
  mesh_.positions.push_back(single(position));
  mesh_.normals.push_back(single(normalise(normal)));
  if (tile_ > 0) mesh_.uvs.push_back({static_cast<float>(u / tile_), static_cast<float>(-v / tile_)});
  return static_cast<std::uint32_t>(mesh_.positions.size()) - 1;
}

// Two triangles for each cell of (columns + 1) x (rows + 1) vertices that start at `first`.
void Shapes::cells(std::uint32_t first, int columns, int rows) {
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a =
          first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
      for (const std::uint32_t index : {a, a + 1, a + stride + 1, a, a + stride + 1, a + stride}) {
        mesh_.indices.push_back(index);
      }
    }
}

void Shapes::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 normal = normalise(cross(c - a, d - b));
  const bool level = std::abs(normal.y) > 0.99;
  const Vec3 right = level ? Vec3{1, 0, 0} : normalise(cross({0, 1, 0}, normal));
  const Vec3 up = cross(normal, right);
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  for (const Vec3 corner : {a, b, c, d}) vertex(corner, normal, dot(corner, right), dot(corner, up));
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh_.indices.push_back(first + corner);
}

void Shapes::grid(Vec3 origin, Vec3 u, Vec3 v, int columns, int rows) {
  const Vec3 normal = cross(u, v);
  surface(
      columns, rows,
      [&](double s, double t) {
        return Point{origin + u * s + v * t, normal};
      },
      length(u), length(v));
}

void Shapes::box(Vec3 low, Vec3 high, const std::string& faces) {
  const auto corner = [&](int x, int y, int z) {
    return Vec3{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z};
  };
  for (const char face : faces) switch (face) {
      case 'x':
        quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
        break;
      case 'X':
        quad(corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
        break;
      case 'y':
        quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
        break;
      case 'Y':
        quad(corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
        break;
      case 'z':
        quad(corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
        break;
      default:
        quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
        break;
    }
}

void Shapes::surface(int columns, int rows, const std::function<Point(double s, double t)>& at, double size_s,
                     double size_t) {
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const double s = static_cast<double>(column) / columns, t = static_cast<double>(row) / rows;
      const Point point = at(s, t);
      vertex(point.position, point.normal, s * size_s, t * size_t);
    }
  cells(first, columns, rows);
}

ModelMesh ball(const std::string& name, int material, Vec3 centre, double radius, int cells) {
  constexpr Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr double quarter = std::numbers::pi / 2;
  Shapes shape(name, material);
  for (int face = 0; face < 6; ++face) {
    const double side = face < 3 ? 1 : -1;
    const Vec3 out = axes[face % 3] * side, right = axes[(face + 1) % 3] * side, up = axes[(face + 2) % 3];
    shape.surface(cells, cells, [&](double s, double t) {
      const Vec3 n =
          normalise(out + right * std::tan(quarter * (s - 0.5)) + up * std::tan(quarter * (t - 0.5)));
      return Shapes::Point{centre + n * radius, n};
    });
  }
  return shape.take();
}

}  // namespace vsgl::scene
