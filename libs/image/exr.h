#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace vsgl {

// One channel's pixels, row by row from the top-left. Files hold FLOAT, HALF (read as float) or UINT.
using Plane = std::variant<std::vector<float>, std::vector<std::uint32_t>>;

// One mip level (or the only image) of a part.
struct ExrLevel {
  int width = 0, height = 0;
  std::map<std::string, Plane> channels;  // by full name, "position.X"
};

using ExrAttribute = std::variant<int, double, std::string, std::array<double, 3>, std::array<double, 16>>;

enum class ExrCompression { none, zips, zip, piz };

// A part: levels.size() > 1 or `mipmap` makes it a tiled MIPMAP part (64x64 tiles, levels halved and rounded
// down to 1x1); otherwise scan lines.
struct ExrPart {
  std::string name;
  bool mipmap = false;
  ExrCompression compression =
      ExrCompression::none;  // written 10 times faster than zip, at 1.5 times the size
  std::map<std::string, ExrAttribute> attributes;
  std::vector<ExrLevel> levels;

  int width() const { return levels.front().width; }
  int height() const { return levels.front().height; }
};

struct ExrFile {
  std::vector<ExrPart> parts;
  std::string path;  // as read, for messages

  // The part of that name. Throws missing_part, naming those that are there.
  const ExrPart& part(const std::string& name) const;
};

// Writes all parts (a single-part file when there is one). Throws write_failed; non_finite when a FLOAT
// channel holds a NaN or an infinity (never written silently), naming part, channel, level and pixel.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

// Reads every part, level and channel. Throws file_not_found, exr_unreadable (also for truncated files),
// wrong_channel_type for nothing (HALF is widened). Does not look at values: see check_finite.
ExrFile read_exr(const std::filesystem::path& path);

// Threads that convert, compress and decompress pixels, of the whole process; 0: only the calling one.
// Default: as many as OpenMP's at the first reading or writing. The bytes do not depend on it.
void set_exr_threads(int threads);
void use_default_exr_threads();  // unless a number has been set

// Access by name; each throws a numbered error naming file, part, channel (and pixel).
const std::vector<float>& float_channel(const ExrFile& file, const ExrPart& part, std::size_t level,
                                        const std::string& name);
const std::vector<std::uint32_t>& uint_channel(const ExrFile& file, const ExrPart& part, std::size_t level,
                                               const std::string& name);
bool has_channel(const ExrPart& part, const std::string& name);
// Throws non_finite at the first NaN or infinity of any float channel of any level, or of any attribute.
void check_finite(const ExrFile& file);

int int_attribute(const ExrFile& file, const ExrPart& part, const std::string& name);
double double_attribute(const ExrFile& file, const ExrPart& part, const std::string& name);
std::string string_attribute(const ExrFile& file, const ExrPart& part, const std::string& name);
std::array<double, 3> vec3_attribute(const ExrFile& file, const ExrPart& part, const std::string& name);
std::array<double, 16> matrix_attribute(const ExrFile& file, const ExrPart& part, const std::string& name);

}  // namespace vsgl
