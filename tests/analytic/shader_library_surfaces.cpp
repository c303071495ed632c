#include <cmath>

#include "math/frame.h"
#include "math/mixture_lobe.h"
#include "math/octahedral.h"
#include "math/reflected_lobe.h"
#include "shader_library.h"
#include "spirv/test/library/frame.comp.glsl.h"
#include "spirv/test/library/microfacet.comp.glsl.h"
#include "spirv/test/library/mixture_lobe.comp.glsl.h"
#include "spirv/test/library/octahedral.comp.glsl.h"
#include "spirv/test/library/reflected_lobe.comp.glsl.h"
#include "spirv/test/library/specular_lobe.comp.glsl.h"

namespace vsgl::test {
namespace {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;

LibraryFile frame() {
  const auto twin = [](Arguments& a) {
    const Frame f = frame_about(a.take3());
    return Values() << f.x << f.y << f.z;
  };
  return {"frame", frame_comp_spv, {{"frame_about", directions(), twin, {1e-6, 3e-7}}}};
}

LibraryFile octahedral() {
  const std::vector<Row> squares =
      combinations({numbers({-0.98, -0.3, 0, 0.5, 1}), numbers({-1, -0.01, 0, 0.6, 0.99})});
  const auto square = [](Arguments& a) {
    const double x = a.take();
    return Vec2{x, a.take()};
  };
  return {"octahedral",
          octahedral_comp_spv,
          {{"hemi_octahedral_encode",
            upper_directions(),
            [](Arguments& a) {
              const Vec2 e = hemi_octahedral_encode(a.take3());
              return Values() << e.x << e.y;
            },
            {0, 3e-7}},
           {"hemi_octahedral_point",
            squares,
            [=](Arguments& a) { return Values() << hemi_octahedral_point(square(a)); },
            {0, 3e-7}},
           {"hemi_octahedral_decode",
            squares,
            [=](Arguments& a) { return Values() << hemi_octahedral_decode(square(a)); },
            {0, 1e-6}},
           {"hemi_octahedral_solid_angle",
            combinations({squares, numbers({16, 64})}),
            [=](Arguments& a) {
              const Vec2 e = square(a);
              return hemi_octahedral_solid_angle(e, a.take());
            },
            {1e-6, 0}}}};
}

std::vector<Row> ndfs() {
  return words({NDF_GGX, NDF_BECKMANN, NDF_PHONG});
}
std::vector<Row> squared_alphas() {
  return numbers({1e-6, 1e-4, 0.01, 0.25, 1});
}

// sin2 and cos2 of the same angle; sin2 within a few lobe widths of each alpha.
std::vector<Row> squared_angles() {
  std::vector<Row> rows;
  for (const double sin2 : {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.03, 0.3, 0.499, 0.501, 0.9, 1.0})
    rows.push_back({static_cast<float>(sin2), static_cast<float>(1 - sin2)});
  return rows;
}

// Twin of a function of two or three numbers.
auto two(double (*f)(double, double)) {
  return [f](Arguments& a) {
    const double x = a.take();
    return f(x, a.take());
  };
}
auto three(double (*f)(double, double, double)) {
  return [f](Arguments& a) {
    const double x = a.take(), y = a.take();
    return f(x, y, a.take());
  };
}

// Normal, view: upright, oblique, grazing, below the horizon, behind.
std::vector<Row> normals_and_views() {
  std::vector<Row> rows;
  const Vec3 tilted = normalise(Vec3{0.4, -0.2, 0.8});
  for (const Vec3 view : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0.5, 0.7, 0.2}, Vec3{1, 0, 1e-4},
                          Vec3{1, 0, -0.2}, Vec3{0, 0, -1}})
    rows.push_back(direction(view));
  std::vector<Row> all = combinations({{direction({0, 0, 1})}, rows});
  for (const Row& row : combinations({{direction(tilted)}, {direction(tilted), direction({0.1, 0.3, 1})}}))
    all.push_back(row);
  return all;
}

