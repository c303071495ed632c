#include "artifact/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "interop/model.h"

namespace vsgl::artifact {
namespace {

std::string channel_name(const Field& field, std::size_t component) {
  return std::string(field.layer) + "." + field.components[component];
}
bool is_uint(const Field& field) {
  return field.components == "I";
}

// One channel's pixels and where each belongs in its struct. Every scalar has four bytes.
struct Column {
  std::byte* plane;
  std::size_t offset;
};
static_assert(sizeof(float) == 4 && sizeof(std::uint32_t) == 4);

enum class Way { into_planes, into_structs };

// Copies all columns, a block of structs at a time, so that the block stays in the cache (twice as fast as
// column by column).
void transpose(const std::vector<Column>& columns, const Structs& structs, Way way) {
  constexpr std::size_t kBlock = 256;
  for (std::size_t begin = 0; begin < structs.size; begin += kBlock) {
    const std::size_t end = std::min(structs.size, begin + kBlock);
    for (const Column& column : columns)
      for (std::size_t i = begin; i < end; ++i) {
        std::byte* member = structs.data + i * structs.stride + column.offset;
        std::byte* pixel = column.plane + 4 * i;
        std::memcpy(way == Way::into_planes ? pixel : member, way == Way::into_planes ? member : pixel, 4);
      }
  }
}

// transpose() into structs only reads the planes, hence the const_cast.
template <typename T>
std::byte* bytes_of(const std::vector<T>& plane) {
  return reinterpret_cast<std::byte*>(const_cast<T*>(plane.data()));
}

struct Bounds {
  double minimum, maximum;
  const char* text;
};
Bounds bounds(Range range) {
  switch (range) {
    case Range::any:
      return {-HUGE_VAL, HUGE_VAL, "any"};
    case Range::non_negative:
      return {0, HUGE_VAL, "at least 0"};
    case Range::unit_interval:
      return {-kRounding, 1 + kRounding, "0..1"};
    case Range::sharpness:
      return {0, 0x1p41, "0..2^41"};
    case Range::ndf:
      return {0, interop::NDF_PHONG, "0..3"};
  }
  throw Error(ErrorCode::internal, "unknown Range");
}

std::string printed(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string part_label(const ExrFile& file, const ExrPart& part, std::size_t level) {
  std::string label = file.path;
  if (!part.name.empty()) label += ": part '" + part.name + "'";
  if (part.levels.size() > 1) label += ", level " + std::to_string(level);
  return label;
}

struct Place {
  const ExrFile& file;
  const ExrPart& part;
  std::size_t level;
  const std::string& channel;

  [[noreturn]] void fail(ErrorCode code, std::size_t pixel, const std::string& what) const {
    const auto width = static_cast<std::size_t>(part.levels[level].width);
    throw Error(code, part_label(file, part, level) + ", channel '" + channel + "': " + what + " at (" +
                          std::to_string(pixel % width) + "," + std::to_string(pixel / width) +
                          "); write the file again with the tool that makes it");
  }
};

template <typename T>
void check_values(const std::vector<T>& plane, Range range, const Place& place) {
  const Bounds limit = bounds(range);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const auto value = static_cast<double>(plane[i]);
    if (!std::isfinite(value)) place.fail(ErrorCode::non_finite, i, printed(value));
    if (value < limit.minimum || value > limit.maximum)
      place.fail(ErrorCode::invalid_data, i, printed(value) + " is not " + limit.text);
  }
}

// A level that is absent is left to the look-up of its channels.
void check_size(const ExrFile& file, const ExrPart& part, std::size_t level, int width, int height) {
  if (level >= part.levels.size()) return;
  const ExrLevel& found = part.levels[level];
  if (found.width == width && found.height == height) return;
  const auto size = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  throw Error(ErrorCode::wrong_size, part_label(file, part, level) + ": " + size(found.width, found.height) +
                                         " pixels instead of " + size(width, height) +
                                         "; write the file again with the tool that makes it");
}

}  // namespace

ExrLevel pack(std::span<const Field> fields, Structs structs, int width, int height, bool with_specular) {
  ExrLevel level{width, height, {}};
  std::vector<Column> columns;
  for (const Field& field : fields) {
    if (field.specular && !with_specular) continue;
    for (std::size_t c = 0; c < field.components.size(); ++c) {
      Plane& plane = level.channels[channel_name(field, c)];
      if (is_uint(field)) plane.emplace<std::vector<std::uint32_t>>();
      std::visit(
          [&](auto& values) {
            values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
            columns.push_back({bytes_of(values), field.offset + c * sizeof(float)});
          },
          plane);
    }
  }
  transpose(columns, structs, Way::into_planes);
  return level;
}

void unpack(std::span<const Field> fields, Structs structs, const ExrFile& file, const ExrPart& part,
            std::size_t level, int width, int height, bool with_specular) {
  check_size(file, part, level, width, height);
  std::vector<Column> columns;
  for (const Field& field : fields) {
    if (field.specular && !with_specular) continue;
    for (std::size_t c = 0; c < field.components.size(); ++c) {
      const std::string channel = channel_name(field, c);
      const auto take = [&](const auto& plane) {
        check_values(plane, field.range, Place{file, part, level, channel});
        columns.push_back({bytes_of(plane), field.offset + c * sizeof(float)});
      };
      if (is_uint(field)) {
        take(uint_channel(file, part, level, channel));
      } else {
        take(float_channel(file, part, level, channel));
      }
    }
  }
  transpose(columns, structs, Way::into_structs);
}

bool has_specular_channels(std::span<const Field> fields, const ExrPart& part) {
  for (const Field& field : fields)
    if (field.specular) return has_channel(part, channel_name(field, 0));
  return false;
}

void fail_at(const ExrFile& file, const ExrPart& part, std::string_view channel, std::size_t pixel,
             const std::string& what) {
  const std::string name(channel);
  Place{file, part, 0, name}.fail(ErrorCode::invalid_data, pixel, what);
}

void check_direction(const ExrFile& file, const ExrPart& part, std::string_view layer, std::size_t pixel,
                     const interop::vec3& v, Direction rule) {
  const double squared = double(v.x) * double(v.x) + double(v.y) * double(v.y) + double(v.z) * double(v.z);
  if (std::abs(squared - 1) <= 2e-3 || (squared == 0 && rule == Direction::unit_or_zero)) return;
  fail_at(file, part, layer, pixel, "direction of length " + printed(std::sqrt(squared)) + " instead of 1");
}

std::span<const Field> surface_fields() {
  using interop::Surface;
  static constexpr Field kFields[] = {
      {"position", "XYZ", offsetof(Surface, position)},
      {"normal", "XYZ", offsetof(Surface, normal)},
      {"shading_normal", "XYZ", offsetof(Surface, shading_normal)},
      {"diffuse", "RGB", offsetof(Surface, diffuse), Range::unit_interval},
      {"depth", "Z", offsetof(Surface, depth), Range::non_negative},
      {"id", "I", offsetof(Surface, id)},
      {"specular", "RGB", offsetof(Surface, specular), Range::unit_interval, true},
      {"alpha", "V", offsetof(Surface, alpha), Range::unit_interval, true},
      {"ndf", "I", offsetof(Surface, ndf), Range::ndf, true},
  };
  return kFields;
}

ExrLevel pack_surfaces(const std::vector<interop::Surface>& surfaces, int width, int height,
                       bool with_specular) {
  return pack(surface_fields(), Structs(std::span(surfaces)), width, height, with_specular);
}

std::vector<interop::Surface> unpack_surfaces(const ExrFile& file, const ExrPart& part, int width,
                                              int height) {
  const bool with_specular = has_specular_channels(surface_fields(), part);
  std::vector<interop::Surface> surfaces(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  unpack(surface_fields(), Structs(std::span(surfaces)), file, part, 0, width, height, with_specular);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    interop::Surface& s = surfaces[i];
    if (s.id == interop::NO_INSTANCE) {
      if (s.ndf != interop::NDF_NONE) fail_at(file, part, "ndf.I", i, "specular lobe where nothing is seen");
      continue;
    }
    if (!with_specular) s.alpha = 1;
    check_direction(file, part, "normal", i, s.normal, Direction::unit);
    check_direction(file, part, "shading_normal", i, s.shading_normal, Direction::unit);
    if (s.ndf != interop::NDF_NONE && s.alpha < interop::ALPHA_MIN)
      fail_at(file, part, "alpha.V", i, printed(double(s.alpha)) + " is not 1e-3..1");
  }
  return surfaces;
}

}  // namespace vsgl::artifact
