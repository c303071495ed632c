#include <cmath>

#include "interop/model.h"
#include "math/vsl.h"
#include "shader_library.h"
#include "spirv/test/library/vsl.comp.glsl.h"

namespace vsgl::test {
namespace {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;

auto height(double (*function)(double, double)) {
  return [function](Arguments& a) {
    const double d2 = a.take();
    return function(d2, a.take());
  };
}

std::array<double, 2> take2(Arguments& a) {
  const double x = a.take();
  return {x, a.take()};
}

Scatterer take_scatterer(Arguments& a) {
  Scatterer s;
  s.ndf = a.take_word();
  s.alpha2 = a.take();
  s.specular = a.take();
  s.plane = s.normal = a.take3();
  s.view = a.take3();
  return s;
}

}  // namespace

std::vector<LibraryFile> vsl_files() {
  const std::vector<Row> ndfs = words({NDF_GGX, NDF_BECKMANN, NDF_PHONG});
  const std::vector<Row> points = combinations({numbers({0, 0.1, 0.3, 0.55, 0.95}), numbers({0, 0.2, 0.7})});
  const std::vector<Row> heights = combinations({numbers({0, 1e-6, 1, 4, 1e6}), numbers({1e-9, 0.3, 9})});
  const std::vector<Row> frames = combinations({{direction({0, 0, 1}), direction({0.2, -0.4, 0.7})},
                                                {direction({0, 0, 1}), direction({0.5, 0.3, 0.4})}});
  const std::vector<Row> scatterers =
      combinations({ndfs, numbers({1e-4, 0.04, 1}), numbers({0, 0.4, 1}), frames});
  return {{"vsl",
           vsl_comp_spv,
           {{"disk_cone_height", heights, height(disk_cone_height), {2e-6, 0}},
            {"sphere_cone_height", heights, height(sphere_cone_height), {2e-6, 0}},
            {"cone_direction",
             combinations({directions(), numbers({1e-9, 0.01, 1, 2}), points}),
             [](Arguments& a) {
               const Vec3 axis = a.take3();
               const double cone = a.take();
               return Values() << cone_direction(axis, cone, take2(a));
             },
             {0, 2e-6}},
            {"microfacet_sin2",
             combinations({ndfs, numbers({1e-6, 1e-3, 0.3, 1}), numbers({0, 0.01, 0.5, 0.99, 0.9999})}),
             [](Arguments& a) {
               const std::uint32_t ndf = a.take_word();
               const double alpha2 = a.take();
               return microfacet_sin2(ndf, alpha2, a.take()) / alpha2;
             },
             {3e-4, 6e-7}},  // the logarithm of 1 - u has lost digits where u is small or nearly 1
            {"scatter_direction",
             combinations({scatterers, points}),
             [](Arguments& a) {
               const Scatterer s = take_scatterer(a);
               return Values() << scatter_direction(s, take2(a));
             },
             {0, 2e-5}},
            {"scatter_pdf",
             combinations({scatterers, directions()}),
             [](Arguments& a) {
               const Scatterer s = take_scatterer(a);
               return scatter_pdf(s, a.take3());
             },
             {3e-3, 1e-5}}}}};
}

}  // namespace vsgl::test
