#include "artifact/artifact.h"
#include "artifact/header.h"
#include "artifact/radiance.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr Field kCancellation[] = {{"cancellation", "V", 0, Range::unit_interval}};

}  // namespace

void write(const std::filesystem::path& path, const Indirect& indirect, const Provenance& provenance) {
  ExrPart part = make_part("", "indirect", provenance);
  ExrLevel level = pack_radiance(indirect);
  put_layer(level, kCancellation, indirect.cancellation);
  part.levels = {std::move(level)};
  write_parts(path, {std::move(part)});
}

Indirect read_indirect(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "indirect");
  const ExrPart& part = only_part(file);
  Indirect out = unpack_radiance(file, part);
  get_layer_if_there(file, part, kCancellation, out.cancellation);
  return out;
}

}  // namespace vsgl
