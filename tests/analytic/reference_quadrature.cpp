#include "reference_quadrature.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "interop/model.h"
#include "math/interop_vec.h"
#include "math/microfacet.h"

namespace vsgl::test {
namespace {

using std::numbers::pi;

struct Node {
  double x, weight;
};

// Gauss-Legendre on [0, 1], by Newton's method on the Legendre polynomial.
std::vector<Node> gauss_legendre(int order) {
  std::vector<Node> nodes;
  for (int i = 0; i < order; ++i) {
    double x = std::cos(pi * (i + 0.75) / (order + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= order; ++k)
        before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
      slope = order * (x * p - before) / (x * x - 1);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    nodes.push_back({(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

Vec3 widen(const std::array<float, 3>& a) {
  return {a[0], a[1], a[2]};
}

struct Triangle {
  std::size_t instance, index;
  Vec3 a, ab, ac;
  std::array<Vec3, 3> normals;
  const scene::Material* material;
};

std::vector<Triangle> triangles_of(const scene::Scene& scene) {
  std::vector<Triangle> out;
  for (std::size_t k = 0; k < scene.instances.size(); ++k) {
    const scene::Instance& instance = scene.instances[k];
    for (std::size_t i = 0; i + 2 < instance.indices.size(); i += 3) {
      const auto vertex = [&](std::size_t corner) { return instance.vertices[instance.indices[i + corner]]; };
      const Vec3 a = widen(vertex(0).position);
      out.push_back({k,
                     i / 3,
                     a,
                     widen(vertex(1).position) - a,
                     widen(vertex(2).position) - a,
                     {widen(vertex(0).normal), widen(vertex(1).normal), widen(vertex(2).normal)},
                     &scene.materials[static_cast<std::size_t>(instance.material)]});
    }
  }
  return out;
}

class World {
 public:
  World(const scene::Scene& scene, const Quadrature& rule)
      : scene_(scene), rule_(rule), triangles_(triangles_of(scene)) {}

  const std::vector<Triangle>& triangles() const { return triangles_; }

  // [Moller and Trumbore 1997] nothing between two surface points; the ends are left out.
  bool sees(Vec3 from, Vec3 to) const {
    return std::none_of(triangles_.begin(), triangles_.end(),
                        [&](const Triangle& t) { return blocks(t, from, to); });
  }

 private:
  bool blocks(const Triangle& t, Vec3 from, Vec3 to) const {
    constexpr double margin = 1e-6;
    const Vec3 d = to - from, p = cross(d, t.ac);
    const double determinant = dot(t.ab, p);
    if (determinant == 0) return false;
    const Vec3 s = from - t.a, q = cross(s, t.ab);
    const double b = dot(s, p) / determinant, c = dot(d, q) / determinant, along = dot(t.ac, q) / determinant;
    const bool hit = b >= 0 && c >= 0 && b + c <= 1 && along > margin && along < 1 - margin;
    return hit && !(rule_.is_hole && rule_.is_hole(t.instance, t.index, b, c));
  }

  const scene::Scene& scene_;
  const Quadrature& rule_;
  std::vector<Triangle> triangles_;
};

// A small piece of surface that reflects light.
struct Patch {
  Vec3 position, normal, shading_normal, incident;
  Vec3 flux;  // that it reflects per unit of reflectance, W
  Vec3 diffuse, specular;
  double alpha;
  std::uint32_t ndf;
};

struct Arrival {
  Vec3 incident, irradiance, origin;
};

Arrival arrival(const LightSource& light, Vec3 y, double radius) {
  if (light.type == LightType::directional)
    return {-light.forward, light.intensity, y - 4 * radius * light.forward};
  const Vec3 v = light.position - y;
  double falloff = 1;
  if (light.type == LightType::spot) {
    const double cosine = -dot(normalise(v), light.forward);
    const double t = (cosine - light.cos_outer) / (light.cos_inner - light.cos_outer);
    falloff =
        light.cos_inner > light.cos_outer ? std::pow(std::clamp(t, 0.0, 1.0), 2) : cosine >= light.cos_outer;
  }
  return {normalise(v), falloff / dot(v, v) * light.intensity, light.position};
}

void add_patch(std::vector<Patch>& patches, const World& world, const scene::Scene& scene, const Triangle& t,
               double b, double c, double area) {
  const Vec3 y = t.a + b * t.ab + c * t.ac;
  const Vec3 front = normalise(cross(t.ab, t.ac));
  const Vec3 smooth = normalise((1 - b - c) * t.normals[0] + b * t.normals[1] + c * t.normals[2]);
  for (const LightSource& light : scene.lights) {
    const Arrival from = arrival(light, y, scene.radius);
    const Vec3 normal = dot(front, from.incident) < 0 ? -front : front;
    const Vec3 shading_normal = dot(smooth, normal) < 0 ? -smooth : smooth;
    const double cosine = std::max(dot(shading_normal, from.incident), 0.0);
    if (luminance(from.irradiance) == 0 || cosine == 0 || !world.sees(y, from.origin)) continue;
    const scene::Material& m = *t.material;
    const Vec3 specular = (1 - m.metallic) * m.specular + m.metallic * m.base_color;
    patches.push_back({y, normal, shading_normal, from.incident, cosine * area * from.irradiance,
                       (1 - m.metallic) * m.base_color, specular, m.alpha,
                       luminance(specular) > 0 ? m.ndf : interop::NDF_NONE});
  }
}

std::vector<Patch> patches_of(const World& world, const scene::Scene& scene, const Quadrature& rule) {
  const std::vector<Node> nodes = gauss_legendre(rule.order);
  std::vector<Patch> patches;
  const double part = 1.0 / rule.parts;
  for (const Triangle& t : world.triangles())
    for (int i = 0; i < rule.parts; ++i)
      for (int j = 0; j < rule.parts; ++j)
        for (const Node& p : nodes)
          for (const Node& q : nodes) {
            // The square, one side of which collapses onto the corner a.
            const double s = (i + p.x) * part, r = (j + q.x) * part;
            const double area = length(cross(t.ab, t.ac)) * s * p.weight * q.weight * part * part;
            add_patch(patches, world, scene, t, s * (1 - r), s * r, area);
          }
  return patches;
}

// W/sr that leaves a patch in the direction w.
Vec3 intensity(const Patch& y, Vec3 w) {
  const double seen = std::max(dot(y.normal, w), 0.0), bent = dot(y.shading_normal, w);
  Vec3 reflected = y.diffuse / pi;
  if (y.ndf != interop::NDF_NONE && bent > 0)
    reflected += specular_brdf_cos(y.ndf, y.alpha, y.shading_normal, y.incident, w) / bent * y.specular;
  return seen * y.flux * reflected;
}

Radiance gather(const World& world, const std::vector<Patch>& patches, const interop::Surface& pixel,
                Vec3 camera) {
  Radiance sum;
  const Vec3 x = to_double(pixel.position), n = to_double(pixel.shading_normal), view = normalise(camera - x);
  for (const Patch& y : patches) {
    const Vec3 v = y.position - x;
    const Vec3 u = normalise(v);
    const Vec3 arriving = intensity(y, -u) / dot(v, v);
    if (dot(u, to_double(pixel.normal)) <= 0 || luminance(arriving) == 0 || !world.sees(x, y.position))
      continue;
    sum.diffuse += std::max(dot(u, n), 0.0) / pi * to_double(pixel.diffuse) * arriving;
    if (pixel.ndf != interop::NDF_NONE)
      sum.specular += specular_brdf_cos(pixel.ndf, static_cast<double>(pixel.alpha), n, view, u) *
                      to_double(pixel.specular) * arriving;
  }
  return sum;
}

}  // namespace

std::vector<Radiance> integrate(const scene::Scene& scene, const GBuffer& gbuffer, const Quadrature& rule) {
  const World world(scene, rule);
  const std::vector<Patch> patches = patches_of(world, scene, rule);
  std::vector<Radiance> out(gbuffer.pixels.size());
#pragma omp parallel for
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = gather(world, patches, gbuffer.pixels[i], gbuffer.camera);
  return out;
}

}  // namespace vsgl::test
