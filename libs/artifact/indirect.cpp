#include <span>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

using interop::vec3;

// One-layer tables: the layers of this file are arrays of their own.
constexpr Field kIndirect[] = {{"indirect", "RGB", 0}};
constexpr Field kDiffuse[] = {{"diffuse", "RGB", 0}};
constexpr Field kSpecular[] = {{"specular", "RGB", 0}};
constexpr Field kDirect[] = {{"direct", "RGB", 0}};
constexpr Field kCancellation[] = {{"cancellation", "V", 0, Range::unit_interval}};

std::vector<vec3> sum(const std::vector<vec3>& a, const std::vector<vec3>& b) {
  if (a.empty()) return b;
  std::vector<vec3> out = a;
  for (std::size_t i = 0; i < b.size(); ++i) out[i] = {a[i].x + b[i].x, a[i].y + b[i].y, a[i].z + b[i].z};
  return out;
}

template <typename T>
void put(ExrLevel& level, std::span<const Field> field, const std::vector<T>& pixels) {
  if (!pixels.empty())
    level.channels.merge(pack(field, Structs(std::span(pixels)), level.width, level.height, false).channels);
}

// Reads a layer if the file has it.
template <typename T>
void get(const ExrFile& file, const ExrPart& part, std::span<const Field> field, std::vector<T>& pixels) {
  const std::string first = std::string(field[0].layer) + "." + field[0].components[0];
  if (!has_channel(part, first)) return;
  pixels.resize(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  unpack(field, Structs(std::span(pixels)), file, part, 0, part.width(), part.height(), false);
}

}  // namespace

void write(const std::filesystem::path& path, const Indirect& indirect, const Provenance& provenance) {
  if (!indirect.diffuse.empty() && !indirect.specular.empty() &&
      indirect.diffuse.size() != indirect.specular.size())
    throw Error(ErrorCode::internal, "write(Indirect): layers differ in size");
  ExrPart part = make_part("", "indirect", provenance);
  ExrLevel level{indirect.width, indirect.height, {}};
  put(level, kIndirect, sum(indirect.diffuse, indirect.specular));
  put(level, kDiffuse, indirect.diffuse);
  put(level, kSpecular, indirect.specular);
  put(level, kDirect, indirect.direct);
  put(level, kCancellation, indirect.cancellation);
  part.levels = {std::move(level)};
  write_parts(path, {std::move(part)});
}

Indirect read_indirect(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "indirect");
  const ExrPart& part = only_part(file);
  Indirect out;
  out.width = part.width();
  out.height = part.height();
  std::vector<vec3> total;
  get(file, part, kIndirect, total);
  get(file, part, kDiffuse, out.diffuse);
  get(file, part, kSpecular, out.specular);
  get(file, part, kDirect, out.direct);
  get(file, part, kCancellation, out.cancellation);
  const bool lit = !out.diffuse.empty() || !out.specular.empty();
  if (lit && total.empty()) float_channel(file, part, 0, "indirect.R");  // names what is missing
  if (!lit && (!total.empty() || out.direct.empty())) float_channel(file, part, 0, "diffuse.R");
  return out;
}

}  // namespace vsgl
