#pragma once

// Packing of structs into EXR channels by a table, with the documented range of each channel. Private to this
// library.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "image/exr.h"
#include "interop/surface.h"
#include "math/vec.h"

namespace vsgl::artifact {

// What a channel may hold, besides being finite.
enum class Range {
  any,
  non_negative,
  unit_interval,  // 0..1, and kRounding beyond
  sharpness,      // 0..2^41
  ndf,            // 0..3
};
inline constexpr double kRounding = 1e-5;

// Some consecutive scalars of a struct, one channel each: {"position", "XYZ", offset} are position.X,
// position.Y, position.Z. Component "I" is UINT, the others are FLOAT.
struct Field {
  std::string_view layer;
  std::string_view components;
  std::size_t offset;
  Range range = Range::any;
  bool specular = false;  // in the file only where something is specular
};

// An array of structs, one a pixel.
struct Structs {
  std::byte* data;
  std::size_t size;    // number of structs
  std::size_t stride;  // bytes

  // Packing only reads, hence the const_cast.
  template <typename T>
  explicit Structs(std::span<const T> items)
      : data(reinterpret_cast<std::byte*>(const_cast<T*>(items.data()))),
        size(items.size()),
        stride(sizeof(T)) {}
  template <typename T>
  explicit Structs(std::span<T> items)
      : data(reinterpret_cast<std::byte*>(items.data())), size(items.size()), stride(sizeof(T)) {}
};

// A width x height level with the table's channels; pixels beyond the structs are 0.
ExrLevel pack(std::span<const Field> fields, Structs structs, int width, int height, bool with_specular);

// The way back. Throws wrong_size unless the level has `width` x `height` pixels; missing_channel,
// wrong_channel_type, non_finite or invalid_data naming channel and pixel.
void unpack(std::span<const Field> fields, Structs structs, const ExrFile& file, const ExrPart& part,
            std::size_t level, int width, int height, bool with_specular);

// Whether the part holds specular channels: the first specular one of the table decides.
bool has_specular_channels(std::span<const Field> fields, const ExrPart& part);

// Throws invalid_data: "file: part 'p', channel 'c': what at (x,y); remedy".
[[noreturn]] void fail_at(const ExrFile& file, const ExrPart& part, std::string_view channel,
                          std::size_t pixel, const std::string& what);

enum class Direction { unit, unit_or_zero };
// Throws invalid_data unless the length is 1 within 1e-3 (or 0, where that is allowed).
void check_direction(const ExrFile& file, const ExrPart& part, std::string_view layer, std::size_t pixel,
                     const interop::vec3& v, Direction rule);

// The channels of a G-buffer and of an RSM's surface parts, and what must hold between them.
std::span<const Field> surface_fields();
ExrLevel pack_surfaces(const std::vector<interop::Surface>& surfaces, int width, int height,
                       bool with_specular);
std::vector<interop::Surface> unpack_surfaces(const ExrFile& file, const ExrPart& part, int width,
                                              int height);

}  // namespace vsgl::artifact
