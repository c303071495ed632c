#include <algorithm>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "artifact/visibility.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr int kMaxSize = 1 << 16, kMaxLights = 1 << 28, kMaxEntries = 1 << 30;
// Lists are wrapped into rows of that many.
constexpr int kRow = 1024;

constexpr Field kTiles[] = {
    {"first", "I", offsetof(Cut::Tile, first)},
    {"count", "I", offsetof(Cut::Tile, count)},
    {"error", "V", offsetof(Cut::Tile, error), Range::non_negative},
    {"gain", "0123456789ABCDEF", offsetof(Cut::Tile, gain), Range::non_negative},
};

ExrPart make_cut_part(const std::string& name, const Cut& cut, const Provenance& provenance) {
  ExrPart part = make_part(name, "cut", provenance);
  part.attributes["anchor"] = to_array(cut.anchor);
  part.attributes["cut.width"] = cut.width;
  part.attributes["cut.height"] = cut.height;
  part.attributes["cut.lights"] = cut.lights;
  part.attributes["cut.error"] = cut.error;
  part.attributes["cut.entries"] = static_cast<int>(cut.nodes.size());
  part.attributes["cut.masks"] = static_cast<int>(cut.mask_words.size() / interop::MASK_WORDS);
  part.attributes["cut.pixels"] = cut.visibility.empty() ? 0 : 1;
  part.compression = ExrCompression::zip;
  return part;
}

// Every `stride`-th value from `first` on, wrapped into rows; at least one, padded by 0.
std::vector<std::uint32_t> wrapped(const std::vector<std::uint32_t>& values, std::size_t first,
                                   std::size_t stride) {
  const std::size_t count = values.size() / stride,
                    rows = std::max<std::size_t>(1, (count + kRow - 1) / kRow);
  std::vector<std::uint32_t> out(rows * kRow);
  for (std::size_t i = 0; i < count; ++i) out[i] = values[i * stride + first];
  return out;
}

ExrLevel rows_of(std::map<std::string, Plane> channels) {
  const auto size = std::get<1>(channels.begin()->second).size();
  return {kRow, static_cast<int>(size / kRow), std::move(channels)};
}

std::vector<std::uint32_t> unwrapped(const ExrFile& file, const ExrPart& part, const std::string& channel,
                                     std::size_t count) {
  std::vector<std::uint32_t> values = uint_channel(file, part, 0, channel);
  if (values.size() < count)
    throw Error(ErrorCode::wrong_size, file.path + ": part " + part.name + ": " +
                                           std::to_string(values.size()) + " values for the " +
                                           std::to_string(count) +
                                           " that the header counts; write the file again");
  values.resize(count);
  return values;
}

std::string mask_channel(std::uint32_t word) {
  return "mask." + std::to_string(word);
}

constexpr Field kPixels[] = {{"visibility", "V", 0, Range::unit_interval}};

// Tiles must follow one another and use all entries.
void check_tiles(const ExrFile& file, const ExrPart& part, const Cut& cut) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < cut.tiles.size(); ++i) {
    if (cut.tiles[i].first != next) fail_at(file, part, "first.I", i, "tiles do not follow one another");
    next += cut.tiles[i].count;
  }
  if (next != cut.nodes.size())
    fail_at(file, part, "count.I", cut.tiles.size() - 1, "counts do not add up to the entries");
}

void check_entries(const ExrFile& file, const ExrPart& part, const Cut& cut) {
  const std::size_t masks = cut.mask_words.size() / interop::MASK_WORDS;
  for (std::size_t i = 0; i < cut.nodes.size(); ++i) {
    if (cut.nodes[i] >= static_cast<std::uint32_t>(cut.lights))
      fail_at(file, part, "node.I", i, "there is no such light");
    if (!cut.masks.empty() && cut.masks[i] >= masks)
      fail_at(file, part, "mask.I", i, "there is no such mask");
  }
}

}  // namespace

void write(const std::filesystem::path& path, const Cut& cut, const Provenance& provenance) {
  ExrPart tiles = make_cut_part("tiles", cut, provenance);
  tiles.levels = {pack(kTiles, Structs(std::span(cut.tiles)), cut.columns(), cut.rows(), false)};
  ExrPart entries = make_cut_part("entries", cut, provenance);
  std::map<std::string, Plane> lists{{"node.I", wrapped(cut.nodes, 0, 1)}};
  if (cut.has_visibility()) lists["mask.I"] = wrapped(cut.masks, 0, 1);
  entries.levels = {rows_of(std::move(lists))};
  std::vector<ExrPart> parts{std::move(tiles), std::move(entries)};
  if (cut.has_visibility()) {
    ExrPart masks = make_cut_part("masks", cut, provenance);
    std::map<std::string, Plane> words;
    for (std::uint32_t w = 0; w < interop::MASK_WORDS; ++w)
      words[mask_channel(w)] = wrapped(cut.mask_words, w, interop::MASK_WORDS);
    masks.levels = {rows_of(std::move(words))};
    parts.push_back(std::move(masks));
  }
  if (!cut.visibility.empty()) {
    ExrPart pixels = make_cut_part("pixels", cut, provenance);
    pixels.levels = {pack(kPixels, Structs(std::span(cut.visibility)), cut.width, cut.height, false)};
    parts.push_back(std::move(pixels));
  }
  write_parts(path, std::move(parts));
}

Cut artifact::unpack_cut(const ExrFile& file) {
  const ExrPart& tiles = file.part("tiles");
  const ExrPart& entries = file.part("entries");
  Cut out;
  out.width = int_in(file, tiles, "cut.width", 1, kMaxSize);
  out.height = int_in(file, tiles, "cut.height", 1, kMaxSize);
  out.anchor = finite_vec3(file, tiles, "anchor");
  out.lights = int_in(file, tiles, "cut.lights", 0, kMaxLights);
  out.error = double_in(file, tiles, "cut.error", 0, 1);
  const auto count = static_cast<std::size_t>(int_in(file, tiles, "cut.entries", 0, kMaxEntries));
  const auto masks = static_cast<std::size_t>(int_in(file, tiles, "cut.masks", 0, kMaxEntries));
  out.tiles.resize(static_cast<std::size_t>(out.columns()) * static_cast<std::size_t>(out.rows()));
  unpack(kTiles, Structs(std::span(out.tiles)), file, tiles, 0, out.columns(), out.rows(), false);
  out.nodes = unwrapped(file, entries, "node.I", count);
  if (masks > 0) {
    const ExrPart& part = file.part("masks");
    out.masks = unwrapped(file, entries, "mask.I", count);
    out.mask_words.resize(masks * interop::MASK_WORDS);
    for (std::uint32_t w = 0; w < interop::MASK_WORDS; ++w) {
      const std::vector<std::uint32_t> words = unwrapped(file, part, mask_channel(w), masks);
      for (std::size_t i = 0; i < masks; ++i) out.mask_words[i * interop::MASK_WORDS + w] = words[i];
    }
  }
  if (int_in(file, tiles, "cut.pixels", 0, 1) == 1) {
    out.visibility.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
    unpack(kPixels, Structs(std::span(out.visibility)), file, file.part("pixels"), 0, out.width, out.height,
           false);
  }
  check_tiles(file, tiles, out);
  check_entries(file, entries, out);
  return out;
}

Cut read_cut(const std::filesystem::path& path) {
  return artifact::unpack_cut(artifact::read_artifact(path, "cut"));
}

}  // namespace vsgl
