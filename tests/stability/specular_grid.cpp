#include "specular_grid.h"

#include <algorithm>

#include "../unit/math/quadrature.h"
#include "math/specular_lobe.h"

namespace vsgl::test {
namespace {

// Of what the shader gets: float32.
Vec3 rounded(Vec3 v) {
  const Row row = direction(v);
  return {row[0], row[1], row[2]};
}

// All cells of one roughness and one view.
void fill(SpecularGrid& grid, std::uint32_t ndf, std::size_t alpha_index, std::size_t degree_index,
          int nodes) {
  const SpecularAxes& axes = grid.axes;
  const auto alpha = double{static_cast<float>(axes.alphas[alpha_index])};
  const double angle = axes.degrees[degree_index] * pi / 180;
  const Vec3 view = rounded({std::sin(angle), 0, std::cos(angle)});
  const SpecularReceiver receiver = specular_receiver(ndf, alpha, {0, 0, 1}, view);
  const SpecularReference reference(ndf, alpha, normalise(view), nodes, 2 * nodes);
  for (std::size_t k = 0; k < axes.sharpnesses.size(); ++k) {
    const std::size_t cell = axes.cell(alpha_index, degree_index, k);
    const double sharpness = axes.sharpnesses[k];
    std::size_t i = cell * grid.lights_per_cell();
    for (const Vec3 offset :
         offset_axes({-view.x, 0, view.z}, receiver.across * receiver.cos_view, sharpness)) {
      const Vec3 axis = rounded(offset);
      Row& row = grid.rows[i];
      row = {word(ndf), static_cast<float>(alpha)};
      for (const Vec3 v : {view, axis})
        for (const double x : {v.x, v.y, v.z}) row.push_back(static_cast<float>(x));
      row.push_back(static_cast<float>(sharpness));
      grid.exact[i] = reference.integral(normalise(axis), double{row.back()});
      grid.peaks[cell] = std::max(grid.peaks[cell], grid.exact[i]);
      ++i;
    }
  }
}

}  // namespace

SpecularGrid specular_grid(std::uint32_t ndf, const SpecularAxes& axes, int nodes) {
  const std::size_t lights = offset_axes({0, 0, 1}, 1, 1).size();
  SpecularGrid grid{axes, std::vector<Row>(lights * axes.cells()), std::vector<double>(lights * axes.cells()),
                    std::vector<double>(axes.cells())};
  const int groups = static_cast<int>(axes.alphas.size() * axes.degrees.size());
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < groups; ++i)
    fill(grid, ndf, static_cast<std::size_t>(i) / axes.degrees.size(),
         static_cast<std::size_t>(i) % axes.degrees.size(), nodes);
  return grid;
}

CellErrors cell_errors(const SpecularGrid& grid, std::size_t cell, const std::vector<float>& values) {
  CellErrors errors;
  const std::size_t lights = grid.lights_per_cell();
  for (std::size_t i = cell * lights; i < (cell + 1) * lights; ++i) {
    const double value = double{values[i]};
    errors.finite = errors.finite && std::isfinite(value);
    if (!(grid.exact[i] > 0.01 * grid.peaks[cell])) continue;
    const double difference = std::isfinite(value) ? std::abs(value - grid.exact[i]) : 1e300;
    errors.relative.push_back(difference / grid.exact[i]);
    const double absolute = std::min(difference / grid.peaks[cell], 10.0);
    errors.mean += absolute;
    errors.largest = std::max(errors.largest, absolute);
  }
  if (!errors.relative.empty()) errors.mean /= static_cast<double>(errors.relative.size());
  return errors;
}

GridErrors grid_errors(const SpecularGrid& grid, const std::vector<float>& values) {
  std::vector<double> relative;
  double sum = 0;
  for (std::size_t cell = 0; cell < grid.peaks.size(); ++cell) {
    const CellErrors errors = cell_errors(grid, cell, values);
    sum += errors.mean * static_cast<double>(errors.relative.size());
    relative.insert(relative.end(), errors.relative.begin(), errors.relative.end());
  }
  const auto middle = relative.begin() + static_cast<long>(relative.size() / 2);
  std::nth_element(relative.begin(), middle, relative.end());
  return {*middle, sum / static_cast<double>(relative.size())};
}

}  // namespace vsgl::test
