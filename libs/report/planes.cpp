#include "report/planes.h"

#include <half.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace vsgl::report {
namespace {

// The exponent that brings the largest finite magnitude to 2^14..2^15.
int exponent_of(std::span<const PlaneValues> planes) {
  float largest = 0;
  for (const PlaneValues& plane : planes)
    for (const float value : plane)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest == 0 ? 0 : std::ilogb(largest) - 14;
}

// Halves as integers in the order of their values.
std::uint16_t to_code(float value, int exponent) {
  const std::uint16_t bits = half(std::scalbn(value, -exponent)).bits();
  return static_cast<std::uint16_t>((bits & 0x8000U) != 0 ? ~bits : bits | 0x8000U);
}
float from_code(std::uint16_t code, int exponent) {
  half value;
  value.setBits(static_cast<std::uint16_t>((code & 0x8000U) != 0 ? code & 0x7FFFU : ~code));
  return std::scalbn(static_cast<float>(value), exponent);
}

// The median of left, above and left + above - diagonal, which follows edges and gradients; codes outside the
// image are the zero's. [Weinberger 2000, Eq. (1)]
int predict(const std::vector<std::uint16_t>& codes, int width, std::size_t i) {
  const std::size_t w = static_cast<std::size_t>(width), x = i % w;
  constexpr int kZero = 0x8000;
  if (i == 0) return kZero;
  if (i < w) return codes[i - 1];
  if (x == 0) return codes[i - w];
  const int left = codes[i - 1], above = codes[i - w], diagonal = codes[i - w - 1];
  return std::clamp(left + above - diagonal, std::min(left, above), std::max(left, above));
}

// Signed residuals as small unsigned ones: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
std::uint16_t zigzag(int residual) {
  const auto r = static_cast<std::int16_t>(residual);
  return static_cast<std::uint16_t>((r << 1) ^ (r >> 15));
}
int unzigzag(std::uint16_t z) {
  return (z >> 1) ^ -(z & 1);
}

std::vector<std::byte> deflated(const std::vector<std::byte>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> out(size);
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw Error(ErrorCode::memory, "not enough memory to compress an image");
  out.resize(size);
  return out;
}

std::vector<std::byte> inflated(const std::vector<std::byte>& bytes, std::size_t size) {
  std::vector<std::byte> out(size);
  uLongf got = size;
  if (uncompress(reinterpret_cast<Bytef*>(out.data()), &got, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size()) != Z_OK ||
      got != size)
    throw Error(ErrorCode::internal, "a compressed image does not decompress to its size");
  return out;
}

}  // namespace

EncodedPlanes encode(std::span<const PlaneValues> planes, int width, int height) {
  EncodedPlanes out{exponent_of(planes), {}};
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::byte> bytes(2 * planes.size() * count);
  for (std::size_t p = 0; p < planes.size(); ++p) {
    std::byte *high = bytes.data() + 2 * p * count, *low = high + count;
    std::vector<std::uint16_t> codes(count);
    for (std::size_t i = 0; i < count; ++i) {
      codes[i] = to_code(planes[p][i], out.exponent);
      const std::uint16_t residual = zigzag(codes[i] - predict(codes, width, i));
      high[i] = static_cast<std::byte>(residual >> 8);
      low[i] = static_cast<std::byte>(residual & 0xFFU);
    }
  }
  out.bytes = deflated(bytes);
  return out;
}

std::vector<PlaneValues> decode(const EncodedPlanes& encoded, std::size_t planes, int width, int height) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::vector<std::byte> bytes = inflated(encoded.bytes, 2 * planes * count);
  std::vector<PlaneValues> out;
  for (std::size_t p = 0; p < planes; ++p) {
    const std::byte *high = bytes.data() + 2 * p * count, *low = high + count;
    std::vector<std::uint16_t> codes(count);
    PlaneValues values(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto residual = static_cast<std::uint16_t>(std::to_integer<unsigned>(high[i]) << 8 |
                                                       std::to_integer<unsigned>(low[i]));
      codes[i] = static_cast<std::uint16_t>(predict(codes, width, i) + unzigzag(residual));
      values[i] = from_code(codes[i], encoded.exponent);
    }
    out.push_back(std::move(values));
  }
  return out;
}

PlaneValues difference_from(const PlaneValues& test, const PlaneValues& reference) {
  PlaneValues out(test.size());
  for (std::size_t i = 0; i < test.size(); ++i)
    out[i] = std::isfinite(test[i]) && std::isfinite(reference[i]) ? test[i] - reference[i] : test[i];
  return out;
}

}  // namespace vsgl::report
