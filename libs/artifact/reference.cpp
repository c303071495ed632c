#include <limits>

#include "artifact/artifact.h"
#include "artifact/header.h"
#include "artifact/radiance.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr Field kVariance[] = {{"variance", "RGB", 0, Range::non_negative}};
constexpr int kMaxSamples = std::numeric_limits<int>::max();

std::string strategy_in(const ExrFile& file, const ExrPart& part) {
  const std::string strategy = string_attribute(file, part, "reference.strategy");
  if (strategy == "light" || strategy == "brdf" || strategy == "mis") return strategy;
  throw Error(ErrorCode::invalid_data,
              file.path + ": header attribute 'reference.strategy' is \"" + strategy +
                  "\", must be light, brdf or mis; write the file again with the tool "
                  "that makes it");
}

}  // namespace

void write(const std::filesystem::path& path, const Reference& reference, const Provenance& provenance) {
  if (reference.variance.size() != reference.radiance.diffuse.size() || reference.samples > kMaxSamples)
    throw Error(ErrorCode::internal, "write(Reference): no variance, or too many samples");
  ExrPart part = make_part("", "reference", provenance);
  part.attributes["reference.strategy"] = reference.strategy;
  part.attributes["reference.samples"] = static_cast<int>(reference.samples);
  part.attributes["reference.passes"] = reference.passes;
  ExrLevel level = pack_radiance(reference.radiance);
  put_layer(level, kVariance, reference.variance);
  part.levels = {std::move(level)};
  write_parts(path, {std::move(part)});
}

Reference read_reference(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "reference");
  const ExrPart& part = only_part(file);
  Reference out;
  out.strategy = strategy_in(file, part);
  out.samples = static_cast<std::uint64_t>(int_in(file, part, "reference.samples", 1, kMaxSamples));
  out.passes = int_in(file, part, "reference.passes", 2, kMaxSamples);
  out.radiance = unpack_radiance(file, part);
  get_layer(file, part, kVariance, out.variance);
  return out;
}

}  // namespace vsgl
