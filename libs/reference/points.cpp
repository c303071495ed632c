#include "reference/points.h"

#include <cmath>

#include "math/sampling.h"

namespace vsgl::reference {
namespace {

double fraction(double x) {
  return x - std::floor(x);
}

}  // namespace

Points::Points(std::uint64_t seed, int count)
    : seed_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      count_(count),
      generator_(lattice_generator(static_cast<std::uint32_t>(count))) {}

std::array<std::uint32_t, 3> Points::hash(Stream stream, std::uint32_t item, std::uint32_t pass) const {
  const auto key = pcg3d({seed_[0], seed_[1], static_cast<std::uint32_t>(stream)});
  return pcg3d({key[0] ^ item, key[1] ^ pass, key[2]});
}

Points::Lattice Points::lattice(Stream stream, std::uint32_t item, std::uint32_t pass) const {
  return {static_cast<double>(count_), generator_, point(stream, item, pass)};
}

std::array<double, 2> Points::Lattice::operator[](int i) const {
  return {fraction(i * inverse_count_ + shift_[0]),
          fraction(i * static_cast<double>(generator_) * inverse_count_ + shift_[1])};
}

std::array<double, 2> Points::point(Stream stream, std::uint32_t item, std::uint32_t pass) const {
  const auto bits = hash(stream, item, pass);
  return {bits[0] * 0x1p-32, bits[1] * 0x1p-32};
}

}  // namespace vsgl::reference
