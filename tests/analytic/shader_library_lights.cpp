#include <random>

#include "math/fvpl.h"
#include "math/interop_vec.h"
#include "math/moments.h"
#include "math/vsgl.h"
#include "shader_library.h"
#include "spirv/test/library/fvpl.comp.glsl.h"
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
            {2e-6, 0}},
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

Row concatenation(std::initializer_list<Row> parts) {
  Row row;
  for (const Row& part : parts) row.insert(row.end(), part.begin(), part.end());
  return row;
}

// Clusters in the order of the test shader: each density of normals and none, rough and smooth, of parallel
// and of spread normals, straight and bumped with normals that turn, small and large, and one without any
// power.
std::vector<Row> fvpl_clusters(std::initializer_list<double> alphas) {
  std::vector<Row> rows;
  const Row incident = direction({0.5, -0.1, 0.8}), diffuse{0.3f, 0.2f, 0}, specular{0.1f, 0, 2};
  for (const std::uint32_t ndf :
       {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN, interop::NDF_PHONG})
    for (const double alpha : alphas)
      for (const double normal_sharpness : {0.5, 3.0, 150.0, 1e6})
        for (const Vec3 bump : {Vec3{0, 0, 1}, Vec3{0.1, 0.2, 1}})
          for (const float inverse_variance : {1e-2f, 10.0f, 1e6f}) {
            const auto alpha2 = static_cast<float>(alpha * alpha);
            const auto kappa = static_cast<float>(normal_sharpness);
            rows.push_back(concatenation({{inverse_variance},
                                          direction({0, 0, 1}),
                                          {kappa},
                                          diffuse,
                                          {1.2f},
                                          direction(bump),
                                          {bump.x > 0 ? 0.4f : 0.0f},
                                          incident,
                                          {alpha2},
                                          specular,
                                          {alpha2},
                                          {word(ndf)}}));
          }
  return rows;
}

interop::Cluster take_cluster(Arguments& a) {
  const auto vector = [&a] { return to_float(a.take3()); };
  interop::Cluster c{};
  c.inverse_variance = a.take_float();
  c.normal = vector(), c.normal_sharpness = a.take_float();
  c.diffuse = vector(), c.incident_masking = a.take_float();
  c.shading_normal = vector(), c.facet_turn = a.take_float();
  c.incident = vector(), c.alpha2 = a.take_float();
  c.specular = vector(), c.masking_alpha2 = a.take_float();
  c.ndf = a.take_word();
  return c;
}

SpecularReceiver take_receiver(Arguments& a) {
  const std::uint32_t ndf = a.take_word();
  const double alpha = a.take();
  const Vec3 normal = a.take3();
  return specular_receiver(ndf, alpha, normal, a.take3());
}

// Where and how a cluster lies, as the reflection of its footprint asks.
std::vector<Row> fvpl_planes() {
  return combinations(
      {numbers({1e-4, 1, 1e4}), {direction({0, 0, -1}), direction({0.6, 0.3, 1})}, numbers({150, 1e6})});
}
interop::Cluster take_plane(Arguments& a) {
  interop::Cluster c{};
  c.inverse_variance = a.take_float();
  c.normal = to_float(a.take3());
  c.normal_sharpness = a.take_float();
  return c;
}

auto reflection(FvplReflection (*function)(const SpecularReceiver&, const interop::Cluster&,
                                           const FvplView&)) {
  return [function](Arguments& a) {
    const SpecularReceiver r = take_receiver(a);
    const Vec3 v = a.take3();
    const interop::Cluster c = take_plane(a);
    const FvplReflection f = function(r, c, fvpl_view(v, static_cast<double>(c.inverse_variance)));
    return Values() << f.diffuse << f.specular;
  };
}

auto emission(Vec3 (*function)(const interop::Cluster&, Vec3, double)) {
  return [function](Arguments& a) {
    const interop::Cluster c = take_cluster(a);
    const Vec3 u = a.take3();
    return Values() << function(c, u, a.take());
  };
}

