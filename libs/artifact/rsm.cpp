#include <algorithm>
#include <limits>
#include <span>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

using interop::Moments;
constexpr Field kMoments[] = {
    {"flux", "RGB", offsetof(Moments, flux), Range::non_negative},
    {"power_diffuse", "RGB", offsetof(Moments, power_diffuse), Range::non_negative},
    {"weight", "V", offsetof(Moments, weight), Range::non_negative},
    {"position", "XYZ", offsetof(Moments, position)},
    {"spread", "V", offsetof(Moments, spread), Range::non_negative},
    {"lobe_diffuse", "XYZ", offsetof(Moments, diffuse_mean)},
    {"lobe_diffuse", "Q", offsetof(Moments, diffuse_deficit), Range::unit_interval},
    {"normal_moment", "XYZ", offsetof(Moments, normal_mean)},
    {"normal_moment", "Q", offsetof(Moments, normal_deficit), Range::unit_interval},
    {"power_specular", "RGB", offsetof(Moments, power_specular), Range::non_negative, true},
    {"lobe_specular", "XYZ", offsetof(Moments, specular_mean), Range::any, true},
    {"lobe_specular", "Q", offsetof(Moments, specular_deficit), Range::unit_interval, true},
};

constexpr std::pair<LightType, const char*> kLightTypes[] = {
    {LightType::spot, "spot"}, {LightType::directional, "directional"}, {LightType::point, "point"}};

std::string type_name(LightType type) {
  for (const auto& [value, name] : kLightTypes)
    if (value == type) return name;
  throw Error(ErrorCode::internal, "unknown LightType");
}
LightType type_of(const ExrFile& file, const ExrPart& part) {
  const std::string type = string_attribute(file, part, "light.type");
  for (const auto& [value, name] : kLightTypes)
    if (type == name) return value;
  throw Error(ErrorCode::invalid_data, file.path + ": header attribute 'light.type' is '" + type +
                                           "', must be spot, directional or point; bake the file again");
}

void put_light(const LightSource& light, ExrPart& part) {
  part.attributes.insert({
      {"light.name", light.name},
      {"light.type", type_name(light.type)},
      {"light.position", to_array(light.position)},
      {"light.right", to_array(light.right)},
      {"light.up", to_array(light.up)},
      {"light.forward", to_array(light.forward)},
      {"light.extent_x", light.extent_x},
      {"light.extent_y", light.extent_y},
      {"light.intensity", to_array(light.intensity)},
      {"light.cos_inner", light.cos_inner},
      {"light.cos_outer", light.cos_outer},
  });
}

LightSource get_light(const ExrFile& file, const ExrPart& part) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  LightSource light;
  light.name = string_attribute(file, part, "light.name");
  light.type = type_of(file, part);
  light.position = finite_vec3(file, part, "light.position");
  light.right = unit_vec3(file, part, "light.right");
  light.up = unit_vec3(file, part, "light.up");
  light.forward = unit_vec3(file, part, "light.forward");
  light.extent_x = double_in(file, part, "light.extent_x", 0, kHuge);
  light.extent_y = double_in(file, part, "light.extent_y", 0, kHuge);
  light.intensity = finite_vec3(file, part, "light.intensity");
  light.cos_inner = double_in(file, part, "light.cos_inner", -1, 1);
  light.cos_outer = double_in(file, part, "light.cos_outer", -1, 1);
  return light;
}

ExrPart make_layer_part(const std::string& name, const Rsm& rsm, const RsmLayer& layer,
                        const Provenance& provenance) {
  ExrPart part = make_part(name, "rsm", provenance);
  part.attributes["anchor"] = to_array(rsm.anchor);
  part.attributes["scene_radius"] = rsm.scene_radius;
  part.attributes["rsm_width"] = rsm.width;
  part.attributes["rsm_height"] = rsm.height;
  put_light(layer.light, part);
  return part;
}

