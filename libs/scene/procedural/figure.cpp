#include <cmath>
#include <cstdio>
#include <numbers>

#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rings = 20, sides = 24;  // of a body
constexpr double start = 0.125;        // of the walk, in turns

// A rounded body from the origin down to -length; half its width and depth at the top and at the bottom.
struct Body {
  const char* name;
  double length, top, bottom, depth;  // depth: over the width
};

constexpr Body bodies[] = {
    {"torso", 0.56, 0.21, 0.16, 0.62}, {"pelvis", 0.26, 0.17, 0.18, 0.7},   {"neck", 0.16, 0.06, 0.07, 1},
    {"head", 0.28, 0.11, 0.1, 1.1},    {"upper-arm", 0.34, 0.065, 0.05, 1}, {"forearm", 0.32, 0.05, 0.035, 1},
    {"hand", 0.19, 0.04, 0.045, 0.5},  {"thigh", 0.48, 0.1, 0.07, 1},       {"shin", 0.46, 0.065, 0.045, 1},
    {"foot", 0.27, 0.05, 0.045, 0.8},
};

void append(std::string& text, const char* format, double a, double b, double c) {
  char line[96];
  std::snprintf(line, sizeof line, format, a, b, c);
  text += line;
}

// Rings of vertices between two poles, counter-clockwise from outside.
std::string body_obj(const Body& body) {
  std::string out = "o " + std::string(body.name) + "\n";
  append(out, "v %.6g %.6g %.6g\n", 0, 0, 0);
  for (int ring = 1; ring < rings; ++ring) {
    const double u = static_cast<double>(ring) / rings, y = -body.length * (1 - std::cos(pi * u)) / 2;
    const double width = (body.top + (body.bottom - body.top) * u) * std::sqrt(std::sin(pi * u));
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * pi * side / sides;
      append(out, "v %.6g %.6g %.6g\n", width * std::sin(angle), y, body.depth * width * std::cos(angle));
    }
  }
  append(out, "v %.6g %.6g %.6g\n", 0, -body.length, 0);
  const auto vertex = [&](int ring, int side) { return 2 + (ring - 1) * sides + side % sides; };
  const auto face = [&](int a, int b, int c) { append(out, "f %.0f %.0f %.0f\n", a, b, c); };
  for (int side = 0; side < sides; ++side) {
    face(1, vertex(1, side), vertex(1, side + 1));
    for (int ring = 1; ring + 1 < rings; ++ring) {
      face(vertex(ring, side), vertex(ring + 1, side), vertex(ring + 1, side + 1));
      face(vertex(ring, side), vertex(ring + 1, side + 1), vertex(ring, side + 1));
    }
    face(vertex(rings - 1, side), 2 + (rings - 1) * sides, vertex(rings - 1, side + 1));
  }
  return out;
}

// Bright and warm from the camera's left, blue from above, dim from below: smooth enough for few harmonics.
Vec3 soft_sky(Vec3 d) {
  const double key = std::pow(std::max(dot(d, normalise({-0.6, 0.7, 0.4})), 0.0), 6);
  const double up = 0.5 + 0.5 * d.y;
  return Vec3{0.12, 0.12, 0.12} + up * Vec3{0.25, 0.35, 0.5} + key * Vec3{3.2, 2.7, 2.0};
}

using Joints = std::vector<ModelJoint>;

void add_part(Model& model, const char* body, const char* material, Joints joints) {
  model.parts.push_back({std::string(body) + ".obj", 2 * sides * (rings - 1), material, std::move(joints)});
}

// A leg and the arm of the other side swing together.
void add_limbs(Model& model, double side) {
  const double phase = start + (side > 0 ? 0 : 0.5);
  const ModelJoint hip{{0.1 * side, 0.93, 0}, {}, 26, phase};
  const ModelJoint knee{{0, -0.44, 0}, {16, 0, 0}, 14, phase + 0.25}, ankle{{0, -0.43, 0.02}, {-96, 0, 0}};
  add_part(model, "thigh", "trousers", {hip});
  add_part(model, "shin", "trousers", {hip, knee});
  add_part(model, "foot", "shoes", {hip, knee, {ankle.position - Vec3{0, 0, 0.06}, ankle.rotation_deg}});
  const ModelJoint shoulder{{0.235 * side, 1.46, 0}, {0, 0, 8 * side}, 24, phase + 0.5};
  const ModelJoint elbow{{0, -0.3, 0}, {-28, 0, 0}, 12, phase + 0.5}, wrist{{0, -0.29, 0}, {}};
  add_part(model, "upper-arm", "shirt", {shoulder});
  add_part(model, "forearm", "skin", {shoulder, elbow});
  add_part(model, "hand", "skin", {shoulder, elbow, wrist});
}

}  // namespace

// A figure 1.75 m tall that faces +z and walks on the spot; each part a mesh file, those of arms and legs
// used twice.
Model make_figure(const GenerateOptions&) {
  Model model;
  const int matt = model.add_material({"matt", {0.6, 0.6, 0.6}, {}});
  Shapes floor("floor", matt);
  floor.quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3});
  model.add(floor.take());
  for (const Body& body : bodies)
    model.part_files.push_back({std::string(body.name) + ".obj", body_obj(body)});
  model.part_materials = {{"skin", {0.75, 0.5, 0.4}},
                          {"shirt", {0.75, 0.12, 0.08}},
                          {"trousers", {0.1, 0.2, 0.6}},
                          {"shoes", {0.15, 0.15, 0.15}}};
  add_part(model, "torso", "shirt", {{{0, 1.54, 0}, {}}});
  add_part(model, "pelvis", "trousers", {{{0, 1.1, 0}, {}}});
  add_part(model, "neck", "skin", {{{0, 1.6, 0}, {}}});
  add_part(model, "head", "skin", {{{0, 1.79, 0.02}, {}, 4, start}});
  for (const double side : {1.0, -1.0}) add_limbs(model, side);
  model.camera = {{1.6, 1.7, 3.4}, {0, 0.75, 0}, 36};
  model.light = {{-2, 3, 2}, {0, 0.8, 0}, 30};
  model.light_inner_deg = 20;
  model.light_intensity_w_sr = 30;
  model.images = {{"sky.exr", environment_exr(soft_sky)}};
  model.environment = "sky.exr";
  model.width = model.height = 512;
  return model;
}

}  // namespace vsgl::scene