LibraryFile fvpl_file() {
  const std::vector<Row> clusters = fvpl_clusters({0.05, 0.5});
  std::vector<Row> wild_clusters = fvpl_clusters({1e-3, 1});
  wild_clusters.emplace_back(22, 0.0f);
  const std::vector<Row> towards = combinations({directions(), numbers({1e-6, 1, 1e4})});
  const std::vector<Row> wild = combinations({wild_clusters, directions(), numbers({1e-12, 1e24})});
  const std::vector<Row> receivers =
      combinations({words({interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN, interop::NDF_PHONG}),
                    numbers({0.05, 0.5}),
                    {direction({0, 0.1, 1})},
                    {direction({0.6, 0, 0.8})}});
  const std::vector<Row> planes = fvpl_planes();
  const Tolerance tolerance{2e-3, 1e-5};
  return {
      "fvpl",
      fvpl_comp_spv,
      {{"fvpl_view",
        combinations({offsets(), numbers({1e-4, 1, 1e6, 1e14})}),
        [](Arguments& a) {
          const Vec3 v = a.take3();
          const FvplView view = fvpl_view(v, a.take());
          return Values() << view.u << view.d2 << view.inverse_d2 << view.sharpness;
        },
        {1e-6, 0}},
       {"fvpl_is_point",
        combinations({numbers({0, 99, 101, 1e6}), numbers({0, 5, 30, 1e9})}),
        [](Arguments& a) {
          const double sharpness = a.take();
          return Values() << static_cast<std::uint32_t>(fvpl_is_point(sharpness, a.take()));
        },
        {}},
       {"fvpl_cosine",
        combinations({numbers({-1, -0.2, 0, 0.3, 1}), sharpnesses()}),
        [](Arguments& a) {
          const double c = a.take();
          return fvpl_cosine(c, a.take());
        },
        {0, 1e-5}},
       {"fvpl_specular", combinations({clusters, directions(), numbers({1}), numbers({0.6})}),
        [](Arguments& a) {
          const interop::Cluster c = take_cluster(a);
          const Vec3 w = a.take3();
          const double inverse_d2 = a.take();
          return fvpl_specular(c, w, inverse_d2, a.take());
        },
        tolerance},
       {"fvpl_emission_diffuse",
        combinations({clusters, directions()}),
        [](Arguments& a) {
          const interop::Cluster c = take_cluster(a);
          return Values() << fvpl_emission_diffuse(c, a.take3());
        },
        {0, 1e-6}},
       {"fvpl_emission_flat", combinations({clusters, towards}), emission(fvpl_emission_flat), tolerance,
        wild},
       {"fvpl_emission", combinations({clusters, towards}), emission(fvpl_emission), tolerance, wild},
       {"fvpl_point", combinations({receivers, offsets(), planes}), reflection(fvpl_point), tolerance},
       {"fvpl_fluence",
        combinations({numbers({0, 1e-12, 1e-3, 1, 1e6}), numbers({0, 1e-4, 1, 1e4, 1e12})}),
        [](Arguments& a) {
          const double d2 = a.take();
          return fvpl_fluence(d2, a.take());
        },
        {2e-6, 0}},
       {"fvpl_extended", combinations({receivers, offsets(), planes}), reflection(fvpl_extended), tolerance,
        combinations({receivers,
                      {{0, 0, 0}, {1e-13f, 0, 0}, {1e3f, 0, 2}},
                      combinations({numbers({0, 1e-9, 1e18}), {direction({0, 0, -1})}, numbers({0, 1e6})})})},
       {"fvpl_plane",
        combinations({planes,
                      directions(),
                      {direction({0, 0.1, 1})},
                      numbers({0, 1e-3, 0.5, 1}),
                      numbers({0, 1e-3, 0.1, 10}),
                      numbers({0, 1})}),
        [](Arguments& a) {
          const interop::Cluster c = take_plane(a);
          const Vec3 u = a.take3(), normal = a.take3();
          const double cosine = a.take(), inverse_sharpness = a.take();
          return fvpl_plane(c, u, normal, cosine, inverse_sharpness, a.take());
        },
        {0, 1e-4}},
       {"ggx_spread_d",
        combinations({numbers({1e-6, 0.04, 1}), numbers({0, 1e-3, 0.1, 1}), numbers({0, 1e-6, 0.3, 1}),
                      numbers({0, 0.7, 1})}),
        [](Arguments& a) {
          const double alpha2 = a.take(), spread = a.take(), sin2 = a.take();
          return ggx_spread_d(alpha2, spread, sin2, a.take());
        },
        {1e-5, 0}}}};
}

}  // namespace

std::vector<LibraryFile> light_files() {
  return {vsgl_file(), moments_file(), fvpl_file()};
}

}  // namespace vsgl::test
