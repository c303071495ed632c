#pragma once

#include <cstdint>
#include <vector>

#include "shader_library.h"

// Specular reflection of spherical-Gaussian lights over roughness, view and sharpness, by quadrature in
// double precision: what the lobe models are measured against.

namespace vsgl::test {

struct SpecularAxes {
  std::vector<double> alphas, degrees, sharpnesses;  // degrees: of the view to the normal
  std::size_t cells() const { return alphas.size() * degrees.size() * sharpnesses.size(); }
  std::size_t cell(std::size_t alpha, std::size_t degree, std::size_t sharpness) const {
    return (alpha * degrees.size() + degree) * sharpnesses.size() + sharpness;
  }
};

struct SpecularGrid {
  SpecularAxes axes;
  // 17 lights a cell, up to four lobe widths off the mirror direction, one after another.
  std::vector<Row> rows;      // arguments of kernel.comp.glsl: ndf, alpha, view, axis of the light, sharpness
  std::vector<double> exact;  // integral of the normalised SG times BRDF times cosine, 1/sr
  std::vector<double> peaks;  // largest of a cell
  std::size_t lights_per_cell() const { return rows.size() / peaks.size(); }
};

// `nodes` x 2 `nodes`: each of the two rules of a quadrature.
SpecularGrid specular_grid(std::uint32_t ndf, const SpecularAxes& axes, int nodes);

// Errors of `values` in a cell, over the lights whose exact value is above 1% of the peak.
struct CellErrors {
  double mean = 0;     // of |error| / peak, each at most 10
  double largest = 0;  // likewise
  bool finite = true;  // all of the cell's values
  std::vector<double> relative;
};
CellErrors cell_errors(const SpecularGrid& grid, std::size_t cell, const std::vector<float>& values);

// Over all lights of all cells: median of the relative errors, mean of |error| / peak.
struct GridErrors {
  double median = 0, mean = 0;
};
GridErrors grid_errors(const SpecularGrid& grid, const std::vector<float>& values);

}  // namespace vsgl::test
