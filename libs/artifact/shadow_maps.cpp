#include <algorithm>
#include <limits>
#include <span>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "artifact/visibility.h"

namespace vsgl {

using namespace artifact;

namespace {

using View = ShadowMaps::View;
constexpr Field kAtlas[] = {{"inverse_distance", "V", 0, Range::non_negative}};
constexpr Field kViews[] = {
    {"origin", "XYZ", offsetof(View, origin)},
    {"axis", "XYZ", offsetof(View, axis)},
};

ExrPart make_ism_part(const std::string& name, const ShadowMaps& maps, const Provenance& provenance) {
  ExrPart part = make_part(name, "ism", provenance);
  part.attributes["anchor"] = to_array(maps.anchor);
  part.attributes["ism.tile"] = maps.tile;
  part.attributes["ism.columns"] = maps.columns;
  part.attributes["ism.count"] = static_cast<int>(maps.views.size());
  part.attributes["ism.disk_radius"] = maps.bias_disk_radius;
  part.attributes["ism.normal_offset"] = maps.normal_offset;
  part.attributes["ism.slope_bias"] = maps.slope_bias;
  part.attributes["ism.relative_bias"] = maps.relative_bias;
  return part;
}

}  // namespace

// An EXR has at least one pixel: without any view both parts hold a single one, of zeros.
void write(const std::filesystem::path& path, const ShadowMaps& maps, const Provenance& provenance) {
  const std::vector<float> no_texel(1);
  const std::vector<View> no_view(1);
  const bool empty = maps.views.empty();
  const std::vector<View>& views = empty ? no_view : maps.views;
  const std::vector<float>& texels = empty ? no_texel : maps.inverse_distance;
  ExrPart atlas = make_ism_part("atlas", maps, provenance);
  atlas.levels = {pack(kAtlas, Structs(std::span(texels)), empty ? 1 : maps.columns * maps.tile,
                       empty ? 1 : maps.rows() * maps.tile, false)};
  ExrPart rows = make_ism_part("views", maps, provenance);
  rows.levels = {pack(kViews, Structs(std::span(views)), 1, static_cast<int>(views.size()), false)};
  write_parts(path, {std::move(atlas), std::move(rows)});
}

ShadowMaps artifact::unpack_shadow_maps(const ExrFile& file) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  const ExrPart& atlas = file.part("atlas");
  const ExrPart& rows = file.part("views");
  const int count = int_in(file, atlas, "ism.count", 0, 1 << 24);
  ShadowMaps out;
  out.tile = int_in(file, atlas, "ism.tile", 1, 1 << 16);
  out.columns = int_in(file, atlas, "ism.columns", count == 0 ? 0 : 1, (1 << 16) / out.tile);
  out.anchor = finite_vec3(file, atlas, "anchor");
  out.bias_disk_radius = double_in(file, atlas, "ism.disk_radius", 0, kHuge);
  out.normal_offset = double_in(file, atlas, "ism.normal_offset", 0, kHuge);
  out.slope_bias = double_in(file, atlas, "ism.slope_bias", 0, kHuge);
  out.relative_bias = double_in(file, atlas, "ism.relative_bias", 0, kHuge);
  if (count == 0) return out;
  out.views.resize(static_cast<std::size_t>(rows.height()));
  unpack(kViews, Structs(std::span(out.views)), file, rows, 0, 1, count, false);
  for (std::size_t i = 0; i < out.views.size(); ++i)
    check_direction(file, rows, "axis", i, out.views[i].axis, Direction::unit);
  out.inverse_distance.resize(static_cast<std::size_t>(atlas.width()) *
                              static_cast<std::size_t>(atlas.height()));
  unpack(kAtlas, Structs(std::span(out.inverse_distance)), file, atlas, 0, out.columns * out.tile,
         out.rows() * out.tile, false);
  return out;
}

}  // namespace vsgl
