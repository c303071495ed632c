#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"
#include "scene/procedural/tile_textures.h"

namespace vsgl::scene {
namespace {

// A court open to the sky, round it a colonnade with arches, behind that a roofed gallery with outer walls.
// The colonnade's centre line is a rectangle of bays_x x bays_z squares. Lengths in metres.
constexpr int bays_x = 5, bays_z = 4;
constexpr double bay = 2.4, half_x = bays_x * bay / 2, half_z = bays_z * bay / 2;
constexpr double gallery = 2.6;            // from the colonnade to the outer wall
constexpr double thickness = 0.5;          // of the arcade
constexpr double spring = 2.9, top = 4.6;  // heights at which the arches begin and the arcade ends
constexpr double tile = bay;               // size of the textures' pictures
constexpr double arch_radius = bay / 2 - thickness / 2;
constexpr double outer_x = half_x + gallery, outer_z = half_z + gallery;

// How finely everything is cut up.
struct Detail {
  int around = 8;  // segments of a column's circumference and of an arch
  int along = 11;  // rings of a column, a multiple of the 11 parts of its profile
  int tiles = 1;   // cells of floor and walls per bay
};

// Outline of a column from the plinth to the abacus: radius over height, both in metres.
constexpr std::array<std::array<double, 2>, 12> profile{{{0.15, 0.24},
                                                         {0.19, 0.26},
                                                         {0.25, 0.24},
                                                         {0.29, 0.20},
                                                         {0.40, 0.19},
                                                         {1.20, 0.188},
                                                         {2.30, 0.165},
                                                         {2.42, 0.16},
                                                         {2.46, 0.185},
                                                         {2.50, 0.165},
                                                         {2.64, 0.20},
                                                         {2.75, 0.245}}};

// (height, radius) at t in [0, 1]: from ring to ring of the profile, rounded.
std::array<double, 2> outline(double t) {
  constexpr int last = static_cast<int>(profile.size()) - 1;
  const int i = std::min(static_cast<int>(t * last), last - 1);
  const double f = t * last - i;
  return {std::lerp(profile[i][0], profile[i + 1][0], f),
          std::lerp(profile[i][1], profile[i + 1][1], f * f * (3 - 2 * f))};
}

ModelMesh column(int material, const Detail& detail) {
  Shapes shape("column", material);
  shape.box({-0.25, 0, -0.25}, {0.25, 0.15, 0.25}, "xXYzZ");
  shape.box({-0.25, 2.75, -0.25}, {0.25, spring, 0.25}, "xXyzZ");
  shape.surface(detail.around, detail.along, [](double s, double t) {
    const double angle = -2 * std::numbers::pi * s;  // so that ds x dt points outwards
    const auto [height, radius] = outline(t);
    constexpr double step = 1e-4;
    const auto low = outline(std::max(t - step, 0.0)), high = outline(std::min(t + step, 1.0));
    const double rise = high[0] - low[0], flare = high[1] - low[1];
    const Vec3 radial{std::cos(angle), 0, std::sin(angle)};
    return Shapes::Point{radial * radius + Vec3{0, height, 0}, radial * rise - Vec3{0, flare, 0}};
  });
  return shape.take();
}

// The wall above one bay, along x and centred, with its arch cut out; +z faces the court. The roof covers its
// top.
ModelMesh arch(int material, const Detail& detail) {
  Shapes shape("arch", material, tile);
  const double depth = thickness / 2;
  // The rim of the opening at s in [0, 1] from right to left, and the point of the wall's outline that it is
  // joined to.
  const auto rim = [](double s) {
    const double angle = std::numbers::pi * s;
    return Vec3{arch_radius * std::cos(angle), spring + arch_radius * std::sin(angle), 0};
  };
  const auto outline_at = [](double s) {
    const Vec3 direction{std::cos(std::numbers::pi * s), std::sin(std::numbers::pi * s), 0};
    const double to_side = (bay / 2) / std::max(std::abs(direction.x), 1e-12);
    const double to_top = (top - spring) / std::max(direction.y, 1e-12);
    return Vec3{0, spring, 0} + direction * std::min(to_side, to_top);
  };
  // Even segments in angle miss the outline's two corners; there, extra points keep them.
  std::vector<double> cuts;
  for (int i = 0; i <= detail.around; ++i) cuts.push_back(static_cast<double>(i) / detail.around);
  const double corner = std::atan2(top - spring, bay / 2) / std::numbers::pi;
  cuts.insert(cuts.end(), {corner, 1 - corner});
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Vec3 a = rim(cuts[i]), b = rim(cuts[i + 1]), c = outline_at(cuts[i + 1]), d = outline_at(cuts[i]);
    if (cuts[i + 1] - cuts[i] < 1e-9) continue;
    const Vec3 front{0, 0, depth};
    shape.quad(d + front, c + front, b + front, a + front);
    shape.quad(a - front, b - front, c - front, d - front);
  }
  const auto underside = [&](double s, double t) {
    const Vec3 position = rim(s);
    return Shapes::Point{position + Vec3{0, 0, depth * (1 - 2 * t)},
                         Vec3{0, spring, 0} - Vec3{position.x, position.y, 0}};
  };
  shape.surface(detail.around, 1, underside, std::numbers::pi * arch_radius, thickness);
  return shape.take();
}

// A turn of `quarters` times 90 degrees about y, then a move; exact.
Mat4 turned(int quarters, Vec3 to) {
  static constexpr int sine[4] = {0, 1, 0, -1}, cosine[4] = {1, 0, -1, 0};
  const double s = sine[quarters % 4], c = cosine[quarters % 4];
  return {{{c, 0, s, to.x}, {0, 1, 0, to.y}, {-s, 0, c, to.z}, {0, 0, 0, 1}}};
}

void add_colonnade(Model& model, int stone, int wall, const Detail& detail) {
  const int column_mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(column(stone, detail));
  model.meshes.push_back(arch(wall, detail));
  const auto side = [&](int quarters, int bays, double along, double across) {
    for (int i = 0; i < bays; ++i) {
      const Mat4 turn = turned(quarters, {});
      const auto place = [&](double x) { return turned(quarters, turn.point({x, 0, -across})); };
      model.nodes.push_back({"arch", column_mesh + 1, place((i + 0.5) * bay - along)});
      if (i > 0) model.nodes.push_back({"column", column_mesh, place(i * bay - along)});
    }
  };
  side(0, bays_x, half_x, half_z);
  side(1, bays_z, half_z, half_x);
  side(2, bays_x, half_x, half_z);
  side(3, bays_z, half_z, half_x);
  Shapes pier("pier", stone);
  pier.box({-0.3, 0, -0.3}, {0.3, top + 0.1, 0.3}, "xXYzZ");  // through the roof, not flush with it
  const int pier_mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(pier.take());
  for (const double x : {-half_x, half_x})
    for (const double z : {-half_z, half_z}) model.nodes.push_back({"pier", pier_mesh, turned(0, {x, 0, z})});
}

// Floor, outer walls seen from inside, and the gallery's ceiling as four strips.
void add_shell(Model& model, int floor, int wall, int ceiling, const Detail& detail) {
  const int nx = (bays_x + 2) * detail.tiles, nz = (bays_z + 2) * detail.tiles, ny = 2 * detail.tiles;
  Shapes ground("floor", floor, tile);
  ground.grid({-outer_x, 0, outer_z}, {2 * outer_x, 0, 0}, {0, 0, -2 * outer_z}, nx, nz);
  Shapes walls("walls", wall, tile);
  walls.grid({-outer_x, 0, -outer_z}, {2 * outer_x, 0, 0}, {0, top, 0}, nx, ny);
  walls.grid({outer_x, 0, outer_z}, {-2 * outer_x, 0, 0}, {0, top, 0}, nx, ny);
  walls.grid({-outer_x, 0, outer_z}, {0, 0, -2 * outer_z}, {0, top, 0}, nz, ny);
  walls.grid({outer_x, 0, -outer_z}, {0, 0, 2 * outer_z}, {0, top, 0}, nz, ny);
  Shapes roof("gallery ceiling", ceiling);
  const double depth = gallery + thickness / 2;
  roof.grid({-outer_x, top, -outer_z}, {2 * outer_x, 0, 0}, {0, 0, depth}, nx, detail.tiles);
  roof.grid({-outer_x, top, outer_z - depth}, {2 * outer_x, 0, 0}, {0, 0, depth}, nx, detail.tiles);
  const double inner = 2 * (outer_z - depth);
  roof.grid({-outer_x, top, depth - outer_z}, {depth, 0, 0}, {0, 0, inner}, detail.tiles, nz);
  roof.grid({outer_x - depth, top, depth - outer_z}, {depth, 0, 0}, {0, 0, inner}, detail.tiles, nz);
  for (Shapes* shape : {&ground, &walls, &roof}) model.add(shape->take());
}

struct Materials {
  int floor, wall, stone, ceiling;
};

Materials add_materials(Model& model, const GenerateOptions& options) {
  const auto [alpha, ndf] = chosen_lobe(options, 0.2);
  ModelMaterial floor{"floor", {0.85, 0.85, 0.85}, {0.15, 0.15, 0.15}, false, alpha, ndf};
  ModelMaterial wall{"wall", {1, 1, 1}, {}, false, 1, "ggx"};
  if (options.texture_dir.empty()) {
    const TilePattern tiles{4, 4, false, {0.45, 0.4, 0.33}, 0.3, 0.04, 0.6, options.seed};
    const TilePattern bricks{4, 10, true, {0.6, 0.42, 0.32}, 0.2, 0.08, 1, options.seed + 100};
    floor.base_color_image = "floor-color.png", floor.normal_image = "floor-normal.png";
    wall.base_color_image = "wall-color.png", wall.normal_image = "wall-normal.png";
    model.images = {{floor.base_color_image, tile_colour_png(tiles)},
                    {floor.normal_image, tile_normal_png(tiles)},
                    {wall.base_color_image, tile_colour_png(bricks)},
                    {wall.normal_image, tile_normal_png(bricks)}};
  }
  const int floor_index = model.add_material(floor), wall_index = model.add_material(wall);
  return {floor_index, wall_index, model.add_material({"stone", {0.7, 0.66, 0.58}, {}}),
          model.add_material({"plaster", {0.75, 0.73, 0.7}, {}})};
}

void add_geometry(Model& model, const Materials& materials, const Detail& detail) {
  add_colonnade(model, materials.stone, materials.wall, detail);
  add_shell(model, materials.floor, materials.wall, materials.ceiling, detail);
}

std::size_t count(const Detail& detail) {
  Model model;
  add_geometry(model, {0, 1, 2, 3}, detail);
  return model.triangle_count();
}

// The finest detail within the budget: first the columns and arches, with three quarters of it, then floor
// and walls with the rest.
Detail fit(std::size_t budget) {
  const auto refined = [](int step) { return Detail{8 + 4 * step, 11 * (1 + step / 2), 1}; };
  int step = 0;
  while (count(refined(step + 1)) * 4 <= budget * 3) ++step;
  for (Detail detail = refined(step);; ++detail.tiles) {
    Detail finer = detail;
    ++finer.tiles;
    if (count(finer) > budget) return detail;
  }
}

}  // namespace

Model make_atrium(const GenerateOptions& options) {
  const std::size_t least = count({});
  if (options.triangles < static_cast<int>(least)) {
    throw Error(ErrorCode::out_of_range, "--triangles: the atrium has at least " + std::to_string(least) +
                                             " triangles, not " + std::to_string(options.triangles));
  }
  Model model;
  const Materials materials = add_materials(model, options);
  add_geometry(model, materials, fit(static_cast<std::size_t>(options.triangles)));
  model.camera = {{-outer_x + 0.9, 1.7, 1.9}, {2, 1.75, -2.2}, 62};
  // Like the sun: over the roof of one side into the court, onto its floor and the arcade opposite.
  model.light = {{-7, 14, 5}, {1.2, 0, -1.0}, 19};
  model.light_inner_deg = 17;
  model.light_intensity_w_sr = 1500;
  return model;
}

}  // namespace vsgl::scene
