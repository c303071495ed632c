#include "artifact/visibility.h"

#include "artifact/header.h"

namespace vsgl {

void write(const std::filesystem::path& path, const Visibility& visibility, const Provenance& provenance) {
  std::visit([&](const auto& kind) { write(path, kind, provenance); }, visibility);
}

Visibility read_visibility(const std::filesystem::path& path) {
  const ExrFile file =
      artifact::read_artifact(path, std::vector<std::string>{"ism", "visibility", "cut", "unshadowed"});
  if (artifact::kind_of(file) == "ism") return artifact::unpack_shadow_maps(file);
  if (artifact::kind_of(file) == "cut") return artifact::unpack_cut(file);
  if (artifact::kind_of(file) == "unshadowed") return artifact::unpack_unshadowed(file);
  return artifact::unpack_visibility_bits(file);
}

ShadowMaps read_shadow_maps(const std::filesystem::path& path) {
  return artifact::unpack_shadow_maps(artifact::read_artifact(path, "ism"));
}

VisibilityBits read_visibility_bits(const std::filesystem::path& path) {
  return artifact::unpack_visibility_bits(artifact::read_artifact(path, "visibility"));
}

}  // namespace vsgl
