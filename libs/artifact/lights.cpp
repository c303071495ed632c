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

using interop::Light;
constexpr Field kFields[] = {
    {"position", "XYZ", offsetof(Light, position)},
    {"variance", "V", offsetof(Light, variance), Range::non_negative},
    {"power_diffuse", "RGB", offsetof(Light, power_diffuse), Range::non_negative},
    {"axis_diffuse", "XYZ", offsetof(Light, diffuse_axis)},
    {"sharpness_diffuse", "V", offsetof(Light, diffuse_sharpness), Range::sharpness},
    {"power_specular", "RGB", offsetof(Light, power_specular), Range::non_negative, true},
    {"axis_specular", "XYZ", offsetof(Light, specular_axis), Range::any, true},
    {"sharpness_specular", "V", offsetof(Light, specular_sharpness), Range::sharpness, true},
    {"alpha", "V", offsetof(Light, alpha), Range::unit_interval, true},
    {"ndf", "I", offsetof(Light, ndf), Range::ndf, true},
    {"normal", "XYZ", offsetof(Light, normal)},
    {"normal_deficit", "V", offsetof(Light, normal_deficit), Range::unit_interval},
    {"shading_normal", "XYZ", offsetof(Light, shading_normal)},
    {"incident", "XYZ", offsetof(Light, incident)},
    {"origin", "XYZ", offsetof(Light, origin)},
    {"level", "V", offsetof(Light, level), Range::non_negative},
    {"texel", "I", offsetof(Light, texel)},
    {"layer", "I", offsetof(Light, layer)},
    {"lobe_variance", "V", offsetof(Light, lobe_variance), Range::non_negative, true},
    {"shading_deficit", "V", offsetof(Light, shading_deficit), Range::non_negative, true},
    {"children", "I", offsetof(Light, children)},
};

constexpr const char *kKind = "lights.kind", *kEnvironment = "environment";
using interop::Chain;
constexpr Field kChainFields[] = {
    {"x", "I", offsetof(Chain, x)},
    {"y", "I", offsetof(Chain, y)},
    {"layer", "I", offsetof(Chain, layer)},
};
constexpr const char *kLightsPart = "lights", *kChainsPart = "chains";  // of a file with both

// Rows of kRow lights, uncompressed: a row a light or zip would take over ten times longer to write
// (docs/sampling.md). An EXR has at least one pixel.
constexpr std::size_t kRow = 1024;
struct ImageSize {
  int width, height;
};
ImageSize image_size(std::size_t lights) {
  const std::size_t width = std::clamp<std::size_t>(lights, 1, kRow);
  return {static_cast<int>(width), static_cast<int>(std::max<std::size_t>((lights + width - 1) / width, 1))};
}

// A lobe without power has no axis.
void check_directions(const ExrFile& file, const ExrPart& part, const std::vector<Light>& lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    check_direction(file, part, "axis_diffuse", i, light.diffuse_axis, Direction::unit_or_zero);
    check_direction(file, part, "axis_specular", i, light.specular_axis, Direction::unit_or_zero);
    check_direction(file, part, "normal", i, light.normal, Direction::unit);
    check_direction(file, part, "shading_normal", i, light.shading_normal, Direction::unit);
    check_direction(file, part, "incident", i, light.incident, Direction::unit);
    if (light.ndf != interop::NDF_NONE && light.alpha < interop::ALPHA_MIN)
      fail_at(file, part, "alpha.V", i, std::to_string(light.alpha) + " is not 1e-3..1");
  }
}

// Levels follow one another: the children of a level's lights, four each, in order.
std::vector<std::uint32_t> tree_levels(const ExrFile& file, const ExrPart& part,
                                       const std::vector<Light>& lights) {
  std::vector<std::uint32_t> levels{0};
  std::uint32_t end = lights.empty() ? 0 : 1;
  for (std::uint32_t i = 0, next = end; i < lights.size(); ++i) {
    if (i == end) {
      if (next == end) fail_at(file, part, "children.I", i, "no light has this one among its children");
      levels.push_back(end);
      end = next;
    }
    if (lights[i].children == 0) continue;
    if (lights[i].children != next || next + 4 > lights.size())
      fail_at(file, part, "children.I", i, "children do not follow one another");
    next += 4;
  }
  levels.push_back(end);
  return levels;
}

// The attribute is there for environment lights alone.
LightsKind read_kind(const ExrFile& file, const ExrPart& part) {
  if (!part.attributes.contains(kKind)) return LightsKind::points;
  const std::string kind = string_attribute(file, part, kKind);
  if (kind == kEnvironment) return LightsKind::environment;
  throw Error(ErrorCode::invalid_data, file.path + ": attribute " + kKind + ": \"" + kind +
                                           "\" is not environment; write the lights again");
}

