#pragma once

#include <cmath>
#include <concepts>

namespace vsgl {

// The sRGB transfer function (IEC 61966-2-1), linear 0..1 to encoded 0..1, and back.
template <std::floating_point T>
T srgb_encode(T linear) {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, 1 / T(2.4)) - T(0.055);
}
template <std::floating_point T>
T srgb_decode(T encoded) {
  return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

}  // namespace vsgl
