#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "artifact/visibility.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr const char* kChannel = "visibility.V";

}  // namespace

// One pixel for all: they see everything.
void write(const std::filesystem::path& path, const Unshadowed& unshadowed, const Provenance& provenance) {
  ExrPart part = make_part("visibility", "unshadowed", provenance);
  part.attributes["anchor"] = to_array(unshadowed.anchor);
  part.attributes["visibility.lights"] = unshadowed.lights;
  part.levels = {{1, 1, {{kChannel, std::vector{1.0f}}}}};
  write_parts(path, {std::move(part)});
}

Unshadowed artifact::unpack_unshadowed(const ExrFile& file) {
  const ExrPart& part = only_part(file);
  const auto& values = float_channel(file, part, 0, kChannel);
  if (values != std::vector{1.0f})
    fail_at(file, part, kChannel, 0, "where nothing casts a shadow there is one value, 1");
  return {int_in(file, part, "visibility.lights", 0, 1 << 28), finite_vec3(file, part, "anchor")};
}

}  // namespace vsgl
