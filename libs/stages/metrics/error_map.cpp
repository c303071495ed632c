#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/metrics/pairing.h"
#include "stages/metrics/pictures.h"

namespace vsgl::metrics {
namespace {

Plane difference(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    out[i] = std::isfinite(a[i]) && std::isfinite(b[i])
                 ? std::min(std::abs(a[i] - b[i]), std::numeric_limits<float>::max())
                 : -1.0f;
  return out;
}
Plane difference(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::vector<float> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] == b[i] ? 0.0f : 1.0f;
  return out;
}

ExrLevel difference(const ExrLevel& a, const ExrLevel& b, const Options& options) {
  ExrLevel out{b.width, b.height, {}};
  for (const auto& [name, plane] : b.channels) {
    const auto other = a.channels.find(name);
    if (other == a.channels.end() || other->second.index() != plane.index() || !is_selected(options, name))
      continue;
    out.channels[name] = std::visit(
        [&other = other->second](const auto& reference) {
          return difference(std::get<std::decay_t<decltype(reference)>>(other), reference);
        },
        plane);
  }
  return out;
}

bool same_shape(const ExrPart& a, const ExrPart& b) {
  return std::equal(
      a.levels.begin(), a.levels.end(), b.levels.begin(), b.levels.end(),
      [](const ExrLevel& p, const ExrLevel& q) { return p.width == q.width && p.height == q.height; });
}

}  // namespace

std::optional<ExrFile> error_map(const ExrFile& test, const ExrFile& reference, const Options& options) {
  ExrFile out;
  for (const PartPair& pair : pair_parts(test, reference)) {
    if (!pair.test || !pair.reference || !same_shape(*pair.test, *pair.reference)) continue;
    ExrPart part;
    part.name = pair.reference->name;
    part.mipmap = pair.reference->mipmap;
    for (std::size_t l = 0; l < pair.reference->levels.size(); ++l)
      part.levels.push_back(difference(pair.test->levels[l], pair.reference->levels[l], options));
    if (!part.levels.front().channels.empty()) out.parts.push_back(std::move(part));
  }
  if (out.parts.empty()) return std::nullopt;
  return out;
}

}  // namespace vsgl::metrics
