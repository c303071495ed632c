#include "artifact/header.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"

namespace vsgl::artifact {
namespace {

template <typename T>
T in_range(const ExrFile& file, const std::string& name, T value, T minimum, T maximum) {
  if (value >= minimum && value <= maximum) return value;
  std::ostringstream message;
  message << file.path << ": header attribute '" << name << "' is " << value << ", must be " << minimum
          << ".." << maximum << "; write the file again with the tool that makes it";
  throw Error(ErrorCode::invalid_data, message.str());
}

// 'a' or 'b'
std::string listed(const std::vector<std::string>& kinds) {
  std::string text;
  for (const std::string& kind : kinds) text += (text.empty() ? "'" : " or '") + kind + "'";
  return text;
}

}  // namespace

ExrPart make_part(const std::string& name, const std::string& kind, const Provenance& provenance) {
  // Files of one name in different folders are told apart as a.exr, a.exr#2, ...
  nlohmann::ordered_json inputs = nlohmann::ordered_json::object();
  for (const Provenance::Input& input : provenance.inputs) {
    std::string key = input.name;
    for (int n = 2; inputs.contains(key); ++n) key = input.name + "#" + std::to_string(n);
    inputs[key] = input.sha256;
  }
  ExrPart part;
  part.name = name;
  part.attributes = {
      {"vsgl.schema", kind},
      {"vsgl.version", kSchemaVersion},
      {"vsgl.tool", provenance.tool},
      {"vsgl.tool_version", provenance.tool_version},
      {"vsgl.command", provenance.command_line},
      {"vsgl.seed", std::to_string(provenance.seed)},  // text: 64 bits
      {"vsgl.inputs", inputs.dump()},
  };
  return part;
}

void write_parts(const std::filesystem::path& path, std::vector<ExrPart> parts) {
  write_exr(path, ExrFile{std::move(parts), path.string()});
}

ExrFile read_artifact(const std::filesystem::path& path, const std::vector<std::string>& kinds) {
  ExrFile file = read_exr(path);
  std::vector<std::string> allowed = kinds;
  for (const ExrPart& part : file.parts) {
    const auto it = part.attributes.find("vsgl.schema");
    const auto* schema = it == part.attributes.end() ? nullptr : std::get_if<std::string>(&it->second);
    if (!schema || std::find(allowed.begin(), allowed.end(), *schema) == allowed.end())
      throw Error(ErrorCode::wrong_schema,
                  file.path + ": is " + (schema ? "a '" + *schema + "' file" : "no file of ours") + ", but " +
                      listed(allowed) + " is needed; check which file goes with which flag");
    allowed = {*schema};
    const int version = int_attribute(file, part, "vsgl.version");
    if (version != kSchemaVersion)
      throw Error(ErrorCode::wrong_schema, file.path + ": '" + *schema + "' version " +
                                               std::to_string(version) + ", but this tool reads version " +
                                               std::to_string(kSchemaVersion) +
                                               "; write the file again with tools of the same release");
  }
  return file;
}

std::string kind_of(const ExrFile& file) {
  return string_attribute(file, file.parts.front(), "vsgl.schema");
}

const ExrPart& only_part(const ExrFile& file) {
  if (file.parts.size() == 1) return file.parts.front();
  throw Error(ErrorCode::missing_part,
              file.path + ": has " + std::to_string(file.parts.size()) +
                  " parts instead of one; write the file again with the tool that makes it");
}

int int_in(const ExrFile& file, const ExrPart& part, const std::string& name, int minimum, int maximum) {
  return in_range(file, name, int_attribute(file, part, name), minimum, maximum);
}
double double_in(const ExrFile& file, const ExrPart& part, const std::string& name, double minimum,
                 double maximum) {
  return in_range(file, name, double_attribute(file, part, name), minimum, maximum);
}
Vec3 finite_vec3(const ExrFile& file, const ExrPart& part, const std::string& name) {
  const Vec3 v = to_vec3(vec3_attribute(file, part, name));
  if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) return v;
  throw Error(ErrorCode::non_finite, file.path + ": header attribute '" + name +
                                         "' is not finite; write the file again with the tool that makes it");
}
Vec3 unit_vec3(const ExrFile& file, const ExrPart& part, const std::string& name) {
  const Vec3 v = finite_vec3(file, part, name);
  if (std::abs(length(v) - 1) <= 1e-3) return v;
  throw Error(ErrorCode::invalid_data, file.path + ": header attribute '" + name +
                                           "' is no unit vector (length " + std::to_string(length(v)) +
                                           "); write the file again with the tool that makes it");
}

}  // namespace vsgl::artifact
