#include "math/metropolis.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

namespace vsgl {
namespace {

constexpr int kSmallStep = 4;  // log2 of the texels that a small step's square is wide

float unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// The random word `bits` as an offset of a small step, in fixed point modulo 1.
std::uint32_t offset(std::uint32_t bits, int top) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> std::max(top - kSmallStep, 0));
}

}  // namespace

Proposal chain_propose(const interop::Chain& chain, std::uint32_t index, std::uint32_t step,
                       std::uint64_t seed, float large_step, std::uint32_t layers, int top) {
  const auto key = pcg3d({step, static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  const auto a = pcg3d({index, key[0], key[1]}), b = pcg3d({index, key[1], key[2]});
  const float threshold = unit_float(b[1]);
  if (unit_float(a[2]) < large_step) {
    const std::uint64_t layer = std::uint64_t{b[0]} * layers >> 32;
    return {{a[0], a[1], static_cast<std::uint32_t>(layer)}, threshold};
  }
  return {{chain.x + offset(a[0], top), chain.y + offset(a[1], top), chain.layer}, threshold};
}

bool chain_accepts(float p, float proposed, float threshold) {
  return p <= 0 || threshold * p < proposed;
}

std::array<std::uint32_t, 2> chain_texel(const interop::Chain& chain, int top) {
  return {chain.x >> 1 >> (31 - top), chain.y >> 1 >> (31 - top)};
}

std::array<double, 2> chain_point(const interop::Chain& chain, int top) {
  return {static_cast<double>(unit_float(chain.x << top)), static_cast<double>(unit_float(chain.y << top))};
}

interop::Chain chain_at(std::uint32_t layer, std::array<std::uint32_t, 2> texel, std::array<double, 2> point,
                        int top) {
  const auto at = [&](std::size_t axis) {
    return texel[axis] << (31 - top) << 1 | static_cast<std::uint32_t>(std::ldexp(point[axis], 32 - top));
  };
  return {at(0), at(1), layer};
}

}  // namespace vsgl
