#include "sh/exponential.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace vsgl::sh {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double kFloor = 0.02;  // of the largest eigenvalue

double off_diagonal(const Matrix& a) {
  double sum = 0;
  for (int i = 0; i < kCoefficients; ++i)
    for (int j = 0; j < i; ++j) sum += a[i][j] * a[i][j];
  return sum;
}

// Eigenvectors (columns of `vectors`) and eigenvalues (diagonal of `a`) by Jacobi's rotations.
void diagonalise(Matrix& a, Matrix& vectors) {
  for (int i = 0; i < kCoefficients; ++i)
    for (int j = 0; j < kCoefficients; ++j) vectors[i][j] = i == j ? 1 : 0;
  for (int sweep = 0; sweep < 32 && off_diagonal(a) > 1e-28; ++sweep)
    for (int p = 0; p < kCoefficients; ++p)
      for (int q = p + 1; q < kCoefficients; ++q) {
        if (a[p][q] == 0) continue;
        const double ratio = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = std::copysign(1 / (std::abs(ratio) + std::hypot(ratio, 1)), ratio);
        const double c = 1 / std::hypot(t, 1), s = t * c;
        for (int k = 0; k < kCoefficients; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < kCoefficients; ++k) {
          const double pk = a[p][k], qk = a[q][k], vp = vectors[k][p], vq = vectors[k][q];
          a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
          vectors[k][p] = c * vp - s * vq, vectors[k][q] = s * vp + c * vq;
        }
        a[p][q] = a[q][p] = 0;
      }
}

// ln(x) / (x - 1), without cancellation near 1.
double log_ratio(double x) {
  const double d = x - 1;
  return d == 0 ? 1 : std::log1p(d) / d;
}

Vector without_constant(Vector f) {
  f[0] = 0;
  return f;
}
double norm(const Vector& f) {
  return std::sqrt(dot(f, f));
}

// exp of f's constant part: e^c for the constant function c.
double constant_factor(const Vector& f) {
  return std::exp(f[0] / std::sqrt(4 * pi));
}

// The start's 2^p-th power, by products with itself.
Vector raise(Vector start, int p, double factor) {
  for (; p > 0; --p) start = product(start, start);
  for (double& value : start) value *= factor;
  return start;
}

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (int i = 0; i < kCoefficients; ++i)
    for (int k = 0; k < kCoefficients; ++k)
      for (int j = 0; j < kCoefficients; ++j) out[i][j] += a[i][k] * b[k][j];
  return out;
}

Vector minus(Vector a, const Vector& b) {
  for (int i = 0; i < kCoefficients; ++i) a[i] -= b[i];
  return a;
}

Vector scaled(Vector f, double factor) {
  for (double& value : f) value *= factor;
  return f;
}

// Fits for caps of growing size: the norm of the logarithm, and the factors.
struct FitSample {
  double norm;
  LinearFit fit;
};
std::vector<FitSample> fit_single_caps() {
  std::vector<FitSample> out;
  for (int i = 1; i <= 64; ++i) {
    const double below = 0.02 * i / 64;
    const Vector f = turn(log_occlusion(below), {0, 0, 1}), rest = without_constant(f);
    const Vector g = scaled(minus(one(), turn(cap(below), {0, 0, 1})), 1 / constant_factor(f));
    out.push_back({norm(rest), {g[0] / one()[0], dot(g, rest) / dot(rest, rest)}});
  }
  return out;
}

}  // namespace

// Only the eigenvectors of m = 0 take part, but the floor is that of all eigenvalues.
Zonal log_occlusion(double below) {
  const Vector hidden = turn(cap(below), {0, 0, 1});
  Matrix values = multiplier(minus(one(), hidden)), vectors;
  diagonalise(values, vectors);
  double largest = 0;
  for (int e = 0; e < kCoefficients; ++e) largest = std::max(largest, values[e][e]);
  Zonal out{};
  for (int e = 0; e < kCoefficients; ++e) {
    double along = 0;
    for (int i = 0; i < kCoefficients; ++i) along -= vectors[i][e] * hidden[i];
    along *= log_ratio(std::max(values[e][e], kFloor * largest));
    for (int l = 0; l < kOrder; ++l) out[l] += vectors[index(l, 0)][e] * along;
  }
  return out;
}

int squarings(double size, double limit) {
  int p = 0;
  while (p < kMaxSquarings && std::ldexp(size, -p) > limit) ++p;
  return p;
}

LinearFit linear_fit(double size) {
  static const std::vector<FitSample> samples = fit_single_caps();
  FitSample before{0, {1, 1}};
  for (const FitSample& sample : samples) {
    if (sample.norm >= size) {
      const double t = (size - before.norm) / (sample.norm - before.norm);
      return {before.fit.constant + t * (sample.fit.constant - before.fit.constant),
              before.fit.linear + t * (sample.fit.linear - before.fit.linear)};
    }
    before = sample;
  }
  return before.fit;
}

Vector exp_second_order(const Vector& f) {
  Vector x = without_constant(f);
  const int p = squarings(norm(x), kSecondOrderNorm);
  x = scaled(x, std::ldexp(1, -p));
  Vector start = product(x, x);
  for (int i = 0; i < kCoefficients; ++i) start[i] = x[i] + 0.5 * start[i];
  start[0] += one()[0];
  return raise(start, p, constant_factor(f));
}

Vector exp_hyb(const Vector& f) {
  Vector x = without_constant(f);
  const double size = norm(x);
  const int p = squarings(size, kHybNorm);
  const LinearFit fit = linear_fit(std::ldexp(size, -p));
  x = scaled(x, fit.linear * std::ldexp(1, -p));
  x[0] += fit.constant * one()[0];
  return raise(x, p, constant_factor(f));
}

Vector exp_exact(const Vector& f) {
  Matrix m = multiplier(without_constant(f));
  const int p = squarings(norm(f), 1.0 / 64);
  for (Vector& row : m) row = scaled(row, std::ldexp(1, -p));
  // Taylor's series of the scaled matrix, by Horner's rule.
  Matrix power{};
  for (int i = 0; i < kCoefficients; ++i) power[i][i] = 1;
  for (int n = 8; n > 0; --n) {
    power = times(m, power);
    for (int i = 0; i < kCoefficients; ++i) {
      power[i] = scaled(power[i], 1.0 / n);
      power[i][i] += 1;
    }
  }
  for (int i = 0; i < p; ++i) power = times(power, power);
  Vector out{};
  for (int i = 0; i < kCoefficients; ++i) out[i] = power[i][0] * one()[0] * constant_factor(f);
  return out;
}

}  // namespace vsgl::sh
