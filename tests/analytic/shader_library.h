#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "math/vec.h"

// Each file of shaders/lib has a test shader, shaders/test/library/<file>.comp.glsl, that calls its functions
// by number, and here a list of those calls: arguments, the double-precision twin, and how far the two may
// differ.

namespace vsgl::test {

// Float arguments of one call, as the shader takes them; integers travel as their bits.
using Row = std::vector<float>;

inline float word(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

// Reads a row in order.
class Arguments {
 public:
  explicit Arguments(std::span<const float> row) : rest_(row) {}
  float take_float() {
    const float x = rest_.front();
    rest_ = rest_.subspan(1);
    return x;
  }
  double take() { return static_cast<double>(take_float()); }
  std::uint32_t take_word() { return std::bit_cast<std::uint32_t>(take_float()); }
  Vec3 take3() {
    const double x = take(), y = take();
    return {x, y, take()};
  }

 private:
  std::span<const float> rest_;
};

// What a twin returns: values in the order in which the shader puts them.
class Values {
 public:
  struct Value {
    double value;
    double scale;  // what a relative error is relative to: the value, or the length of its vector
    bool exact;    // a word that must agree in every bit
  };

  Values() = default;
  Values(double x) { *this << x; }  // NOLINT: implicit, for twins of one value
  Values& operator<<(double x) { return add(x, std::abs(x), false); }
  Values& operator<<(Vec3 v) {
    const double scale = length(v);
    return add(v.x, scale, false).add(v.y, scale, false).add(v.z, scale, false);
  }
  Values& operator<<(std::uint32_t bits) { return add(static_cast<double>(bits), 0, true); }
  std::size_t size() const { return values_.size(); }
  const Value& operator[](std::size_t i) const { return values_[i]; }

 private:
  Values& add(double value, double scale, bool exact) {
    values_.push_back({value, scale, exact});
    return *this;
  }
  std::vector<Value> values_;
};

// |shader - twin| <= relative * scale + absolute.
struct Tolerance {
  double relative = 0, absolute = 0;
};

struct LibraryCall {
  std::string name;
  std::vector<Row> rows;
  std::function<Values(Arguments&)> twin;
  Tolerance tolerance;
  std::vector<Row> wild{};  // degenerate arguments: the results need only be finite
};

struct LibraryFile {
  std::string name;  // without .glsl
  std::span<const std::uint32_t> spirv;
  std::vector<LibraryCall> calls;  // in the order of the shader's cases
  std::vector<float> appendix{};   // behind the arguments: data that the shader reads on its own
};

inline void PrintTo(const LibraryFile& file, std::ostream* stream) {
  *stream << file.name;
}  // for GoogleTest

// shader_library_<topic>.cpp.
std::vector<LibraryFile> gaussian_files();
std::vector<LibraryFile> surface_files();
std::vector<LibraryFile> light_files();
std::vector<LibraryFile> sampling_files();
std::vector<LibraryFile> vsl_files();
// All of these.
std::vector<LibraryFile> library_files();

// Every combination of one row from each list, joined.
std::vector<Row> combinations(std::initializer_list<std::vector<Row>> lists);
// One-word rows.
std::vector<Row> numbers(std::initializer_list<double> values);
std::vector<Row> words(std::initializer_list<std::uint32_t> values);
// `low`, then multiplied by `factor` up to `high`.
std::vector<Row> powers(double low, double high, double factor);
// 0, tiny, small and large sharpnesses up to 2^40.
std::vector<Row> sharpnesses();
Row direction(Vec3 v);
// The axes, both signs, and generic directions; float32 of unit vectors.
std::vector<Row> directions();
std::vector<Row> upper_directions();  // z >= 0

}  // namespace vsgl::test
