#include "image/exr.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/error.h"

namespace vsgl {
namespace {

// "rsm.exr: part 'key', level 2, channel 'flux.R'"; what is unnamed or the only one is left out.
std::string where(const ExrFile& file, const ExrPart& part) {
  const std::string name = file.path.empty() ? "image" : file.path;
  return part.name.empty() ? name : name + ": part '" + part.name + "'";
}
std::string where(const ExrFile& file, const ExrPart& part, std::size_t level, const std::string& channel) {
  return where(file, part) + (part.levels.size() > 1 ? ", level " + std::to_string(level) : "") +
         ", channel '" + channel + "'";
}

template <typename T>
std::string names_of(const std::map<std::string, T>& items) {
  std::string out;
  for (const auto& [name, item] : items) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "none" : out;
}

const Plane& plane(const ExrFile& file, const ExrPart& part, std::size_t level, const std::string& name) {
  if (level >= part.levels.size())
    throw Error(ErrorCode::missing_part, where(file, part) + ": no mip level " + std::to_string(level) +
                                             " (has " + std::to_string(part.levels.size()) +
                                             "); bake the file again");
  const auto& channels = part.levels[level].channels;
  const auto it = channels.find(name);
  if (it == channels.end())
    throw Error(ErrorCode::missing_channel, where(file, part) + ": channel '" + name + "' is missing (has " +
                                                names_of(channels) +
                                                "); write the file again with the tool that makes it");
  return it->second;
}

template <typename T>
const std::vector<T>& typed_channel(const ExrFile& file, const ExrPart& part, std::size_t level,
                                    const std::string& name, const char* wanted, const char* found) {
  const auto* pixels = std::get_if<std::vector<T>>(&plane(file, part, level, name));
  if (!pixels)
    throw Error(ErrorCode::wrong_channel_type, where(file, part, level, name) + " is " + found +
                                                   " but must be " + wanted +
                                                   "; write the file again with the tool that makes it");
  return *pixels;
}

template <typename T>
T attribute(const ExrFile& file, const ExrPart& part, const std::string& name, const char* type) {
  const auto it = part.attributes.find(name);
  if (it == part.attributes.end())
    throw Error(ErrorCode::missing_attribute,
                where(file, part) + ": header attribute '" + name + "' (" + type +
                    ") is missing; write the file again with the tool that makes it");
  const T* value = std::get_if<T>(&it->second);
  if (!value)
    throw Error(ErrorCode::missing_attribute, where(file, part) + ": header attribute '" + name +
                                                  "' is not of type " + type +
                                                  "; write the file again with the tool that makes it");
  return *value;
}

void check_finite_attributes(const ExrFile& file, const ExrPart& part) {
  const auto finite = [](const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, double>) {
      return std::isfinite(value);
    } else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::string>) {
      return true;
    } else {
      return std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); });
    }
  };
  for (const auto& [name, value] : part.attributes)
    if (!std::visit(finite, value))
      throw Error(ErrorCode::non_finite,
                  where(file, part) + ": header attribute '" + name +
                      "' is not finite; write the file again with the tool that makes it");
}

}  // namespace

const ExrPart& ExrFile::part(const std::string& name) const {
  std::string there;
  for (const ExrPart& candidate : parts) {
    if (candidate.name == name) return candidate;
    there += (there.empty() ? "'" : ", '") + candidate.name + "'";
  }
  throw Error(ErrorCode::missing_part, path + ": part '" + name + "' is missing (has " + there +
                                           "); write the file again with the tool that makes it");
}

const std::vector<float>& float_channel(const ExrFile& file, const ExrPart& part, std::size_t level,
                                        const std::string& name) {
  return typed_channel<float>(file, part, level, name, "FLOAT", "UINT");
}
const std::vector<std::uint32_t>& uint_channel(const ExrFile& file, const ExrPart& part, std::size_t level,
                                               const std::string& name) {
  return typed_channel<std::uint32_t>(file, part, level, name, "UINT", "FLOAT");
}
bool has_channel(const ExrPart& part, const std::string& name) {
  return part.levels.front().channels.contains(name);
}

void check_finite(const ExrFile& file) {
  for (const ExrPart& part : file.parts) {
    check_finite_attributes(file, part);
    for (std::size_t l = 0; l < part.levels.size(); ++l)
      for (const auto& [name, plane] : part.levels[l].channels) {
        const auto* pixels = std::get_if<std::vector<float>>(&plane);
        if (!pixels) continue;
        const auto bad =
            std::find_if_not(pixels->begin(), pixels->end(), [](float v) { return std::isfinite(v); });
        if (bad == pixels->end()) continue;
        const auto index = bad - pixels->begin();
        const int width = part.levels[l].width;
        throw Error(ErrorCode::non_finite,
                    where(file, part, l, name) + ": " + std::to_string(*bad) + " at (" +
                        std::to_string(index % width) + "," + std::to_string(index / width) +
                        "); no artifact may hold NaN or infinity: find the stage that made it");
      }
  }
}

int int_attribute(const ExrFile& file, const ExrPart& part, const std::string& name) {
  return attribute<int>(file, part, name, "int");
}
double double_attribute(const ExrFile& file, const ExrPart& part, const std::string& name) {
  return attribute<double>(file, part, name, "double");
}
std::string string_attribute(const ExrFile& file, const ExrPart& part, const std::string& name) {
  return attribute<std::string>(file, part, name, "string");
}
std::array<double, 3> vec3_attribute(const ExrFile& file, const ExrPart& part, const std::string& name) {
  return attribute<std::array<double, 3>>(file, part, name, "v3d");
}
std::array<double, 16> matrix_attribute(const ExrFile& file, const ExrPart& part, const std::string& name) {
  return attribute<std::array<double, 16>>(file, part, name, "m44d");
}

}  // namespace vsgl
