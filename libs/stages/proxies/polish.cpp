#include "stages/proxies/polish.h"

namespace vsgl::proxies {
namespace {

constexpr double kFirstStep = 4, kLastStep = 0.5, kLeastRadius = 0.5;  // voxels
constexpr int kRounds = 3;                                             // of one step at most

// Spheres and how many of them hold each voxel.
class Polish {
 public:
  Polish(const Voxels& voxels, double overlap_cost, std::vector<Sphere>& spheres)
      : voxels_(voxels), overlap_cost_(overlap_cost), spheres_(spheres), holders_(voxels.size()) {
    for (const Sphere& sphere : spheres_) add(sphere, 1);
  }

  void run() {
    for (double step = kFirstStep; step >= kLastStep; step /= 2)
      for (int round = 0; round < kRounds; ++round) {
        bool better = false;
        for (Sphere& sphere : spheres_) better |= improve(sphere, step * voxels_.side);
        if (!better) break;
      }
    drop_idle();
  }

 private:
  void add(const Sphere& sphere, int times) {
    voxels_.for_each_in(
        sphere, [&](std::size_t i) { holders_[i] = static_cast<std::uint16_t>(holders_[i] + times); });
  }

  // Takes the best of the steps along an axis, in radius, or both at once.
  bool improve(Sphere& sphere, double step) {
    double best = 0;
    Sphere to;
    for (const Vec3 way : {Vec3{}, Vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
      for (const double growth : {-1.0, 0.0, 1.0}) {
        const Sphere candidate{sphere.center + step * way, sphere.radius + growth * step};
        if (candidate.radius < kLeastRadius * voxels_.side) continue;
        const double found = change(sphere, candidate);
        if (found < best) best = found, to = candidate;
      }
    if (best == 0) return false;
    add(sphere, -1);
    add(to, 1);
    sphere = to;
    return true;
  }

  static Voxels::Span together(Voxels::Span a, Voxels::Span b) {
    return {std::min(a.first, b.first), std::max(a.last, b.last)};
  }

  struct Cost {
    long misfit = 0, overlap = 0;  // voxels
  };
  // What the spheres' cost grows by if `from` becomes `to`.
  double change(const Sphere& from, const Sphere& to) const {
    const auto slices = together(voxels_.slices_of(from), voxels_.slices_of(to)),
               rows = together(voxels_.rows_of(from), voxels_.rows_of(to));
    Cost sum;
    for (int z = slices.first; z <= slices.last; ++z)
      for (int y = rows.first; y <= rows.last; ++y) {
        const Voxels::Span before = voxels_.row_in(from, y, z), after = voxels_.row_in(to, y, z);
        add_row(after, before, y, z, 0, 1, sum);
        add_row(before, after, y, z, 1, -1, sum);
      }
    return static_cast<double>(sum.misfit) + overlap_cost_ * static_cast<double>(sum.overlap);
  }

  // What one sphere more on the voxels of `span` but not of `without` adds, `times` over; of their holders so
  // many are that sphere itself.
  void add_row(Voxels::Span span, Voxels::Span without, int y, int z, int own, int times, Cost& sum) const {
    const std::size_t row = voxels_.index(0, y, z);
    const auto visit = [&](int first, int last) {
      for (int x = first; x <= last; ++x) {
        const std::size_t i = row + static_cast<std::size_t>(x);
        if (holders_[i] > own)
          sum.overlap += times;
        else
          sum.misfit += voxels_.inside[i] != 0 ? -times : times;
      }
    };
    visit(span.first, std::min(span.last, without.first - 1));
    visit(std::max(span.first, without.last + 1), span.last);
  }

  void drop_idle() {
    std::vector<Sphere> kept;
    for (const Sphere& sphere : spheres_) {
      bool alone = false;
      voxels_.for_each_in(sphere, [&](std::size_t i) { alone |= holders_[i] == 1; });
      if (alone)
        kept.push_back(sphere);
      else
        add(sphere, -1);
    }
    spheres_ = kept;
  }

  const Voxels& voxels_;
  double overlap_cost_;
  std::vector<Sphere>& spheres_;
  std::vector<std::uint16_t> holders_;
};

}  // namespace

void polish(const Voxels& voxels, double overlap_cost, std::vector<Sphere>& spheres) {
  Polish(voxels, overlap_cost, spheres).run();
}

}  // namespace vsgl::proxies
