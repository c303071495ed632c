#pragma once

#include <functional>
#include <vector>

#include "artifact/artifact.h"
#include "scene/scene.h"

namespace vsgl::test {

// One-bounce light by product rules over all triangles of a scene without textures, in double precision, with
// visibility by testing every triangle: independent of the reference and of Embree.
struct Quadrature {
  int order = 16;  // Gauss-Legendre points a side of each part of a triangle
  int parts = 1;   // each side of a triangle is cut into so many
  // Whether a ray goes through a triangle of an instance at barycentric b, c: holes of cut-outs.
  std::function<bool(std::size_t instance, std::size_t triangle, double b, double c)> is_hole = {};
};

struct Radiance {
  Vec3 diffuse, specular;
  Vec3 sum() const { return diffuse + specular; }
};

// For every pixel.
std::vector<Radiance> integrate(const scene::Scene& scene, const GBuffer& gbuffer, const Quadrature& rule);

}  // namespace vsgl::test
