// Elementary functions that GLSL lacks or that implementations round badly.
#ifndef VSGL_LIB_SPECIAL_GLSL
#define VSGL_LIB_SPECIAL_GLSL

// e^x - 1 for x in -87..88 (clamped). Cody-Waite reduction x = k ln 2 + f, minimax polynomial of e^f - 1 - f (the coefficients of
// Cephes' expf). Relative error 2e-7, also where x is tiny.
float expm1(float x) {
  x = clamp(x, -87.0, 88.0);
  float k = roundEven(x * 1.44269504);
  float f = (x - k * 0.693359375) + k * 2.12194440e-4;
  float p = 1.9875691500e-4;
  p = p * f + 1.3981999507e-3;
  p = p * f + 8.3334519073e-3;
  p = p * f + 4.1665795894e-2;
  p = p * f + 1.6666665459e-1;
  p = p * f + 5.0000001201e-1;
  p = p * (f * f) + f;
  float scale = intBitsToFloat((int(k) + 127) << 23);
  return p * scale + (scale - 1.0);
}

// phi(x) = (e^x - 1) / x, phi(0) = 1. Relative error 3e-7.
float phi(float x) {
  return abs(x) < 1e-30 ? 1.0 : expm1(x) / x;
}

// e^(x^2) erfc(x) for x >= 0: Abramowitz and Stegun, Handbook of Mathematical Functions, 7.1.26. The product with e^(-x^2) is
// erfc(x) with an absolute error of 2.5e-7 (1.5e-7 of the formula itself).
float erfc_scaled(float x) {
  float t = 1.0 / (1.0 + 0.3275911 * x);
  return t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
}

// Absolute error 5e-7.
float erfc(float x) {
  float y = erfc_scaled(abs(x)) * exp(-x * x);
  return x < 0.0 ? 2.0 - y : y;
}

#endif
