#include "report/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "image/exposure.h"
#include "math/vec.h"

namespace vsgl::report {
namespace {

constexpr std::array<std::string_view, 2> kTriples = {"RGB", "XYZ"};
// What channels R, G and B without a layer's name are called together.
constexpr std::string_view kNameless = "RGB";

std::string channel_of(const std::string& layer, char component) {
  return layer == kNameless ? std::string(1, component) : layer + "." + component;
}
// The layer that a channel would belong to.
std::string layer_of(const std::string& channel) {
  if (channel.size() == 1) return std::string(kNameless);
  const bool dotted = channel.size() > 2 && channel[channel.size() - 2] == '.';
  return dotted ? channel.substr(0, channel.size() - 2) : "";
}

const PlaneValues* find_floats(const ExrPart& part, const std::string& channel) {
  const auto& channels = part.levels.front().channels;
  const auto it = channels.find(channel);
  return it == channels.end() ? nullptr : std::get_if<PlaneValues>(&it->second);
}

// The three channels of layer.RGB or layer.XYZ, or the single channel `layer`; empty when the part has none
// of them.
std::vector<const PlaneValues*> planes_of(const ExrPart& part, const std::string& layer) {
  if (const PlaneValues* grey = find_floats(part, layer)) return {grey};
  for (const std::string_view triple : kTriples) {
    std::vector<const PlaneValues*> planes;
    for (const char component : triple) planes.push_back(find_floats(part, channel_of(layer, component)));
    if (std::find(planes.begin(), planes.end(), nullptr) == planes.end()) return planes;
  }
  return {};
}

std::string prefix_of(const ExrFile& file, const ExrPart& part) {
  return file.parts.size() > 1 ? part.name + ": " : "";
}

struct Place {
  const ExrPart* part = nullptr;
  std::string layer;
};
std::optional<Place> find_layer(const ExrFile& file, const std::string& name) {
  for (const ExrPart& part : file.parts) {
    const std::string prefix = prefix_of(file, part);
    if (!name.starts_with(prefix)) continue;
    const std::string layer = name.substr(prefix.size());
    if (!planes_of(part, layer).empty()) return Place{&part, layer};
  }
  return std::nullopt;
}

// 0: `indirect`, 1: colour, 2: vector, 3: single channel.
int rank_of(const ExrPart& part, const std::string& layer) {
  if (layer == "indirect") return 0;
  if (find_floats(part, layer)) return 3;
  return find_floats(part, channel_of(layer, 'R')) ? 1 : 2;
}

// Layers of one part: each triple of channels as one, every other channel by itself.
std::vector<std::string> layers_of(const ExrPart& part) {
  std::vector<std::string> names;
  for (const auto& [channel, plane] : part.levels.front().channels) {
    const auto* values = std::get_if<PlaneValues>(&plane);
    if (!values) continue;
    const std::string layer = layer_of(channel);
    const auto triple = planes_of(part, layer);
    const bool in_triple =
        triple.size() == 3 && std::find(triple.begin(), triple.end(), values) != triple.end();
    names.push_back(in_triple ? layer : channel);
  }
  std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return std::pair(rank_of(part, a), a) < std::pair(rank_of(part, b), b);
  });
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Whether a layer ("key: flux") is named, or one of its channels. An empty selection names all.
bool is_selected(const std::vector<std::string>& selection, const std::string& layer) {
  const std::size_t colon = layer.rfind(": ");
  const std::string plain = colon == std::string::npos ? layer : layer.substr(colon + 2);
  return selection.empty() || std::any_of(selection.begin(), selection.end(), [&](const std::string& name) {
           return name == plain || layer_of(name) == plain;
         });
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

double luminance_at(const Layer& layer, std::size_t i) {
  if (layer.planes.size() == 1) return static_cast<double>(layer.planes[0][i]);
  const auto value = [&](std::size_t p) { return static_cast<double>(layer.planes[p][i]); };
  return luminance({value(0), value(1), value(2)});
}

}  // namespace

std::vector<std::string> layer_names(const ExrFile& file) {
  std::vector<std::string> names;
  for (const ExrPart& part : file.parts)
    for (const std::string& layer : layers_of(part)) names.push_back(prefix_of(file, part) + layer);
  return names;
}

bool is_colour_layer(const ExrFile& file, const std::string& name) {
  const auto place = find_layer(file, name);
  return place && find_floats(*place->part, channel_of(place->layer, 'R')) != nullptr;
}

std::optional<std::pair<int, int>> layer_size(const ExrFile& file, const std::string& name) {
  const auto place = find_layer(file, name);
  if (!place) return std::nullopt;
  return std::pair(place->part->width(), place->part->height());
}

Layer extract_layer(const ExrFile& file, const std::string& name) {
  Layer out{name, {}};
  if (const auto place = find_layer(file, name))
    for (const PlaneValues* plane : planes_of(*place->part, place->layer)) out.planes.push_back(*plane);
  return out;
}

std::vector<std::string> shared_layers(const std::vector<const ExrFile*>& files,
                                       const std::vector<std::string>& selection) {
  const ExrFile& first = *files.front();
  std::vector<std::string> shared, colours;
  std::optional<std::pair<int, int>> size;
  for (const std::string& name : layer_names(first)) {
    const auto here = layer_size(first, name);
    if (!is_selected(selection, name) || (size && here != size)) continue;
    if (!std::all_of(files.begin(), files.end(),
                     [&](const ExrFile* file) { return layer_size(*file, name) == here; }))
      continue;
    size = here;
    shared.push_back(name);
    if (is_colour_layer(first, name)) colours.push_back(name);
  }
  return colours.empty() || !selection.empty() ? shared : colours;
}

Picture make_picture(const ExrFile& file, const std::string& label, const std::vector<std::string>& layers) {
  Picture out;
  out.label = label;
  out.file = std::filesystem::path(file.path).filename().string();
  out.origin = origin_of(file);
  for (const std::string& name : layers) {
    const auto size = layer_size(file, name);
    if (!size)
      throw Error(ErrorCode::missing_channel,
                  file.path + ": has no layer \"" + name +
                      "\" of FLOAT channels; it has: " + joined(layer_names(file)));
    if (!out.layers.empty() && size != std::pair(out.width, out.height))
      throw Error(ErrorCode::wrong_size,
                  file.path + ": layer \"" + name +
                      "\" has another size than the ones before it; show layers of one size together");
    std::tie(out.width, out.height) = *size;
    out.layers.push_back(extract_layer(file, name));
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> origin_of(const ExrFile& file) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const ExrPart& part : file.parts) {
    for (const char* key : {"schema", "tool", "tool_version", "command", "seed", "inputs"}) {
      const auto it = part.attributes.find(std::string("vsgl.") + key);
      if (it == part.attributes.end()) continue;
      if (const auto* text = std::get_if<std::string>(&it->second)) out.emplace_back(key, *text);
    }
    if (!out.empty()) break;
  }
  return out;
}

double automatic_exposure(const Layer& layer) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i < layer.planes.front().size(); ++i) luminances.push_back(luminance_at(layer, i));
  return vsgl::automatic_exposure(std::move(luminances));
}

}  // namespace vsgl::report