constexpr std::string_view kSurfaceSuffix = ".surface";

std::vector<Moments> unpack_pyramid(const ExrFile& file, const ExrPart& part, int size, bool with_specular) {
  std::vector<Moments> pyramid(pyramid_texels(size));
  for (int l = 0; l < pyramid_levels(size); ++l) {
    const int side = size >> l;
    const std::span texels(pyramid.data() + pyramid_offset(size, l),
                           static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    unpack(kMoments, Structs(texels), file, part, static_cast<std::size_t>(l), side, side, with_specular);
  }
  return pyramid;
}

RsmLayer read_layer(const ExrFile& file, const ExrPart& part, int size) {
  const ExrPart& surface = file.part(part.name + std::string(kSurfaceSuffix));
  const bool with_specular = has_specular_channels(kMoments, part);
  if (with_specular != has_specular_channels(surface_fields(), surface))
    throw Error(ErrorCode::missing_channel, file.path + ": only one of the parts '" + part.name + "' and '" +
                                                surface.name +
                                                "' has specular channels; bake the file again");
  RsmLayer layer;
  layer.name = part.name;
  layer.light = get_light(file, part);
  layer.pyramid = unpack_pyramid(file, part, size, with_specular);
  layer.surface = unpack_surfaces(file, surface, size, size);
  return layer;
}

}  // namespace

bool Rsm::has_specular() const {
  return std::any_of(layers.begin(), layers.end(), [](const RsmLayer& layer) {
    return std::any_of(layer.surface.begin(), layer.surface.end(),
                       [](const auto& s) { return s.ndf != interop::NDF_NONE; });
  });
}

void write(const std::filesystem::path& path, const Rsm& rsm, const Provenance& provenance) {
  const bool with_specular = rsm.has_specular();
  std::vector<ExrPart> parts;
  for (const RsmLayer& layer : rsm.layers) {
    if (layer.pyramid.size() != pyramid_texels(rsm.size))
      throw Error(ErrorCode::internal, "write(Rsm): incomplete pyramid of '" + layer.name + "'");
    ExrPart part = make_layer_part(layer.name, rsm, layer, provenance);
    part.mipmap = true;
    for (int l = 0; l < pyramid_levels(rsm.size); ++l) {
      const int side = rsm.size >> l;
      const std::span texels(layer.pyramid.data() + pyramid_offset(rsm.size, l),
                             static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
      part.levels.push_back(pack(kMoments, Structs(texels), side, side, with_specular));
    }
    parts.push_back(std::move(part));
    ExrPart surface = make_layer_part(layer.name + std::string(kSurfaceSuffix), rsm, layer, provenance);
    surface.levels = {pack_surfaces(layer.surface, rsm.size, rsm.size, with_specular)};
    parts.push_back(std::move(surface));
  }
  write_parts(path, std::move(parts));
}

Rsm read_rsm(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "rsm");
  const ExrPart& first = file.parts.front();
  Rsm out;
  out.size = first.width();
  if (!is_power_of_two(out.size) || out.size != first.height())
    throw Error(ErrorCode::wrong_size,
                file.path + ": the RSM has " + std::to_string(first.width()) + "x" +
                    std::to_string(first.height()) +
                    " texels, but a square of a power of two is needed; bake the file again");
  out.width = int_in(file, first, "rsm_width", 1, out.size);
  out.height = int_in(file, first, "rsm_height", 1, out.size);
  out.anchor = finite_vec3(file, first, "anchor");
  out.scene_radius = double_in(file, first, "scene_radius", 0, std::numeric_limits<double>::max());
  for (const ExrPart& part : file.parts)
    if (!part.name.ends_with(kSurfaceSuffix)) out.layers.push_back(read_layer(file, part, out.size));
  if (out.layers.empty())
    throw Error(ErrorCode::missing_part,
                file.path + ": no layer beside '" + first.name + "'; bake the file again");
  return out;
}

}  // namespace vsgl
