#pragma once

// How the page stores images: as half floats, scaled by a power of two, predicted from their neighbours,
// deflated. docs/report.md states format and precision; configs/report/decode.js reads it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vsgl::report {

using PlaneValues = std::vector<float>;  // row by row from the top-left

struct EncodedPlanes {
  int exponent = 0;  // values are halves times 2^exponent
  std::vector<std::byte> bytes;
};
// Planes of width x height values each, which share an exponent. Relative error 2^-11 down to 2^-29 of the
// largest finite magnitude, 2^-40 of it absolutely below. NaN and infinities stay what they are.
EncodedPlanes encode(std::span<const PlaneValues> planes, int width, int height);
// What the page reads.
std::vector<PlaneValues> decode(const EncodedPlanes& encoded, std::size_t planes, int width, int height);

// What is stored of a test, so that small errors keep their digits: what the page has of the reference, plus
// this, is the test within 2^-9 of the larger of the two. Where either side is not finite it is the test
// itself.
PlaneValues difference_from(const PlaneValues& test, const PlaneValues& reference);

}  // namespace vsgl::report
