#include "scene/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "base/error.h"
#include "math/frame.h"
#include "scene/mesh_material.h"
#include "scene/ply_file.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

constexpr float crease_deg = 60;  // edges sharper than this stay sharp where OBJ and PLY give no normals

[[noreturn]] void invalid(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::mesh_invalid, where + ": " + what);
}

// Assimp's mesh, before its post-processing.

template <typename T>
void scatter(T*& values, const std::vector<unsigned>& source) {
  if (!values) return;
  T* out = new T[source.size()];
  for (std::size_t i = 0; i < source.size(); ++i) out[i] = values[source[i]];
  delete[] values;
  values = out;
}

// Gives every corner of every face its own vertex. Assimp 5.2 needs this to make normals and tangents, yet
// its glTF reader hands over shared vertices, for which it would keep the value of the last face.
void unshare_vertices(aiMesh& mesh) {
  std::vector<unsigned> source;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i) {
      source.push_back(mesh.mFaces[f].mIndices[i]);
      mesh.mFaces[f].mIndices[i] = static_cast<unsigned>(source.size()) - 1;
    }
  scatter(mesh.mVertices, source);
  scatter(mesh.mNormals, source);
  scatter(mesh.mTangents, source);
  scatter(mesh.mBitangents, source);
  for (auto& colours : mesh.mColors) scatter(colours, source);
  for (auto& coordinates : mesh.mTextureCoords) scatter(coordinates, source);
  mesh.mNumVertices = static_cast<unsigned>(source.size());
}

// Makes sure of what Assimp's post-processing takes for granted, and aborts or runs astray without: faces
// have corners, corners are vertices, and the mesh says which kinds of faces it has.
void check_faces(aiMesh& mesh, const std::string& where) {
  aiFace* const end = mesh.mFaces + mesh.mNumFaces;
  aiFace* const kept =
      std::remove_if(mesh.mFaces, end, [](const aiFace& face) { return face.mNumIndices == 0; });
  mesh.mNumFaces = static_cast<unsigned>(kept - mesh.mFaces);
  mesh.mPrimitiveTypes = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    mesh.mPrimitiveTypes |= AI_PRIMITIVE_TYPE_FOR_N_INDICES(face.mNumIndices);
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] < mesh.mNumVertices) continue;
      throw Error(ErrorCode::mesh_unreadable, where + ": face " + std::to_string(f) + " uses vertex " +
                                                  std::to_string(face.mIndices[i]) + " of " +
                                                  std::to_string(mesh.mNumVertices));
    }
  }
  if (mesh.mNumFaces == 0) invalid(where, "the mesh \"" + valid_text(mesh.mName.C_Str()) + "\" has no faces");
}

bool has_triangles(const aiMesh& mesh) {
  return mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE;
}

void post_process(Assimp::Importer& importer, unsigned steps, const std::string& where) {
  if (steps != 0 && !importer.ApplyPostProcessing(steps)) {
    throw Error(ErrorCode::mesh_unreadable, where + ": " + importer.GetErrorString());
  }
}

// Triangles; normals where there are none; tangents where a normal map asks for them.
void complete_meshes(Assimp::Importer& importer, MeshFormat format, bool all_tangents,
                     const std::string& where) {
  auto& scene = const_cast<aiScene&>(*importer.GetScene());  // ours: the importer keeps it for this pass
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) check_faces(*scene.mMeshes[i], where);
  post_process(importer, aiProcess_Triangulate | aiProcess_SortByPType, where);
  unsigned steps = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[i];
    if (!has_triangles(mesh)) continue;
    const bool normal_map = scene.mMaterials[mesh.mMaterialIndex]->GetTextureCount(aiTextureType_NORMALS) > 0;
    const bool wants_tangents =
        (all_tangents || normal_map) && mesh.HasTextureCoords(0) && !mesh.HasTangentsAndBitangents();
    if (!mesh.HasNormals()) {
      steps |= format == MeshFormat::gltf ? aiProcess_GenNormals : aiProcess_GenSmoothNormals;
    }
    if (wants_tangents) steps |= aiProcess_CalcTangentSpace;
    if (!mesh.HasNormals() || wants_tangents) unshare_vertices(mesh);
  }
  post_process(importer, steps, where);
}

// Our mesh.

