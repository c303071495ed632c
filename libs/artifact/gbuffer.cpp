#include <algorithm>
#include <limits>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"

namespace vsgl {

using namespace artifact;

bool GBuffer::has_specular() const {
  return std::any_of(pixels.begin(), pixels.end(), [](const auto& p) { return p.ndf != interop::NDF_NONE; });
}

void write(const std::filesystem::path& path, const GBuffer& gbuffer, const Provenance& provenance) {
  ExrPart part = make_part("", "gbuffer", provenance);
  part.attributes["anchor"] = to_array(gbuffer.anchor);
  part.attributes["camera"] = to_array(gbuffer.camera);
  part.attributes["scene_radius"] = gbuffer.scene_radius;
  part.levels = {pack_surfaces(gbuffer.pixels, gbuffer.width, gbuffer.height, gbuffer.has_specular())};
  write_parts(path, {std::move(part)});
}

GBuffer read_gbuffer(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "gbuffer");
  const ExrPart& part = only_part(file);
  GBuffer out;
  out.width = part.width();
  out.height = part.height();
  out.anchor = finite_vec3(file, part, "anchor");
  out.camera = finite_vec3(file, part, "camera");
  out.scene_radius = double_in(file, part, "scene_radius", 0, std::numeric_limits<double>::max());
  out.pixels = unpack_surfaces(file, part, out.width, out.height);
  return out;
}

}  // namespace vsgl
