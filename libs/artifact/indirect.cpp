#include "artifact/artifact.h"
#include "artifact/header.h"
#include "artifact/radiance.h"
#include "base/pass.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr Field kCancellation[] = {{"cancellation", "V", 0, Range::unit_interval}};
constexpr Field kCutSize[] = {{"cut_size", "V", 0, Range::non_negative}};
constexpr const char* kPasses = "passes";  // there where the image is a mean of several
constexpr Field kErrorEstimate[] = {{"error_estimate", "V", 0, Range::non_negative}};

}  // namespace

void write(const std::filesystem::path& path, const Indirect& indirect, const Provenance& provenance) {
  ExrPart part = make_part("", "indirect", provenance);
  ExrLevel level = pack_radiance(indirect);
  put_layer(level, kCancellation, indirect.cancellation);
  put_layer(level, kCutSize, indirect.cut_size);
  put_layer(level, kErrorEstimate, indirect.error_estimate);
  if (indirect.passes > 1) part.attributes[kPasses] = indirect.passes;
  part.levels = {std::move(level)};
  write_parts(path, {std::move(part)});
}

Indirect read_indirect(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "indirect");
  const ExrPart& part = only_part(file);
  Indirect out = unpack_radiance(file, part);
  get_layer_if_there(file, part, kCancellation, out.cancellation);
  get_layer_if_there(file, part, kCutSize, out.cut_size);
  get_layer_if_there(file, part, kErrorEstimate, out.error_estimate);
  if (part.attributes.contains(kPasses)) out.passes = int_in(file, part, kPasses, 1, max_passes);
  return out;
}

}  // namespace vsgl
