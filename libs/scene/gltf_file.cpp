#include "scene/gltf_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t max_int = 0x7FFFFFFF;

[[noreturn]] void broken(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::mesh_unreadable, where + ": " + what);
}

std::uint32_t read_u32(const std::string& bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);  // glTF and all supported hosts are little-endian
  return value;
}

struct Container {
  std::string json;
  std::optional<std::string> binary;  // the BIN chunk of a .glb
};

// glTF 2.0, "GLB File Format Specification".
Container split_glb(const std::string& bytes, const std::string& file) {
  constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  if (bytes.size() < 20 || bytes.compare(0, 4, "glTF") != 0)
    broken(file, "not a .glb file: its header is damaged");
  if (read_u32(bytes, 4) != 2) {
    broken(file, "GLB version " + std::to_string(read_u32(bytes, 4)) +
                     " is not supported; convert the file to glTF 2.0");
  }
  if (read_u32(bytes, 8) > bytes.size()) {
    broken(file, "truncated: " + std::to_string(bytes.size()) + " of " + std::to_string(read_u32(bytes, 8)) +
                     " bytes");
  }
  Container out;
  for (std::size_t offset = 12; offset + 8 <= bytes.size();) {
    const std::size_t length = read_u32(bytes, offset);
    const std::uint32_t type = read_u32(bytes, offset + 4);
    offset += 8;
    if (length > bytes.size() - offset) broken(file, "a chunk reaches past the end of the file");
    if (type == json_chunk && out.json.empty()) out.json = bytes.substr(offset, length);
    if (type == binary_chunk && !out.binary) out.binary = bytes.substr(offset, length);
    offset += length;
  }
  if (out.json.empty()) broken(file, "the .glb has no JSON chunk");
  return out;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return -1;
}

std::string decode_base64(const std::string& text, const std::string& where) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = base64_digit(c);
    if (digit < 0) broken(where, "the data URI holds a character that is not base64");
    bits = (bits << 6) | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out += static_cast<char>((bits >> count) & 0xFF);
    }
  }
  return out;
}

std::vector<JsonValue> items(const JsonValue& object, const std::string& key) {
  const auto list = object.find(key);
  return list ? list->array() : std::vector<JsonValue>{};
}

std::int64_t optional_integer(const JsonValue& object, const std::string& key, std::int64_t fallback) {
  const auto value = object.find(key);
  return value ? value->integer(0, max_int) : fallback;
}

// An index into an array of `count` items.
std::size_t index(const JsonValue& value, std::size_t count) {
  const auto out = static_cast<std::size_t>(value.integer(0, max_int));
  if (out >= count)
    broken(value.where(), "index " + std::to_string(out) + " of " + std::to_string(count) + " items");
  return out;
}

void read_buffer(const JsonValue& buffer, const fs::path& folder, const std::optional<std::string>& binary,
                 GltfFile& file) {
  const auto length = static_cast<std::size_t>(buffer.at("byteLength").integer(0, max_int));
  std::string bytes;
  if (const auto uri_value = buffer.find("uri")) {
    const std::string uri = uri_value->string();
    if (uri.starts_with("data:")) {
      const auto comma = uri.find(";base64,");
      if (comma == std::string::npos) broken(uri_value->where(), "a data URI must be base64");
      bytes = decode_base64(uri.substr(comma + 8), uri_value->where());
    } else {
      const fs::path path = folder / decode_percent(uri);
      if (!fs::is_regular_file(path)) {
        broken(buffer.where(), "the buffer file \"" + uri + "\" is missing; it belongs beside the glTF file");
      }
      bytes = read_text(path);
      file.buffer_files.push_back(path);
    }
  } else if (file.buffers.empty() && binary) {
    bytes = *binary;
  } else {
    broken(buffer.where(), "the buffer has neither a uri nor a binary chunk");
  }
  if (bytes.size() < length) {
    broken(buffer.where(), "the buffer holds " + std::to_string(bytes.size()) + " bytes, byteLength says " +
                               std::to_string(length));
  }
  bytes.resize(length);
  file.buffers.push_back(std::move(bytes));
}

struct View {
  std::size_t buffer, offset, length, stride;  // stride 0: tightly packed
};

struct Accessor {
  std::optional<View> view;  // none: all zero
  std::size_t offset = 0, count = 0, stride = 0;
  int component_type = 0;
  std::size_t components = 1;  // 3 for VEC3
  bool sparse = false;
};

