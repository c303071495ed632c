#include "stages/proxies/voxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace vsgl::proxies {
namespace {

constexpr int kLongest = 256;  // voxels along the longest side at most

// Where a line along an axis crosses the mesh, and which way the mesh faces there.
struct Crossing {
  double at;
  int turn;
};

double component(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// The lines along one axis through the centres of the voxels, a little off them: a mesh's edges often lie on
// the centres themselves.
class Lines {
 public:
  Lines(const Voxels& voxels, int axis)
      : axis_(axis), u_axis_((axis + 1) % 3), v_axis_((axis + 2) % 3), voxels_(voxels) {
    const int counts[] = {voxels.nx, voxels.ny, voxels.nz};
    columns_ = counts[u_axis_], rows_ = counts[v_axis_], length_ = counts[axis_];
    crossings_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  void add(Vec3 a, Vec3 b, Vec3 c) {
    const double au = u(a), av = v(a), bu = u(b), bv = v(b), cu = u(c), cv = v(c);
    const double area = (bu - au) * (cv - av) - (bv - av) * (cu - au);
    if (area == 0) return;
    const int first_row = std::max(static_cast<int>(std::ceil(std::min({av, bv, cv}))), 0);
    const int last_row = std::min(static_cast<int>(std::floor(std::max({av, bv, cv}))), rows_ - 1);
    const int first = std::max(static_cast<int>(std::ceil(std::min({au, bu, cu}))), 0);
    const int last = std::min(static_cast<int>(std::floor(std::max({au, bu, cu}))), columns_ - 1);
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first; column <= last; ++column) {
        const double wb = ((column - au) * (cv - av) - (row - av) * (cu - au)) / area;
        const double wc = ((bu - au) * (row - av) - (bv - av) * (column - au)) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        const double at = (1 - wb - wc) * along(a) + wb * along(b) + wc * along(c);
        crossings_[line(column, row)].push_back({at, area > 0 ? 1 : -1});
      }
  }

  // Adds 1 to the votes of all voxels that the mesh winds round.
  void vote(std::vector<std::uint8_t>& votes) {
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        auto& crossings = crossings_[line(column, row)];
        std::ranges::sort(crossings, {}, &Crossing::at);
        int winding = 0;
        std::size_t next = 0;
        for (int i = 0; i < length_; ++i) {
          for (; next < crossings.size() && crossings[next].at < i; ++next) winding += crossings[next].turn;
          if (winding != 0) ++votes[voxel(i, column, row)];
        }
      }
  }

 private:
  // In voxels from the centre of the first one.
  double place(Vec3 p, int axis, double off) const {
    return (component(p, axis) - component(voxels_.low, axis)) / voxels_.side - 0.5 - off;
  }
  double u(Vec3 p) const { return place(p, u_axis_, 3.7e-4); }
  double v(Vec3 p) const { return place(p, v_axis_, 6.1e-4); }
  double along(Vec3 p) const { return place(p, axis_, 0); }
  std::size_t line(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t voxel(int i, int column, int row) const {
    int place[3];
    place[axis_] = i, place[u_axis_] = column, place[v_axis_] = row;
    return voxels_.index(place[0], place[1], place[2]);
  }

  int axis_, u_axis_, v_axis_;
  const Voxels& voxels_;
  int columns_ = 0, rows_ = 0, length_ = 0;
  std::vector<std::vector<Crossing>> crossings_;
};

// [Felzenszwalb 2012, Section 2] lower envelope of parabolas: in place, d[i] = min_j (i - j)^2 + d[j].
void transform_line(std::vector<double>& d) {
  const int n = static_cast<int>(d.size());
  std::vector<int> apex(d.size());
  std::vector<double> from(d.size() + 1), out(d.size());
  const auto meet = [&](int q, int p) {
    return ((d[q] + static_cast<double>(q) * q) - (d[p] + static_cast<double>(p) * p)) / (2.0 * (q - p));
  };
  int k = 0;
  from[0] = -std::numeric_limits<double>::infinity();
  from[1] = std::numeric_limits<double>::infinity();
  for (int q = 1; q < n; ++q) {
    double s = meet(q, apex[k]);
    while (s <= from[k]) s = meet(q, apex[--k]);
    apex[++k] = q;
    from[k] = s;
    from[k + 1] = std::numeric_limits<double>::infinity();
  }
  k = 0;
  for (int i = 0; i < n; ++i) {
    while (from[k + 1] < i) ++k;
    out[i] = static_cast<double>(i - apex[k]) * (i - apex[k]) + d[apex[k]];
  }
  d = out;
}

}  // namespace

std::size_t Voxels::inside_count() const {
  return std::accumulate(inside.begin(), inside.end(), std::size_t{0});
}

Voxels voxelise(const Triangles& triangles, int cells) {
  const auto [low, high] = bounds(triangles);
  const Vec3 extent = high - low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  Voxels out;
  out.side = std::max(std::cbrt(extent.x * extent.y * extent.z) / cells, longest / kLongest);
  const auto count = [&](double length) {
    return std::max(static_cast<int>(std::ceil(length / out.side)), 1);
  };
  out.nx = count(extent.x), out.ny = count(extent.y), out.nz = count(extent.z);
  out.of_box =
      static_cast<std::size_t>(out.nx) * static_cast<std::size_t>(out.ny) * static_cast<std::size_t>(out.nz);
  const double radius = std::cbrt(static_cast<double>(out.of_box) * 3 / (4 * std::numbers::pi));
  for (int* length : {&out.nx, &out.ny, &out.nz}) *length += 2 * (1 + static_cast<int>(std::ceil(radius)));
  out.low = (low + high) / 2 - out.side / 2 * Vec3{1.0 * out.nx, 1.0 * out.ny, 1.0 * out.nz};
  out.inside.resize(static_cast<std::size_t>(out.nx) * static_cast<std::size_t>(out.ny) *
                    static_cast<std::size_t>(out.nz));
  for (int axis = 0; axis < 3; ++axis) {
    Lines lines(out, axis);
    for (std::size_t t = 0; t < triangles.count(); ++t)
      lines.add(triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2));
    lines.vote(out.inside);
  }
  for (std::uint8_t& votes : out.inside) votes = votes >= 2;
  return out;
}

std::vector<float> squared_distances(const Voxels& voxels) {
  const int counts[] = {voxels.nx, voxels.ny, voxels.nz};
  // Farther than any two voxels are apart.
  const double far = 4.0 * (voxels.nx + voxels.ny + voxels.nz) * (voxels.nx + voxels.ny + voxels.nz);
  std::vector<double> d(voxels.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = voxels.inside[i] != 0 ? far : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<double> line(static_cast<std::size_t>(counts[axis]));
    int place[3];
    const auto at = [&](int i) -> double& {
      place[axis] = i;
      return d[voxels.index(place[0], place[1], place[2])];
    };
    for (place[u] = 0; place[u] < counts[u]; ++place[u])
      for (place[v] = 0; place[v] < counts[v]; ++place[v]) {
        for (int i = 0; i < counts[axis]; ++i) line[static_cast<std::size_t>(i)] = at(i);
        transform_line(line);
        for (int i = 0; i < counts[axis]; ++i) at(i) = line[static_cast<std::size_t>(i)];
      }
  }
  return {d.begin(), d.end()};
}

}  // namespace vsgl::proxies
