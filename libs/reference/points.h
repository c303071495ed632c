#pragma once

#include <array>
#include <cstdint>

namespace vsgl::reference {

// What a random number is for.
enum class Stream : std::uint32_t { pilot = 1, light = 2, brdf = 3 };

// Randomised quasi-Monte Carlo [Cranley 1976]: a rank-1 lattice of the unit square, shifted at random by a
// counter: (seed, stream, item, pass). Every point is uniform, and lattices of different counters are
// independent.
class Points {
 public:
  // `count`: points of a lattice, 1..2^20.
  Points(std::uint64_t seed, int count);

  int count() const { return count_; }

  class Lattice {
   public:
    std::array<double, 2> operator[](int i) const;

   private:
    friend class Points;
    Lattice(double count, std::uint32_t generator, std::array<double, 2> shift)
        : inverse_count_(1 / count), generator_(generator), shift_(shift) {}
    double inverse_count_;
    std::uint32_t generator_;
    std::array<double, 2> shift_;
  };
  Lattice lattice(Stream stream, std::uint32_t item, std::uint32_t pass) const;
  // One random point.
  std::array<double, 2> point(Stream stream, std::uint32_t item, std::uint32_t pass) const;

 private:
  std::array<std::uint32_t, 3> hash(Stream stream, std::uint32_t item, std::uint32_t pass) const;

  std::array<std::uint32_t, 2> seed_;
  int count_;
  std::uint32_t generator_;
};

}  // namespace vsgl::reference