// Views that are above the horizon only, where the tilted frame's rounding is small against the lobe.
std::vector<Row> upright_views() {
  std::vector<Row> rows;
  for (const Vec3 view : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0.5, 0.7, 0.2}, Vec3{-0.9, 0.1, 0.04}})
    rows.push_back(direction(view));
  return combinations({{direction({0, 0, 1}), direction({0, 0.1, 1})}, rows});
}

LibraryFile microfacet() {
  const std::vector<Row> slopes =
      combinations({squared_alphas(), numbers({-0.5, 0, 1e-5, 1e-3, 0.1, 0.5, 0.99, 1})});
  const std::vector<Row> densities = combinations({squared_alphas(), squared_angles()});
  const std::vector<Row> lights = directions();
  const std::vector<Row> alphas = numbers({1e-3, 0.02, 0.3, 1});
  const auto lobe = [](Arguments& a) {
    const std::uint32_t ndf = a.take_word();
    const double alpha = a.take();
    const Vec3 normal = a.take3();
    const SgLobe l = specular_lobe(ndf, alpha, normal, a.take3());
    return Values() << l.axis << l.sharpness;
  };
  return {"microfacet",
          microfacet_comp_spv,
          {{"ggx_d", densities, three(ggx_d), {1e-6, 0}},
           {"beckmann_d", densities, three(beckmann_d), {1e-4, 1e-30}},
           {"phong_d", densities, three(phong_d), {1e-4, 1e-30}},
           {"ndf_density",
            combinations({ndfs(), densities}),
            [](Arguments& a) {
              const std::uint32_t ndf = a.take_word();
              const double alpha2 = a.take(), sin2 = a.take();
              return ndf_density(ndf, alpha2, sin2, a.take());
            },
            {1e-4, 1e-30}},
           {"ggx_slope_cosine", slopes, two(ggx_slope_cosine), {1e-6, 0}},
           {"ggx_lambda", slopes, two(ggx_lambda), {1e-6, 5e-7}},
           {"beckmann_lambda", slopes, two(beckmann_lambda), {1e-4, 1e-6}},
           {"smith_lambda",
            combinations({ndfs(), slopes}),
            [](Arguments& a) {
              const std::uint32_t ndf = a.take_word();
              const double alpha2 = a.take();
              return smith_lambda(ndf, alpha2, a.take());
            },
            {1e-4, 1e-6}},
           {"ndf_sharpness",
            combinations({ndfs(), alphas}),
            [](Arguments& a) {
              const std::uint32_t ndf = a.take_word();
              return ndf_sharpness(ndf, a.take());
            },
            {1e-6, 1e-6}},
           {"specular_brdf_cos",
            combinations({ndfs(), alphas, normals_and_views(), lights}),
            [](Arguments& a) {
              const std::uint32_t ndf = a.take_word();
              const double alpha = a.take();
              const Vec3 normal = a.take3(), view = a.take3();
              return specular_brdf_cos(ndf, alpha, normal, view, a.take3());
            },
            {2e-3, 1e-6}},
           {"dominant_normal",
            combinations({squared_alphas(), normals_and_views()}),
            [](Arguments& a) {
              const double alpha2 = a.take();
              const Vec3 normal = a.take3();
              return Values() << dominant_normal(alpha2, normal, a.take3());
            },
            {1e-6, 1e-6}},
           {"specular_lobe", combinations({ndfs(), alphas, normals_and_views()}), lobe, {1e-5, 1e-6}}}};
}

SpecularReceiver take_receiver(Arguments& a) {
  const std::uint32_t ndf = a.take_word();
  const double alpha = a.take();
  const Vec3 normal = a.take3();
  return specular_receiver(ndf, alpha, normal, a.take3());
}

Values values_of(const SpecularReceiver& r) {
  return Values() << r.tangent << r.bitangent << r.normal << r.sin_view << r.cos_view << r.alpha2 << r.across
                  << r.across_cos2 << r.alpha2 * r.mirror.x << r.alpha2 * r.mirror.z << r.view_lambda;
}

auto value(double (*method)(const SpecularReceiver&, Vec3, double)) {
  return [method](Arguments& a) {
    const SpecularReceiver r = take_receiver(a);
    const Vec3 axis = a.take3();
    return method(r, axis, a.take());
  };
}