void check_list(const ExrFile& file, const ExrPart& part, const std::vector<Light>& lights) {
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].children != 0) fail_at(file, part, "children.I", i, "children in a list");
}

ExrPart chains_part(const Chains& chains, const Provenance& provenance) {
  ExrPart part = make_part(kChainsPart, "lights", provenance);
  part.attributes["chains.count"] = static_cast<int>(chains.states.size());
  part.attributes["chains.steps"] = chains.steps;
  const auto [width, height] = image_size(chains.states.size());
  part.levels = {pack(kChainFields, Structs(std::span(chains.states)), width, height, false)};
  return part;
}

Chains read_chains(const ExrFile& file, const ExrPart& part) {
  constexpr int kLargest = std::numeric_limits<int>::max();
  const int count = int_in(file, part, "chains.count", 1, kLargest);
  const auto [width, height] = image_size(static_cast<std::size_t>(count));
  Chains out;
  out.steps = int_in(file, part, "chains.steps", 0, kLargest);
  out.states.resize(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  unpack(kChainFields, Structs(std::span(out.states)), file, part, 0, width, height, false);
  out.states.resize(static_cast<std::size_t>(count));
  return out;
}

}  // namespace

// A cluster may hold specular power although the point that represents it has no specular lobe.
bool Lights::has_specular() const {
  return std::any_of(lights.begin(), lights.end(), [](const Light& light) {
    const interop::vec3& power = light.power_specular;
    return light.ndf != interop::NDF_NONE || power.x + power.y + power.z > 0;
  });
}

std::vector<std::uint32_t> level_nodes(std::span<const Light> lights, std::span<const std::uint32_t> levels,
                                       std::size_t level) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < levels[level + 1]; ++i)
    if (i >= levels[level] || lights[i].children == 0) nodes.push_back(i);
  return nodes;
}

void write(const std::filesystem::path& path, const Lights& lights, const Provenance& provenance) {
  ExrPart part = make_part("", "lights", provenance);
  part.attributes["anchor"] = to_array(lights.anchor);
  part.attributes["scene_radius"] = lights.scene_radius;
  part.attributes["lights.method"] = lights.method;
  part.attributes["lights.requested"] = lights.requested;
  part.attributes["lights.count"] = static_cast<int>(lights.lights.size());
  part.attributes["lights.tree"] = lights.is_tree() ? 1 : 0;
  if (lights.kind == LightsKind::environment) part.attributes[kKind] = std::string(kEnvironment);
  const auto [width, height] = image_size(lights.lights.size());
  part.levels = {pack(kFields, Structs(std::span(lights.lights)), width, height, lights.has_specular())};
  std::vector<ExrPart> parts{std::move(part)};
  if (!lights.chains.states.empty()) {
    parts.front().name = kLightsPart;
    parts.push_back(chains_part(lights.chains, provenance));
  }
  write_parts(path, std::move(parts));
}

Lights read_lights(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "lights");
  const bool with_chains = file.parts.size() == 2 && file.parts.back().name == kChainsPart;
  const ExrPart& part = with_chains ? file.part(kLightsPart) : only_part(file);
  Lights out;
  out.kind = read_kind(file, part);
  out.method = string_attribute(file, part, "lights.method");
  out.anchor = finite_vec3(file, part, "anchor");
  out.scene_radius = double_in(file, part, "scene_radius", 0, std::numeric_limits<double>::max());
  out.requested = int_in(file, part, "lights.requested", 0, std::numeric_limits<int>::max());
  const int count = int_in(file, part, "lights.count", 0, std::numeric_limits<int>::max());
  const bool with_specular = has_specular_channels(kFields, part);
  const bool tree = int_in(file, part, "lights.tree", 0, 1) == 1;
  const auto [width, height] = image_size(static_cast<std::size_t>(count));
  Light blank{};
  blank.alpha = 1;
  out.lights.assign(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()), blank);
  unpack(kFields, Structs(std::span(out.lights)), file, part, 0, width, height, with_specular);
  out.lights.resize(static_cast<std::size_t>(count));
  check_directions(file, part, out.lights);
  if (tree) {
    out.levels = tree_levels(file, part, out.lights);
  } else {
    check_list(file, part, out.lights);
  }
  if (with_chains) out.chains = read_chains(file, file.part(kChainsPart));
  return out;
}

}  // namespace vsgl
