#include "reference/accumulator.h"

#include <bit>
#include <cmath>
#include <limits>

#include "artifact/header.h"
#include "base/atomic_file.h"
#include "base/error.h"

namespace vsgl::reference {
namespace {

constexpr const char* kSchema = "reference-checkpoint";

// Channels of the checkpoint, two words each.
constexpr std::array<const char*, 9> kNames = {"diffuse.R",   "diffuse.G",   "diffuse.B",
                                               "specular.R",  "specular.G",  "specular.B",
                                               "deviation.R", "deviation.G", "deviation.B"};
constexpr std::array<const char*, 2> kHalves = {".low", ".high"};

}  // namespace

void Accumulator::add(std::size_t pixel, const Estimate& estimate, int passes) {
  State& s = pixels_[pixel];
  const std::array<double, 3> diffuse = to_array(estimate.diffuse), specular = to_array(estimate.specular);
  for (std::size_t c = 0; c < 3; ++c) {
    const double before = diffuse[c] + specular[c] - (s[c] + s[3 + c]);
    s[c] += (diffuse[c] - s[c]) / passes;
    s[3 + c] += (specular[c] - s[3 + c]) / passes;
    s[6 + c] += before * (diffuse[c] + specular[c] - (s[c] + s[3 + c]));
  }
}

Vec3 Accumulator::diffuse(std::size_t pixel) const {
  const State& s = pixels_[pixel];
  return {s[0], s[1], s[2]};
}

Vec3 Accumulator::specular(std::size_t pixel) const {
  const State& s = pixels_[pixel];
  return {s[3], s[4], s[5]};
}

Vec3 Accumulator::variance(std::size_t pixel, int passes) const {
  const State& s = pixels_[pixel];
  // Rounding can leave the sum of squares a little below 0.
  return Vec3{std::fmax(s[6], 0), std::fmax(s[7], 0), std::fmax(s[8], 0)} / (double(passes) * (passes - 1));
}

double Accumulator::relative_error(const std::vector<std::uint32_t>& pixels, int passes) const {
  if (passes < 2) return std::numeric_limits<double>::infinity();
  Vec3 spread, light;
  for (const std::uint32_t pixel : pixels) {
    spread += variance(pixel, passes);
    light += diffuse(pixel) + specular(pixel);
  }
  const double samples = 3 * static_cast<double>(pixels.size());
  const double mean = (light.x + light.y + light.z) / samples;
  return mean > 0 ? std::sqrt((spread.x + spread.y + spread.z) / samples) / mean : 0;
}

void Accumulator::save(const std::filesystem::path& path, const std::string& key, int passes) const {
  Provenance provenance;
  provenance.tool = "reference";
  provenance.tool_version = VSGL_VERSION;
  ExrPart part = artifact::make_part("", kSchema, provenance);
  part.attributes["checkpoint.key"] = key;
  part.attributes["checkpoint.passes"] = passes;
  ExrLevel level{width_, height_, {}};
  for (std::size_t k = 0; k < kNames.size(); ++k)
    for (std::size_t half = 0; half < 2; ++half) {
      std::vector<std::uint32_t> words(size());
      for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(pixels_[i][k]) >> (32 * half));
      level.channels[std::string(kNames[k]) + kHalves[half]] = std::move(words);
    }
  part.levels = {std::move(level)};
  OutputSet outputs(true);
  artifact::write_parts(outputs.add(path), {std::move(part)});
  outputs.commit();
}

std::optional<int> Accumulator::load(const std::filesystem::path& path, const std::string& key) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const ExrFile file = artifact::read_artifact(path, kSchema);
  const ExrPart& part = artifact::only_part(file);
  if (string_attribute(file, part, "checkpoint.key") != key)
    throw Error(ErrorCode::invalid_data,
                path.string() +
                    ": is the checkpoint of another scene, G-buffer, strategy, seed or size "
                    "of passes; remove it or name another file");
  const int passes = artifact::int_in(file, part, "checkpoint.passes", 1, std::numeric_limits<int>::max());
  if (part.width() != width_ || part.height() != height_)
    throw Error(ErrorCode::wrong_size, path.string() + ": has another size than the G-buffer; remove it");
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto& low = uint_channel(file, part, 0, std::string(kNames[k]) + kHalves[0]);
    const auto& high = uint_channel(file, part, 0, std::string(kNames[k]) + kHalves[1]);
    for (std::size_t i = 0; i < size(); ++i)
      pixels_[i][k] = std::bit_cast<double>(std::uint64_t{high[i]} << 32 | low[i]);
  }
  return passes;
}

}  // namespace vsgl::reference
