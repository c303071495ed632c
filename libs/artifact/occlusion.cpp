#include "artifact/occlusion.h"

#include "artifact/header.h"

namespace vsgl {

using namespace artifact;

namespace {

std::string channel(std::size_t i) {
  return "sh" + std::to_string(i) + ".V";
}

}  // namespace

void write(const std::filesystem::path& path, const Occlusion& occlusion, const Provenance& provenance) {
  ExrPart part = make_part("", "occlusion", provenance);
  part.attributes["occlusion.rate"] = occlusion.rate;
  ExrLevel level{occlusion.width, occlusion.height, {}};
  for (std::size_t i = 0; i < 16; ++i) {
    std::vector<float> plane;
    for (const auto& vector : occlusion.vectors) plane.push_back(vector[i]);
    level.channels[channel(i)] = std::move(plane);
  }
  part.levels = {std::move(level)};
  write_parts(path, {std::move(part)});
}

Occlusion read_occlusion(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "occlusion");
  check_finite(file);
  const ExrPart& part = only_part(file);
  Occlusion out;
  out.width = part.width();
  out.height = part.height();
  out.rate = int_in(file, part, "occlusion.rate", 1, 8);
  out.vectors.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (std::size_t i = 0; i < 16; ++i) {
    const std::vector<float>& plane = float_channel(file, part, 0, channel(i));
    for (std::size_t pixel = 0; pixel < plane.size(); ++pixel) out.vectors[pixel][i] = plane[pixel];
  }
  return out;
}

}  // namespace vsgl
