#include <random>

#include "math/moments.h"
#include "math/vsgl.h"
#include "shader_library.h"
#include "spirv/test/library/moments.comp.glsl.h"
#include "spirv/test/library/vsgl.comp.glsl.h"

namespace vsgl::test {
namespace {

Values values_of(const VsglIncoming& in) {
  return Values() << in.axis << in.sharpness << in.fluence;
}

// Light positions from the receiver: on its own axis, aside, behind, at the receiver.
std::vector<Row> offsets() {
  std::vector<Row> rows;
  for (const double d : {1e-3, 0.1, 1.0, 30.0, 1e3})
    for (const Vec3 u : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0.02, 0.01, 1}})
      rows.push_back({static_cast<float>(d * u.x), static_cast<float>(d * u.y), static_cast<float>(d * u.z)});
  rows.push_back({0, 0, 0});
  return rows;
}

LibraryFile vsgl_file() {
  const std::vector<Row> lights = combinations({numbers({1e-12, 1e-6, 1e-3, 0.1, 10, 1e4}),
                                                {direction({0, 0, -1}), direction({0.05, 0, -1})},
                                                numbers({0, 1e-3, 2.2925, 100})});
  const std::vector<Row> wild =
      combinations({offsets(), numbers({0, 1e-30, 1, 1e9}), directions(), sharpnesses()});
  const auto incoming = [](VsglIncoming (*function)(Vec3, double, Vec3, double)) {
    return [function](Arguments& a) {
      const Vec3 v = a.take3();
      const double variance = a.take();
      const Vec3 axis = a.take3();
      return values_of(function(v, variance, axis, a.take()));
    };
  };
  return {"vsgl",
          vsgl_comp_spv,
          {{"vsgl_product",
            combinations({upper_directions(), numbers({0, 1e-6, 1, 1e6}), lights}),
            [](Arguments& a) {
              const Vec3 u = a.take3();
              const double d2 = a.take(), variance = a.take();
              const Vec3 axis = a.take3();
              return values_of(vsgl_product(u, d2, variance, axis, a.take()));
            },
            {3e-5, 1e-30}},
           {"vsgl_incoming", combinations({offsets(), lights}), incoming(vsgl_incoming), {3e-5, 1e-30}, wild},
           {"disk_cone",
            combinations({numbers({0, 1e-3, 1, 1e3}), numbers({1e-12, 1e-3, 1, 1e4})}),
            [](Arguments& a) {
              const double d = a.take();
              const DiskCone c = disk_cone(d, a.take());
              return Values() << c.solid_angle << c.sharpness << c.density;
            },
            {1e-6, 0}},
           {"vsgl_incoming_disk",
            combinations({offsets(), lights}),
            incoming(vsgl_incoming_disk),
            {3e-5, 1e-30},
            wild}}};
}

// Moments of one reflecting point at `centre` + up to 3 `radius`; 26 words in the order of interop::Moments.
class PointMaker {
 public:
  Row make(Vec3 centre, double radius, bool empty) {
    if (empty) return Row(26, 0.0f);
    const Vec3 flux = vector(), diffuse = flux * vector(),
               specular = uniform() < 0.5 ? Vec3{} : flux * vector();
    Row row;
    append(row, flux);
    append(row, diffuse);
    append(row, specular);
    row.push_back(static_cast<float>(luminance(diffuse + specular)));
    append(row, centre + radius * (vector() - Vec3{0.5, 0.5, 0.5}));
    row.push_back(static_cast<float>(radius * radius * 1e-3 * uniform()));
    for (const double r : {0.575, 0.9999, 1.0}) {  // diffuse, specular and normal moments
      append(row, r * normalise(Vec3{0, 0, 1} + 0.01 * vector()));
      row.push_back(static_cast<float>((1 - r) * (1 + r)));
    }
    return row;
  }
  double uniform() { return static_cast<double>(engine_()) / 4294967296.0; }