std::size_t component_size(const JsonValue& type) {
  switch (type.integer(0, max_int)) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      broken(type.where(), "unknown componentType");
  }
}

std::size_t component_count(const std::string& type) {
  static const std::vector<std::pair<std::string, std::size_t>> counts{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  return std::find_if(counts.begin(), counts.end(), [&](const auto& entry) { return entry.first == type; })
      ->second;
}

// The checks of buffers, views and accessors, and what the meshes make of them.
class Checker {
 public:
  explicit Checker(const GltfFile& file) : file_(file) {
    for (const JsonValue& view : items(file.json, "bufferViews")) views_.push_back(read_view(view));
    for (const JsonValue& accessor : items(file.json, "accessors"))
      accessors_.push_back(read_accessor(accessor));
    for (const JsonValue& mesh : items(file.json, "meshes"))
      for (const JsonValue& primitive : mesh.at("primitives").array(1)) check_primitive(primitive);
  }

 private:
  View read_view(const JsonValue& value) const {
    View view;
    view.buffer = index(value.at("buffer"), file_.buffers.size());
    view.offset = static_cast<std::size_t>(optional_integer(value, "byteOffset", 0));
    view.length = static_cast<std::size_t>(value.at("byteLength").integer(1, max_int));
    view.stride = static_cast<std::size_t>(optional_integer(value, "byteStride", 0));
    if (view.offset + view.length > file_.buffers[view.buffer].size()) {
      broken(value.where(), "the view reaches past the end of its buffer");
    }
    return view;
  }

  Accessor read_accessor(const JsonValue& value) const {
    Accessor accessor;
    accessor.count = static_cast<std::size_t>(value.at("count").integer(1, max_int));
    accessor.offset = static_cast<std::size_t>(optional_integer(value, "byteOffset", 0));
    accessor.component_type = static_cast<int>(value.at("componentType").integer(0, max_int));
    const std::string type =
        value.at("type").choice({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
    accessor.components = component_count(type);
    const std::size_t size = component_size(value.at("componentType")) * accessor.components;
    const auto view = value.find("bufferView");
    constexpr std::size_t most_zeros =
        10000000;  // no data backs them, so that a short file could ask for all memory
    if (!view && accessor.count > most_zeros) broken(value.where(), "too many values without a bufferView");
    if (view) {
      accessor.view = views_[index(*view, views_.size())];
      accessor.stride = accessor.view->stride > 0 ? accessor.view->stride : size;
      check_extent(value, *accessor.view, accessor.offset + accessor.stride * (accessor.count - 1) + size);
    }
    if (const auto sparse = value.find("sparse")) {
      accessor.sparse = true;
      check_sparse(*sparse, accessor.count, size);
    }
    return accessor;
  }

  static void check_extent(const JsonValue& accessor, const View& view, std::size_t end) {
    if (end > view.length) {
      broken(accessor.where(), "the accessor ends at byte " + std::to_string(end) + " of a view of " +
                                   std::to_string(view.length) + " bytes");
    }
  }

  void check_sparse(const JsonValue& sparse, std::size_t full_count, std::size_t value_size) const {
    const auto count =
        static_cast<std::size_t>(sparse.at("count").integer(1, static_cast<std::int64_t>(full_count)));
    const JsonValue indices = sparse.at("indices"), values = sparse.at("values");
    const auto check = [&](const JsonValue& part, std::size_t size) {
      const View& view = views_[index(part.at("bufferView"), views_.size())];
      const auto offset = static_cast<std::size_t>(optional_integer(part, "byteOffset", 0));
      check_extent(part, view, offset + count * size);
      return Accessor{view, offset, count, size, 0, 1, false};
    };
    const std::size_t index_size = component_size(indices.at("componentType"));
    Accessor positions = check(indices, index_size);
    positions.component_type = static_cast<int>(indices.at("componentType").integer(0, max_int));
    check_indices(indices, positions, full_count);
    check(values, value_size);
  }

  // The attributes that are read must have the type that the specification gives them.
  static void check_type(const JsonValue& attribute, const std::string& name, const Accessor& accessor) {
    constexpr int floats = 5126;
    const bool vector = name == "POSITION" || name == "NORMAL", tangent = name == "TANGENT";
    const bool coordinate = name.starts_with("TEXCOORD_");
    const bool wrong = ((vector && accessor.components != 3) || (tangent && accessor.components != 4) ||
                        (coordinate && accessor.components != 2)) ||
                       ((vector || tangent) && accessor.component_type != floats);
    if (wrong) broken(attribute.where(), "the accessor has the wrong type for " + name);
  }

  void check_primitive(const JsonValue& primitive) const {
    const JsonValue attributes = primitive.at("attributes");
    const Accessor& position = accessor_of(attributes.at("POSITION"));
    for (const std::string& name : attributes.keys()) {
      const JsonValue attribute = attributes.at(name);
      const Accessor& accessor = accessor_of(attribute);
      check_type(attribute, name, accessor);
      if (accessor.count != position.count) {
        broken(attribute.where(), std::to_string(accessor.count) + " values for " +
                                      std::to_string(position.count) + " vertices");
      }
    }
    if (const auto indices = primitive.find("indices")) {
      const Accessor& accessor = accessor_of(*indices);
      if (accessor.sparse)
        broken(indices->where(), "sparse vertex indices are not supported; write them out in full");
      check_indices(*indices, accessor, position.count);
    }
  }

  const Accessor& accessor_of(const JsonValue& value) const {
    return accessors_[index(value, accessors_.size())];
  }

  // Every value must be below `limit`.
  void check_indices(const JsonValue& where, const Accessor& accessor, std::size_t limit) const {
    if (accessor.components != 1 || (accessor.component_type != 5121 && accessor.component_type != 5123 &&
                                     accessor.component_type != 5125)) {
      broken(where.where(), "indices must be unsigned scalars");
    }
    if (!accessor.view) return;
    const std::size_t size = accessor.component_type == 5121 ? 1 : accessor.component_type == 5123 ? 2 : 4;
    const char* bytes = file_.buffers[accessor.view->buffer].data() + accessor.view->offset + accessor.offset;
    for (std::size_t i = 0; i < accessor.count; ++i) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes + i * accessor.stride, size);
      if (value >= limit) {
        broken(where.where(), "index " + std::to_string(value) + " at place " + std::to_string(i) +
                                  ", but there are only " + std::to_string(limit) + " vertices");
      }
    }
  }

  const GltfFile& file_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
};

// Each node has one parent at most, and no chain is so deep that a recursive reader would run out of stack.
void check_nodes(const JsonValue& json) {
  const auto nodes = items(json, "nodes");
  constexpr int max_depth = 1000;
  std::vector<int> parent(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const JsonValue& child : items(nodes[i], "children")) {
      const std::size_t c = index(child, nodes.size());
      if (parent[c] >= 0) broken(child.where(), "node " + std::to_string(c) + " is a child twice");
      parent[c] = static_cast<int>(i);
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    int depth = 0;
    for (int node = parent[i]; node >= 0; node = parent[node]) {
      if (++depth > max_depth)
        broken(nodes[i].where(), "the nodes form a cycle or are nested over 1000 levels deep");
    }
  }
}

void check_header(const JsonValue& json) {
  const std::string version = json.at("asset").at("version").string();
  if (!version.starts_with("2.")) {
    broken(json.where(), "glTF version " + version + " is not supported; convert the file to glTF 2.0");
  }
  static const std::vector<std::string> supported{"KHR_lights_punctual", "KHR_materials_specular"};
  for (const JsonValue& name : items(json, "extensionsRequired")) {
    if (std::find(supported.begin(), supported.end(), name.string()) == supported.end()) {
      broken(name.where(),
             "the file needs the extension " + name.string() + ", which is not supported; export it without");
    }
  }
}

}  // namespace

std::string decode_percent(const std::string& uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() &&
                        std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                        std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    if (escape) {
      out += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

GltfFile read_gltf_file(const fs::path& path) {
  const std::string bytes = read_text(path);
  const Container container = bytes.starts_with("glTF") || path.extension() == ".glb"
                                  ? split_glb(bytes, path.string())
                                  : Container{bytes, std::nullopt};
  GltfFile file{JsonValue::parse_text(container.json, path.string()), {}, {}};
  check_header(file.json);
  for (const JsonValue& buffer : items(file.json, "buffers")) {
    read_buffer(buffer, path.parent_path(), container.binary, file);
  }
  Checker check(file);
  check_nodes(file.json);
  return file;
}

}  // namespace vsgl::scene
