#include <algorithm>
#include <cstdio>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "artifact/visibility.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr int kMaxLights = 1 << 20;

// Zero-padded, so that sorted channels are in the order of the words.
std::string channel_of(int word) {
  char name[32];
  std::snprintf(name, sizeof name, "visibility.%05d", word);
  return name;
}

std::size_t pixel_count(const VisibilityBits& bits) {
  return static_cast<std::size_t>(bits.width) * static_cast<std::size_t>(bits.height);
}

// Bits of the last word that belong to a light.
std::uint32_t last_mask(int lights) {
  return lights % 32 == 0 ? ~0U : (1U << lights % 32) - 1;
}

// Words of pixels by channel name: those of the last word belong to lights that exist.
void check_last_word(const ExrFile& file, const ExrPart& part, int lights, int word,
                     const std::vector<std::uint32_t>& plane) {
  const std::uint32_t mask = lights == 0 ? 0 : last_mask(lights);
  const auto wrong = std::find_if(plane.begin(), plane.end(), [mask](auto w) { return (w & ~mask) != 0; });
  if (wrong != plane.end())
    fail_at(file, part, channel_of(word), static_cast<std::size_t>(wrong - plane.begin()),
            "a bit of a light beyond the " + std::to_string(lights) + " that there are");
}

}  // namespace

// An EXR has at least one channel: without any light it holds one of zeros.
void write(const std::filesystem::path& path, const VisibilityBits& bits, const Provenance& provenance) {
  const std::size_t pixels = pixel_count(bits);
  if (bits.words.size() != pixels * static_cast<std::size_t>(bits.words_per_pixel()))
    throw Error(ErrorCode::internal, "write(VisibilityBits): incomplete words");
  ExrPart part = make_part("", "visibility", provenance);
  part.attributes["anchor"] = to_array(bits.anchor);
  part.attributes["visibility.lights"] = bits.lights;
  part.compression = ExrCompression::zip;  // 19 to 44 times smaller than none, in a tenth of a second a
                                           // 480x270 image of 1024 lights; zips and piz: less, no faster
  ExrLevel level{bits.width, bits.height, {}};
  for (int word = 0; word < bits.words_per_pixel(); ++word) {
    const auto* plane = bits.words.data() + static_cast<std::size_t>(word) * pixels;
    level.channels[channel_of(word)] = std::vector<std::uint32_t>(plane, plane + pixels);
  }
  if (bits.lights == 0) level.channels[channel_of(0)] = std::vector<std::uint32_t>(pixels);
  part.levels.push_back(std::move(level));
  write_parts(path, {std::move(part)});
}

VisibilityBits artifact::unpack_visibility_bits(const ExrFile& file) {
  const ExrPart& part = only_part(file);
  VisibilityBits out;
  out.width = part.width();
  out.height = part.height();
  out.anchor = finite_vec3(file, part, "anchor");
  out.lights = int_in(file, part, "visibility.lights", 0, kMaxLights);
  out.words.reserve(pixel_count(out) * static_cast<std::size_t>(out.words_per_pixel()));
  const int channels = std::max(out.words_per_pixel(), 1);
  for (int word = 0; word < channels; ++word) {
    const auto& plane = uint_channel(file, part, 0, channel_of(word));
    if (word == channels - 1) check_last_word(file, part, out.lights, word, plane);
    if (out.lights > 0) out.words.insert(out.words.end(), plane.begin(), plane.end());
  }
  if (part.levels.front().channels.size() != static_cast<std::size_t>(channels))
    throw Error(ErrorCode::wrong_size,
                file.path + ": " + std::to_string(part.levels.front().channels.size()) + " channels for " +
                    std::to_string(out.lights) + " lights, which need " + std::to_string(channels) +
                    "; write the file again with ismap");
  return out;
}

}  // namespace vsgl
