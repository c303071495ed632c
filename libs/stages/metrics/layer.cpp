#include "stages/metrics/layer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/exposure.h"
#include "math/vec.h"
#include "stages/metrics/pairing.h"

namespace vsgl::metrics {
namespace {

const std::vector<float>* find_floats(const ExrPart& part, const std::string& name) {
  const auto& channels = part.levels.front().channels;
  const auto it = channels.find(name);
  return it == channels.end() ? nullptr : std::get_if<std::vector<float>>(&it->second);
}

// Layers in the order of preference.
std::vector<std::string> candidates(const ExrPart& part) {
  std::vector<std::string> names = {"indirect"};
  for (const auto& [channel, plane] : part.levels.front().channels)
    if (channel.ends_with(".R")) names.push_back(channel.substr(0, channel.size() - 2));
  for (const auto& [channel, plane] : part.levels.front().channels)
    if (std::holds_alternative<std::vector<float>>(plane)) names.push_back(channel);
  return names;
}

bool is_finite(const Colour& colour) {
  return std::all_of(colour.begin(), colour.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace

double luminance_of(const Colour& c) {
  return luminance({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])});
}

std::optional<std::vector<Colour>> colours_of(const ExrPart& part, const std::string& name) {
  std::array<const std::vector<float>*, 3> planes;
  planes.fill(find_floats(part, name));
  if (!planes[0])
    planes = {find_floats(part, name + ".R"), find_floats(part, name + ".G"), find_floats(part, name + ".B")};
  if (!planes[0] || !planes[1] || !planes[2]) return std::nullopt;
  std::vector<Colour> out(planes[0]->size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
  return out;
}

std::optional<LayerPair> extract_layer(const ExrPart& test, const ExrPart& reference,
                                       const std::string& name) {
  if (test.width() != reference.width() || test.height() != reference.height()) return std::nullopt;
  auto a = colours_of(test, name), b = colours_of(reference, name);
  if (!a || !b) return std::nullopt;
  return LayerPair{name, reference.width(), reference.height(), std::move(*a), std::move(*b)};
}

std::optional<LayerPair> choose_layer(const ExrFile& test, const ExrFile& reference,
                                      const std::string& name) {
  for (const PartPair& pair : pair_parts(test, reference)) {
    if (!pair.test || !pair.reference) continue;
    for (const std::string& candidate : name.empty() ? candidates(*pair.reference) : std::vector{name})
      if (auto layer = extract_layer(*pair.test, *pair.reference, candidate)) return layer;
  }
  if (!name.empty())
    throw Error(ErrorCode::bad_value,
                "--layer " + name +
                    ": the files have no such layer in common; name an RGB layer (diffuse) "
                    "or a FLOAT channel (depth.Z) of both");
  return std::nullopt;
}

std::vector<char> blacken_non_finite(LayerPair& layer) {
  std::vector<char> blackened(layer.reference.size(), 0);
  for (std::size_t i = 0; i < blackened.size(); ++i) {
    if (is_finite(layer.test[i]) && is_finite(layer.reference[i])) continue;
    layer.test[i] = layer.reference[i] = {0, 0, 0};
    blackened[i] = 1;
  }
  return blackened;
}

double automatic_exposure(const LayerPair& layer) {
  std::vector<double> luminances;
  for (const Colour& c : layer.reference) luminances.push_back(luminance_of(c));
  return vsgl::automatic_exposure(std::move(luminances));
}

}  // namespace vsgl::metrics