 private:
  Vec3 vector() {
    const double x = uniform(), y = uniform();
    return {x, y, uniform()};
  }
  static void append(Row& row, Vec3 v) {
    for (const double x : {v.x, v.y, v.z}) row.push_back(static_cast<float>(x));
  }
  std::mt19937 engine_{11};
};

// Clusters of `taps` points: near the anchor, far from it by 1e4 radii, with empty taps, all empty.
std::vector<Row> clusters(int taps, bool with_shares) {
  std::vector<Row> rows;
  PointMaker maker;
  for (int trial = 0; trial < 200; ++trial) {
    const double radius = trial % 2 == 0 ? 1 : 1e-3;
    const Vec3 centre = trial % 4 < 2 ? Vec3{3 * radius, 0, radius} : Vec3{0, 0, 0};
    Row row;
    for (int k = 0; k < taps; ++k) {
      if (with_shares) row.push_back(static_cast<float>(maker.uniform()));
      const bool empty = trial == 7 || (trial % 5 == 0 && (k == 0 || maker.uniform() < 0.3));
      const Row point = maker.make(centre, radius, empty);
      row.insert(row.end(), point.begin(), point.end());
    }
    rows.push_back(row);
  }
  return rows;
}

DoubleMoments take_moments(Arguments& a) {
  DoubleMoments m;
  m.flux = a.take3(), m.power_diffuse = a.take3(), m.power_specular = a.take3();
  m.weight = a.take();
  m.position = a.take3(), m.spread = a.take();
  m.diffuse_mean = a.take3(), m.diffuse_deficit = a.take();
  m.specular_mean = a.take3(), m.specular_deficit = a.take();
  m.normal_mean = a.take3(), m.normal_deficit = a.take();
  return m;
}

Values merged(Arguments& a, std::size_t count, bool with_shares) {
  std::vector<DoubleMoments> taps;
  std::vector<double> shares;
  for (std::size_t k = 0; k < count; ++k) {
    shares.push_back(with_shares ? a.take() : 0.25);
    taps.push_back(take_moments(a));
  }
  const DoubleMoments m = merge_moments(taps, shares);
  return Values() << m.flux << m.power_diffuse << m.power_specular << m.weight << m.position << m.spread
                  << m.diffuse_mean << m.diffuse_deficit << m.specular_mean << m.specular_deficit
                  << m.normal_mean << m.normal_deficit;
}

LibraryFile moments_file() {
  const auto pair = [](Arguments& a) {
    std::vector<DoubleMoments> points(2);
    std::vector<double> shares(2, 1);
    for (DoubleMoments& p : points) p.weight = a.take(), p.position = a.take3(), p.spread = a.take();
    const DoubleMoments m = merge_moments(points, shares);
    return Values() << m.weight << m.position << m.spread;
  };
  const std::vector<Row> points =
      combinations({numbers({0, 1e-6, 1}), {{1, 2, 3}, {1.001f, 2, 3}}, numbers({0, 0.5})});
  // Relative to the values, of which the smallest spread is 1e-9.
  return {
      "moments",
      moments_comp_spv,
      {{"mean_spread_add", combinations({points, points}), pair, {1e-5, 1e-12}},
       {"moments_luminance",
        combinations({numbers({0, 0.2, 7}), numbers({1}), numbers({0, 3})}),
        [](Arguments& a) { return luminance(a.take3()); },
        {1e-6, 0}},
       {"moments_finish", clusters(8, true), [](Arguments& a) { return merged(a, 8, true); }, {1e-5, 1e-12}},
       {"moments_merge",
        clusters(4, false),
        [](Arguments& a) { return merged(a, 4, false); },
        {1e-5, 1e-12}}}};
}

}  // namespace

std::vector<LibraryFile> light_files() {
  return {vsgl_file(), moments_file()};
}

}  // namespace vsgl::test
