#include "scene/instances.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "math/frame.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

std::array<float, 3> single(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3 wide(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::vector<Vertex> transform_vertices(const std::vector<Vertex>& vertices, const Mat4& transform,
                                       const std::string& where) {
  const float handedness = determinant(transform) < 0 ? -1.0f : 1.0f;
  std::vector<Vertex> out;
  out.reserve(vertices.size());
  for (const Vertex& vertex : vertices) {
    const Vec3 position = transform.point(wide(vertex.position));
    const Vec3 normal = normalise(transform_normal(transform, wide(vertex.normal)));
    const Vec3 along = transform.direction(wide({vertex.tangent[0], vertex.tangent[1], vertex.tangent[2]}));
    Vec3 tangent = normalise(along - normal * dot(along, normal));
    if (length(tangent) < 0.5) tangent = frame_about(normal).x;
    const auto [x, y, z] = single(tangent);
    out.push_back({single(position), single(normal), {x, y, z, handedness * vertex.tangent[3]}, vertex.uv});
    if (!is_finite(wide(out.back().position)) || !is_finite(normal)) {
      throw Error(ErrorCode::mesh_invalid,
                  where + ": its transform takes vertices out of the range of numbers");
    }
  }
  return out;
}

// Without triangles that have no area, and with the winding that a mirroring transform asks for.
std::vector<std::uint32_t> sound_triangles(const std::vector<std::uint32_t>& indices,
                                           const std::vector<Vertex>& vertices, bool mirrored) {
  std::vector<std::uint32_t> out;
  out.reserve(indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vec3 a = wide(vertices[indices[i]].position);
    const Vec3 ab = wide(vertices[indices[i + 1]].position) - a,
               ac = wide(vertices[indices[i + 2]].position) - a;
    const double longest = std::max({length(ab), length(ac), length(ac - ab)});
    if (!(length(cross(ab, ac)) > 1e-12 * longest * longest)) continue;
    out.push_back(indices[i]);
    out.push_back(indices[mirrored ? i + 2 : i + 1]);
    out.push_back(indices[mirrored ? i + 1 : i + 2]);
  }
  return out;
}

}  // namespace

std::string where(const PlacedNode& placed) {
  return placed.mesh->file.string() + ": node \"" + placed.node->name + "\"";
}

// Transforms are composed from the outside in: with the anchor subtracted
// first, large offsets cancel before they can swallow digits of anything below them.
std::vector<PlacedNode> place_nodes(const SceneSpec& spec, const MeshFiles& files, Vec3 anchor) {
  std::vector<PlacedNode> out;
  for (const MeshSpec& mesh : spec.meshes) {
    Mat4 outer = translation(-anchor);
    for (const Mat4& step : mesh.transforms) outer = compose(outer, step);
    const MeshFile& file = files.at(mesh.file);
    const std::size_t first = out.size();
    for (const MeshNode& node : file.nodes) {
      const Mat4& parent = node.parent < 0 ? outer : out[first + node.parent].transform;
      out.push_back({&mesh, &file, &node, compose(parent, node.local)});
    }
  }
  return out;
}

Instance make_instance(const PlacedNode& placed, const Mesh& mesh, int material) {
  const double volume = determinant(placed.transform);
  if (!is_finite(placed.transform) || volume == 0) {
    throw Error(ErrorCode::mesh_invalid, where(placed) + ": its transform is not finite or flattens space");
  }
  Instance instance{
      placed.node->name, material, transform_vertices(mesh.vertices, placed.transform, where(placed)), {}};
  instance.indices = sound_triangles(mesh.indices, instance.vertices, volume < 0);
  return instance;
}

}  // namespace vsgl::scene