Vec3 vec3(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

std::array<float, 3> single(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The sum of the adjacent faces' normals, weighted by their areas; for vertices whose own normal is zero.
std::vector<Vec3> face_normals(const aiMesh& mesh) {
  std::vector<Vec3> sums(mesh.mNumVertices);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const unsigned* corner = mesh.mFaces[f].mIndices;
    const Vec3 a = vec3(mesh.mVertices[corner[0]]);
    const Vec3 area = cross(vec3(mesh.mVertices[corner[1]]) - a, vec3(mesh.mVertices[corner[2]]) - a);
    for (int i = 0; i < 3; ++i) sums[corner[i]] += area;
  }
  return sums;
}

// A unit tangent perpendicular to `normal`, and the handedness of the bitangent, which points up the texture.
std::array<float, 4> import_tangent(const aiMesh& mesh, unsigned i, Vec3 normal) {
  Vec3 tangent;
  float handedness = 1;
  if (mesh.HasTangentsAndBitangents()) {
    const Vec3 raw = vec3(mesh.mTangents[i]);
    tangent = normalise(raw - normal * dot(raw, normal));
    handedness = dot(cross(normal, tangent), vec3(mesh.mBitangents[i])) < 0 ? -1.0f : 1.0f;
  }
  if (!is_finite(tangent) || length(tangent) < 0.5)
    tangent = frame_about(normal).x;  // no or folded texture coordinates
  const auto [x, y, z] = single(tangent);
  return {x, y, z, handedness};
}

// A vertex as its bits: equal where every bit is.
using VertexBits = std::array<std::uint32_t, sizeof(Vertex) / sizeof(std::uint32_t)>;
struct HashBits {
  std::size_t operator()(const VertexBits& bits) const {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(bits.data()), sizeof bits});
  }
};

std::vector<Vertex> import_vertices(const aiMesh& mesh, const std::string& where,
                                    std::vector<std::string>& warnings) {
  const std::vector<Vec3> fallback = face_normals(mesh);
  std::size_t zero_normals = 0;
  std::vector<Vertex> out(mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const Vec3 position = vec3(mesh.mVertices[i]),
               uv = mesh.HasTextureCoords(0) ? vec3(mesh.mTextureCoords[0][i]) : Vec3{};
    Vec3 normal = vec3(mesh.mNormals[i]);
    if (!is_finite(position)) invalid(where, "vertex " + std::to_string(i) + ": the position is not finite");
    if (!is_finite(normal)) invalid(where, "vertex " + std::to_string(i) + ": the normal is not finite");
    if (!is_finite(uv))
      invalid(where, "vertex " + std::to_string(i) + ": the texture coordinate is not finite");
    if (length(normal) < 1e-6) {
      ++zero_normals;
      normal = fallback[i];
    }
    normal = length(normal) > 0 ? normalise(normal) : Vec3{0, 0, 1};  // then all its triangles are degenerate
    out[i] = {single(position),
              single(normal),
              import_tangent(mesh, i, normal),
              {static_cast<float>(uv.x), static_cast<float>(1 - uv.y)}};  // Assimp's v points up
  }
  if (zero_normals > 0) {
    warnings.push_back(where + ": " + std::to_string(zero_normals) +
                       " vertices without a normal take that of their faces");
  }
  return out;
}

Mesh import_mesh(const aiMesh& mesh, const std::string& file, std::vector<std::string>& warnings) {
  Mesh out;
  out.name = valid_text(mesh.mName.C_Str());
  out.material = static_cast<int>(mesh.mMaterialIndex);
  const std::vector<Vertex> vertices = import_vertices(mesh, file + ": mesh \"" + out.name + "\"", warnings);
  std::unordered_map<VertexBits, std::uint32_t, HashBits> known;
  known.reserve(vertices.size());
  out.indices.reserve(std::size_t{3} * mesh.mNumFaces);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    for (int i = 0; i < 3; ++i) {
      const Vertex& vertex = vertices[mesh.mFaces[f].mIndices[i]];
      const auto [entry, fresh] = known.try_emplace(std::bit_cast<VertexBits>(vertex),
                                                    static_cast<std::uint32_t>(out.vertices.size()));
      if (fresh) out.vertices.push_back(vertex);
      out.indices.push_back(entry->second);
    }
  return out;
}

Mat4 matrix(const aiMatrix4x4& m) {
  Mat4 out;
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned j = 0; j < 4; ++j) out.m[i][j] = static_cast<double>(m[i][j]);
  return out;
}

// Assimp's node tree, and beside it, node by node, the glTF file's own, from which names, transforms, cameras
// and lights come.
class NodeReader {
 public:
  NodeReader(const std::vector<int>& mesh_of, std::string where, MeshFile& out)
      : mesh_of_(mesh_of), where_(std::move(where)), out_(out) {}