// Alpha 1e-3 resolves directions only to a few hundredths of a lobe in float32: finite is all it can be
// asked to be.
struct LobeRows {
  std::vector<Row> receivers = combinations({ndfs(), numbers({0.02, 0.1, 0.5, 1}), upright_views()});
  std::vector<Row> lights = combinations({directions(), numbers({0, 1e-6, 0.5, 3, 5, 20, 300, 1e4})});
  std::vector<Row> calls = combinations({receivers, lights});
  std::vector<Row> wild =
      combinations({ndfs(), numbers({1e-3, 0.5, 1}), normals_and_views(), directions(), sharpnesses()});
};

LibraryFile specular_lobe_file() {
  const LobeRows rows;
  const auto local = [](Arguments& a, const SpecularReceiver& r) { return specular_local(r, a.take3()); };
  const Tolerance tolerance{2e-3, 1e-5};
  return {"specular_lobe",
          specular_lobe_comp_spv,
          {{"specular_receiver",
            combinations({ndfs(), numbers({1e-3, 0.1, 1}), normals_and_views()}),
            [](Arguments& a) { return values_of(take_receiver(a)); },
            {1e-4, 1e-5}},
           {"specular_local",
            combinations({{rows.receivers[0]}, directions()}),
            [=](Arguments& a) { return Values() << local(a, take_receiver(a)); },
            {0, 3e-7}},
           {"specular_horizon",
            rows.calls,
            [=](Arguments& a) {
              const SpecularReceiver r = take_receiver(a);
              const Vec3 light = local(a, r);
              const SpecularHorizon h = specular_horizon(r, light, a.take());
              return Values() << h.visible << h.visible * h.cosine;
            },
            {2e-3, 1e-4}},
           {"specular_filter",
            rows.calls,
            [=](Arguments& a) {
              const SpecularReceiver r = take_receiver(a);
              const Vec3 light = local(a, r);
              const SpecularFilter f = specular_filter(r, light, a.take());
              return Values() << f.density << f.slope_cosine;
            },
            {1e-3, 1e-6}},
           {"specular_vmf_filtered", rows.calls, value(specular_vmf_filtered), tolerance, rows.wild},
           {"specular_vmf_ggx", rows.calls, value(specular_vmf_ggx), tolerance, rows.wild},
           {"specular_vmf_gaussian", rows.calls, value(specular_vmf_gaussian), tolerance, rows.wild},
           {"specular_vmf_blend", rows.calls, value(specular_vmf_blend), tolerance, rows.wild},
           {"specular_vmf_projected", rows.calls, value(specular_vmf_projected), tolerance, rows.wild},
           {"specular_vmf_ndf_filter", rows.calls, value(specular_vmf_ndf_filter), tolerance, rows.wild}}};
}

// A twin of what a light of an axis and a sharpness gives a receiver.
template <class Twin>
auto of_light(Twin twin) {
  return [twin](Arguments& a) {
    const SpecularReceiver r = take_receiver(a);
    const Vec3 light = specular_local(r, a.take3());
    return twin(r, light, a.take());
  };
}

