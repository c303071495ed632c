#include "trace/surface_resolver.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "interop/model.h"
#include "math/interop_vec.h"

namespace vsgl::trace {
namespace {

Vec3 widen(const std::array<float, 3>& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}
Vec3 direction_of(const std::array<float, 4>& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

void require_index(const std::string& owner, std::int64_t index, std::size_t count, const char* what) {
  if (index >= 0 && index < static_cast<std::int64_t>(count)) return;
  throw Error(ErrorCode::mesh_invalid, owner + ": " + what + " " + std::to_string(index) + " of " +
                                           std::to_string(count) + " does not exist");
}

void require_texture(const scene::Scene& scene, const scene::Material& material, int texture) {
  if (texture >= 0)
    require_index("material \"" + material.name + "\"", texture, scene.textures.size(), "texture");
}

void require_indices(const scene::Scene& scene) {
  for (const scene::Instance& instance : scene.instances) {
    const std::string owner = "instance \"" + instance.name + "\"";
    require_index(owner, instance.material, scene.materials.size(), "material");
    for (const std::uint32_t index : instance.indices)
      require_index(owner, index, instance.vertices.size(), "vertex");
  }
  for (const scene::Material& material : scene.materials)
    for (const int texture :
         {material.base_color_texture, material.metallic_roughness_texture, material.normal_texture})
      require_texture(scene, material, texture);
}

// A triangle's corners, and the weights of a point in it.
struct Corners {
  const scene::Vertex &a, &b, &c;
  double wa, wb, wc;  // >= 0, sum 1

  template <typename Get>
  auto interpolate(Get get) const {
    return wa * get(a) + wb * get(b) + wc * get(c);
  }
  double u() const {
    return interpolate([](const scene::Vertex& x) { return static_cast<double>(x.uv[0]); });
  }
  double v() const {
    return interpolate([](const scene::Vertex& x) { return static_cast<double>(x.uv[1]); });
  }
};

Corners corners_of(const scene::Instance& instance, const Hit& hit) {
  const std::uint32_t* index = instance.indices.data() + 3 * std::size_t{hit.triangle};
  const double b = std::max(hit.b, 0.0), c = std::max(hit.c, 0.0), a = std::max(1 - b - c, 0.0);
  const double sum = a + b + c;
  return {instance.vertices[index[0]],
          instance.vertices[index[1]],
          instance.vertices[index[2]],
          a / sum,
          b / sum,
          c / sum};
}

}  // namespace

SurfaceResolver::SurfaceResolver(const scene::Scene& scene) : scene_(scene), textures_(scene.textures) {
  require_indices(scene);
}

bool SurfaceResolver::has_holes(const scene::Instance& instance) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(instance.material)];
  return material.alpha_cutoff > 0 && material.base_color_texture >= 0;
}

bool SurfaceResolver::is_hole(const Hit& hit) const {
  const scene::Instance& instance = scene_.instances[hit.instance];
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(instance.material)];
  const Corners corners = corners_of(instance, hit);
  return textures_.alpha(material.base_color_texture, corners.u(), corners.v()) < material.alpha_cutoff;
}

// Vertex normal (unit) bent by the normal map.
Vec3 SurfaceResolver::shading_normal(const scene::Material& material, Vec3 normal, Vec3 tangent,
                                     double handedness, double u, double v) const {
  Vec3 t = tangent - dot(tangent, normal) * normal;
  if (material.normal_texture < 0 || dot(t, t) <= 1e-12) return normal;
  t = normalise(t);
  const Vec3 b = (handedness < 0 ? -1.0 : 1.0) * cross(normal, t);
  const Rgba texel = textures_.bilinear(material.normal_texture, u, v);
  const Vec3 bent = (2 * texel[0] - 1) * material.normal_scale * t +
                    (2 * texel[1] - 1) * material.normal_scale * b + (2 * texel[2] - 1) * normal;
  return dot(bent, bent) > 1e-12 ? normalise(bent) : normal;
}

void SurfaceResolver::set_reflectance(interop::Surface& s, const scene::Material& material, double u,
                                      double v) const {
  Vec3 base = material.base_color;
  double metallic = material.metallic, alpha = material.alpha;
  if (material.base_color_texture >= 0) {
    const Rgba texel = textures_.bilinear(material.base_color_texture, u, v);
    base = base * Vec3{texel[0], texel[1], texel[2]};
  }
  if (material.metallic_roughness_texture >= 0) {
    const Rgba texel = textures_.bilinear(material.metallic_roughness_texture, u, v);
    metallic *= texel[2];
    alpha *= texel[1] * texel[1];
  }
  const Vec3 specular = (1 - metallic) * material.specular + metallic * base;
  const bool glossy = std::max({specular.x, specular.y, specular.z}) > 0;
  s.diffuse = to_float((1 - metallic) * base);
  s.specular = to_float(specular);
  s.ndf = glossy ? material.ndf : interop::NDF_NONE;
  s.alpha = glossy ? std::max(static_cast<float>(alpha), interop::ALPHA_MIN) : 1;
}

interop::Surface SurfaceResolver::surface(const Hit& hit, Vec3 towards) const {
  const scene::Instance& instance = scene_.instances[hit.instance];
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(instance.material)];
  const Corners corners = corners_of(instance, hit);
  const Vec3 a = widen(corners.a.position);
  const Vec3 ab = widen(corners.b.position) - a, ac = widen(corners.c.position) - a;
  const Vec3 front = normalise(cross(ab, ac));
  const Vec3 facing = dot(front, towards) < 0 ? -front : front;
  const Vec3 interpolated = corners.interpolate([](const scene::Vertex& x) { return widen(x.normal); });
  const Vec3 vertex_normal = dot(interpolated, interpolated) > 1e-12 ? normalise(interpolated) : front;
  const Vec3 tangent = corners.interpolate([](const scene::Vertex& x) { return direction_of(x.tangent); });
  const double handedness =
      corners.interpolate([](const scene::Vertex& x) { return static_cast<double>(x.tangent[3]); });
  const double u = corners.u(), v = corners.v();
  const Vec3 bent = shading_normal(material, vertex_normal, tangent, handedness, u, v);

  interop::Surface s{};
  s.position = to_float(a + corners.wb * ab + corners.wc * ac);
  s.normal = to_float(facing);
  s.shading_normal = to_float(dot(vertex_normal, facing) < 0 ? -bent : bent);
  s.depth = static_cast<float>(hit.distance);
  s.id = hit.instance;
  set_reflectance(s, material, u, v);
  return s;
}

}  // namespace vsgl::trace
