#include "artifact/radiance.h"

#include "base/error.h"

namespace vsgl::artifact {
namespace {

using interop::vec3;

// One-layer tables: the layers of these files are arrays of their own.
constexpr Field kIndirect[] = {{"indirect", "RGB", 0}};
constexpr Field kDiffuse[] = {{"diffuse", "RGB", 0}};
constexpr Field kSpecular[] = {{"specular", "RGB", 0}};
constexpr Field kDirect[] = {{"direct", "RGB", 0}};

std::vector<vec3> sum(const std::vector<vec3>& a, const std::vector<vec3>& b) {
  if (a.empty()) return b;
  std::vector<vec3> out = a;
  for (std::size_t i = 0; i < b.size(); ++i) out[i] = {a[i].x + b[i].x, a[i].y + b[i].y, a[i].z + b[i].z};
  return out;
}

}  // namespace

ExrLevel pack_radiance(const Indirect& radiance) {
  if (!radiance.diffuse.empty() && !radiance.specular.empty() &&
      radiance.diffuse.size() != radiance.specular.size())
    throw Error(ErrorCode::internal, "diffuse and specular layers differ in size");
  ExrLevel level{radiance.width, radiance.height, {}};
  put_layer(level, kIndirect, sum(radiance.diffuse, radiance.specular));
  put_layer(level, kDiffuse, radiance.diffuse);
  put_layer(level, kSpecular, radiance.specular);
  put_layer(level, kDirect, radiance.direct);
  return level;
}

Indirect unpack_radiance(const ExrFile& file, const ExrPart& part) {
  Indirect out;
  out.width = part.width();
  out.height = part.height();
  std::vector<vec3> total;
  get_layer_if_there(file, part, kIndirect, total);
  get_layer_if_there(file, part, kDiffuse, out.diffuse);
  get_layer_if_there(file, part, kSpecular, out.specular);
  get_layer_if_there(file, part, kDirect, out.direct);
  const bool lit = !out.diffuse.empty() || !out.specular.empty();
  if (lit && total.empty()) float_channel(file, part, 0, "indirect.R");  // names what is missing
  if (!lit && (!total.empty() || out.direct.empty())) float_channel(file, part, 0, "diffuse.R");
  return out;
}

}  // namespace vsgl::artifact