  void add(const aiNode& node, int parent) {
    const int self =
        append(node, {valid_text(node.mName.C_Str()), parent, matrix(node.mTransformation), {}, -1, -1});
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], self);
  }

  void add_gltf(const aiNode& root, const GltfDocument& document) {
    if (document.roots.size() == 1) return add_gltf(root, document, document.roots[0], -1);
    add_gltf_children(root, document, document.roots, -1);  // Assimp invents a parent for several roots
  }

 private:
  int append(const aiNode& node, MeshNode entry) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (const int mesh = mesh_of_[node.mMeshes[i]]; mesh >= 0) entry.meshes.push_back(mesh);
    out_.nodes.push_back(std::move(entry));
    return static_cast<int>(out_.nodes.size()) - 1;
  }

  void add_gltf(const aiNode& node, const GltfDocument& document, int index, int parent) {
    const GltfNode& source = document.nodes[index];
    const int self = append(node, {source.name, parent, source.local, {}, source.camera, source.light});
    add_gltf_children(node, document, source.children, self);
  }

  void add_gltf_children(const aiNode& node, const GltfDocument& document, const std::vector<int>& children,
                         int parent) {
    if (node.mNumChildren != children.size()) {
      throw Error(ErrorCode::mesh_unreadable, where_ + ": the node tree is not understood below \"" +
                                                  std::string(node.mName.C_Str()) +
                                                  "\"; export the file again");
    }
    for (std::size_t i = 0; i < children.size(); ++i)
      add_gltf(*node.mChildren[i], document, children[i], parent);
  }

  const std::vector<int>& mesh_of_;
  std::string where_;
  MeshFile& out_;
};

const aiScene& read_scene(Assimp::Importer& importer, const fs::path& path) {
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, crease_deg);
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (!scene) throw Error(ErrorCode::mesh_unreadable, path.string() + ": " + importer.GetErrorString());
  if (!scene->mRootNode) throw Error(ErrorCode::mesh_invalid, path.string() + ": the file is empty");
  return *scene;
}

void import_materials(const aiScene& scene, const fs::path& path, MeshFormat format,
                      const GltfDocument& document, TexturePool& textures, MeshFile& out) {
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    Material material =
        import_material(scene, *scene.mMaterials[i], format, path.parent_path(), textures, out.warnings);
    if (const auto found = document.specular.find(material.name); found != document.specular.end()) {
      material.specular = found->second;
    }
    out.materials.push_back(std::move(material));
  }
}

void warn_about_missing_libraries(const fs::path& path, std::vector<std::string>& warnings) {
  for (const fs::path& library : material_libraries(path)) {
    if (!fs::is_regular_file(library)) {
      warnings.push_back(path.string() + ": the material library " + library.filename().string() +
                         " is missing");
    }
  }
}

}  // namespace

MeshFormat mesh_format(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".gltf" || extension == ".glb") return MeshFormat::gltf;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  throw Error(
      ErrorCode::mesh_unreadable,
      path.string() + ": meshes are read from .gltf, .glb, .obj and .ply; convert this file to one of them");
}

MeshFile load_mesh_file(const fs::path& path, bool all_tangents, TexturePool& textures) {
  const MeshFormat format = mesh_format(path);
  if (!fs::is_regular_file(path)) {
    throw Error(ErrorCode::file_not_found,
                path.string() + ": the mesh file is missing; check the path in the scene JSON");
  }
  const GltfDocument document = format == MeshFormat::gltf ? read_gltf(path) : GltfDocument{};
  if (format == MeshFormat::ply) check_ply_file(path);
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path);
  complete_meshes(importer, format, all_tangents, path.string());

  MeshFile out;
  out.cameras = document.cameras;
  out.lights = document.lights;
  out.warnings = document.warnings;
  if (format == MeshFormat::obj) warn_about_missing_libraries(path, out.warnings);
  import_materials(scene, path, format, document, textures, out);
  std::vector<int> mesh_of(scene.mNumMeshes, -1);  // Assimp's index to ours: points and lines are left out
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (!has_triangles(*scene.mMeshes[i])) continue;
    mesh_of[i] = static_cast<int>(out.meshes.size());
    out.meshes.push_back(import_mesh(*scene.mMeshes[i], path.string(), out.warnings));
  }
  NodeReader nodes(mesh_of, path.string(), out);
  if (format == MeshFormat::gltf) {
    nodes.add_gltf(*scene.mRootNode, document);
  } else {
    nodes.add(*scene.mRootNode, -1);
  }
  return out;
}

}  // namespace vsgl::scene
