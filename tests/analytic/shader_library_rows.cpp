#include "shader_library.h"

namespace vsgl::test {

std::vector<LibraryFile> library_files() {
  std::vector<LibraryFile> files;
  for (auto topic : {gaussian_files, surface_files, light_files, sampling_files, vsl_files})
    for (LibraryFile& file : topic()) files.push_back(std::move(file));
  return files;
}

std::vector<Row> combinations(std::initializer_list<std::vector<Row>> lists) {
  std::vector<Row> rows{{}};
  for (const std::vector<Row>& list : lists) {
    std::vector<Row> longer;
    for (const Row& head : rows)
      for (const Row& tail : list) {
        longer.push_back(head);
        longer.back().insert(longer.back().end(), tail.begin(), tail.end());
      }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<Row> numbers(std::initializer_list<double> values) {
  std::vector<Row> rows;
  for (const double x : values) rows.push_back({static_cast<float>(x)});
  return rows;
}

std::vector<Row> words(std::initializer_list<std::uint32_t> values) {
  std::vector<Row> rows;
  for (const std::uint32_t x : values) rows.push_back({word(x)});
  return rows;
}

std::vector<Row> powers(double low, double high, double factor) {
  std::vector<Row> rows;
  for (double x = low; x <= high; x *= factor) rows.push_back({static_cast<float>(x)});
  return rows;
}

std::vector<Row> sharpnesses() {
  return numbers(
      {0, 1e-20, 1e-6, 1e-3, 0.03, 0.07, 0.4, 0.6, 1, 2.2925, 5, 16, 100, 3e3, 1e5, 1e8, 1099511627776.0});
}

Row direction(Vec3 v) {
  v = normalise(v);
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::vector<Row> directions() {
  std::vector<Row> rows = upper_directions();
  for (const Vec3 v :
       {Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{-0.3, 0.5, -0.7}, Vec3{1e-4, 2e-4, -1}})
    rows.push_back(direction(v));
  return rows;
}

std::vector<Row> upper_directions() {
  std::vector<Row> rows;
  for (const Vec3 v : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.3, -0.5, 0.7},
                       Vec3{-0.9, 0.1, 0.2}, Vec3{1e-4, 0, 1}, Vec3{1, 1, 1e-3}})
    rows.push_back(direction(v));
  return rows;
}

}  // namespace vsgl::test