LibraryFile mixture_lobe_file() {
  const LobeRows rows;
  using R = const SpecularReceiver&;
  const auto spread = [](R r, Vec3, double sharpness) {
    const MixtureSpread s = mixture_spread(r, sharpness);
    return Values() << s.par << s.perp << s.broad << s.plane;
  };
  const auto half_vector = [](R r, Vec3 light, double) {
    const HalfVector h = mixture_half_vector(r, light);
    return Values() << h.x << h.y;
  };
  const auto split = [](R r, Vec3, double sharpness) {
    const MixtureSplit s = mixture_split(r, sharpness);
    return Values() << s.x << s.tau;
  };
  const auto peak = [](R r, Vec3 light, double sharpness) {
    const MixturePeak p = mixture_peak(r, mixture_spread(r, sharpness), light, sharpness,
                                       mixture_half_vector(r, light), 0.5, 1);
    return Values() << p.h.x << p.h.y << p.cos2 << std::exp(-p.exponent) << p.scale;
  };
  const auto tail = [](R r, Vec3 light, double sharpness) {
    const MixtureSpread s = mixture_spread(r, sharpness);
    const HalfVector h = mixture_half_vector(r, light);
    return mixture_tail(s, mixture_split(r, sharpness).x, {h.x * h.x, h.y * h.y});
  };
  const auto turn = [](R r, Vec3 light, double) {
    const HalfVector h = mixture_half_vector(r, light);
    return Values() << mixture_turn(r, light, {0.7 * h.x, 0.7 * h.y});
  };
  const Tolerance tolerance{4e-3, 1e-5};
  return {"mixture_lobe",
          mixture_lobe_comp_spv,
          {{"mixture_incomplete",
            powers(1e-6, 1e4, 1.3),
            [](Arguments& a) { return mixture_incomplete(a.take()); },
            {3e-5, 0}},
           {"mixture_spread", rows.calls, of_light(spread), {1e-4, 0}},
           {"mixture_half_vector", rows.calls, of_light(half_vector), {1e-5, 3e-4}},
           {"mixture_split", rows.calls, of_light(split), {1e-4, 0}},
           {"mixture_peak", rows.calls, of_light(peak), {5e-3, 3e-4}},
           {"mixture_tail", rows.calls, of_light(tail), {1e-3, 1e-6}},
           {"mixture_density", rows.calls, of_light(mixture_density), tolerance},
           {"specular_vmf_mixture", rows.calls, value(specular_vmf_mixture), tolerance, rows.wild},
           {"mixture_turn", rows.calls, of_light(turn), {3e-4, 2e-5}},
           {"mixture_direction",
            combinations({ndfs(), numbers({0, 1e-4, 0.1, 0.29, 0.9, 2})}),
            [](Arguments& a) {
              const std::uint32_t ndf = a.take_word();
              return mixture_direction(ndf, a.take());
            },
            {1e-6, 0}}}};
}

LibraryFile reflected_lobe_file() {
  const LobeRows rows;
  const Tolerance tolerance{2e-3, 1e-5};
  return {"reflected_lobe",
          reflected_lobe_comp_spv,
          {{"specular_coefficient",
            combinations({rows.receivers, numbers({-0.1, 0, 1e-4, 0.3, 1})}),
            [](Arguments& a) {
              const SpecularReceiver r = take_receiver(a);
              return specular_coefficient(r, a.take());
            },
            {2e-4, 1e-5}},
           {"reflected_local",
            combinations({rows.receivers, directions()}),
            [](Arguments& a) {
              const SpecularReceiver r = take_receiver(a);
              return Values() << reflected_local(r, a.take3());
            },
            {0, 5e-7}},
           {"reflected_bandwidths",
            rows.receivers,
            [](Arguments& a) {
              const ReflectedBandwidths b = reflected_bandwidths(take_receiver(a));
              return Values() << b.x << b.y;
            },
            {1e-5, 0}},
           {"specular_vmf_sg", rows.calls, value(specular_vmf_sg), tolerance, rows.wild},
           {"specular_asg_convolved", rows.calls, value(specular_asg_convolved), tolerance},
           {"specular_vmf_asg", rows.calls, value(specular_vmf_asg), tolerance, rows.wild},
           {"asg_product",
            combinations({directions(), numbers({0.25, 60, 1e5}), numbers({0.25, 60, 1e4}),
                          numbers({0, 1e-6, 1, 50, 1e4})}),
            [](Arguments& a) {
              const Vec3 light = a.take3();
              const double eta_x = a.take(), eta_y = a.take();
              const AsgProduct p = asg_product(light, eta_x, eta_y, a.take());
              return Values() << p.axis << p.exponent << p.integral;
            },
            {1e-4, 1e-4}},
           {"specular_vmf_asg_asg", rows.calls, value(specular_vmf_asg_asg), {2e-3, 1e-4}, rows.wild}}};
}

}  // namespace

std::vector<LibraryFile> surface_files() {
  return {
      frame(), octahedral(), microfacet(), specular_lobe_file(), mixture_lobe_file(), reflected_lobe_file()};
}

}  // namespace vsgl::test
