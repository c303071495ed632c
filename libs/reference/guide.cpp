#include "reference/guide.h"

#include <algorithm>
#include <numeric>

namespace vsgl::reference {
namespace {

// Share of the probability that is uniform.
constexpr double kUniform = 0.2;

// Means over 3 x 3 cells: a cell's importance is known at one of its points only. The second coordinate
// repeats.
std::array<double, Guide::kCells> smooth(std::span<const double, Guide::kCells> weights) {
  constexpr int n = Guide::kSide;
  std::array<double, Guide::kCells> out{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj)
          out[static_cast<std::size_t>(i * n + j)] += weights[static_cast<std::size_t>(
              std::clamp(i + di, 0, n - 1) * n + std::clamp(j + dj, 0, n - 1))];
  return out;
}

// Cumulative shares of the weights, whose sum is not 0; the last one is exactly 1.
void accumulate(std::span<const double> weights, std::span<float> bounds) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double below = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    below += weights[i];
    bounds[i] = static_cast<float>(below / sum);
  }
  bounds.back() = 1;
}

// The interval that holds u, and where in it, 0..1.
struct Step {
  int index;
  double fraction;
};
Step find(std::span<const float> bounds, double u) {
  const auto upper = std::upper_bound(bounds.begin(), bounds.end() - 1, u);
  const double low = upper == bounds.begin() ? 0 : static_cast<double>(*(upper - 1)),
               high = static_cast<double>(*upper);
  return {static_cast<int>(upper - bounds.begin()), (u - low) / (high - low)};
}
double width(std::span<const float> bounds, int i) {
  const auto k = static_cast<std::size_t>(i);
  return static_cast<double>(bounds[k]) - (i == 0 ? 0 : static_cast<double>(bounds[k - 1]));
}

}  // namespace

Guide::Guide(std::size_t tiles) : tables_(tiles) {
  const std::array<double, kCells> nothing{};
  for (std::size_t tile = 0; tile < tiles; ++tile) set(tile, nothing);
}

void Guide::set(std::size_t tile, std::span<const double, kCells> weights) {
  std::array<double, kCells> blended = smooth(weights);
  const double sum = std::accumulate(blended.begin(), blended.end(), 0.0);
  const double guided = sum > 0 ? (1 - kUniform) / sum : 0;
  for (double& weight : blended) weight = guided * weight + kUniform / kCells;
  const std::span<float> table(tables_[tile]);
  std::array<double, kSide> rows;
  for (std::size_t i = 0; i < kSide; ++i) {
    const auto row = std::span<const double>(blended).subspan(i * kSide, kSide);
    rows[i] = std::accumulate(row.begin(), row.end(), 0.0);
    accumulate(row, table.subspan(kSide + i * kSide, kSide));
  }
  accumulate(rows, table.first(kSide));
}

std::span<const float, Guide::kSide> Guide::columns(std::size_t tile, int row) const {
  return std::span(tables_[tile]).subspan(static_cast<std::size_t>((row + 1) * kSide)).first<kSide>();
}

std::array<double, 2> Guide::warp(std::size_t tile, std::array<double, 2> u) const {
  const Step row = find(std::span(tables_[tile]).first<kSide>(), u[0]);
  const Step column = find(columns(tile, row.index), u[1]);
  return point_in(row.index * kSide + column.index, row.fraction, column.fraction);
}

double Guide::density(std::size_t tile, std::array<double, 2> u) const {
  const auto index = [](double x) { return std::clamp(static_cast<int>(x * kSide), 0, kSide - 1); };
  const int row = index(u[0]);
  return kCells * width(std::span(tables_[tile]).first<kSide>(), row) *
         width(columns(tile, row), index(u[1]));
}

std::array<double, 2> Guide::point_in(int cell, double x, double y) {
  return {(cell / kSide + x) / kSide, (cell % kSide + y) / kSide};
}

}  // namespace vsgl::reference
