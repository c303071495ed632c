#include <cmath>

#include "math/lobe.h"
#include "math/sg.h"
#include "shader_library.h"
#include "spirv/test/library/lobe.comp.glsl.h"
#include "spirv/test/library/sg.comp.glsl.h"
#include "spirv/test/library/special.comp.glsl.h"

namespace vsgl::test {
namespace {

std::vector<Row> cosines() {
  return numbers({-1, -0.99, -0.6, -0.1, 0, 1e-3, 0.1, 0.7, 0.999, 1});
}
// The same, and those of vectors a little too long.
std::vector<Row> long_cosines() {
  return numbers({-1.000001, -1, -0.99, -0.6, -0.1, 0, 1e-3, 0.1, 0.7, 0.999, 1, 1.0000002, 1.000001});
}

LibraryFile special() {
  const std::vector<Row> arguments =
      numbers({-80, -30, -5, -1, -0.7, -0.5, -0.1, -1e-3, -1e-6, -1e-20, 0, 1e-9, 1e-3, 0.3, 0.4, 2, 20, 60});
  return {"special",
          special_comp_spv,
          {{"expm1", arguments, [](Arguments& a) { return std::expm1(a.take()); }, {2e-7, 0}},
           {"phi", arguments, [](Arguments& a) { return phi(a.take()); }, {3e-7, 0}},
           {"erfc_scaled",
            powers(1e-3, 5, 1.3),
            [](Arguments& a) {
              const double x = a.take();
              return std::exp(x * x) * std::erfc(x);
            },
            {0, 5e-3}},
           {"erfc",
            numbers({-30, -3, -1, -0.2, -1e-4, 0, 1e-3, 0.05, 0.3, 0.9, 1.5, 2.5, 4, 9, 1e4}),
            [](Arguments& a) { return std::erfc(a.take()); },
            {0, 5e-7}}}};
}

Values values_of(const SgLobe& l) {
  return Values() << l.axis << l.sharpness;
}
Values values_of(const LobeMoments& m) {
  return Values() << m.mean << m.deficit;
}

// Lobes from aligned to opposite, where the plain forms of the exponent cancel.
std::vector<Row> lobe_pairs() {
  const double pi = 3.14159265358979;
  std::vector<Row> axes;
  for (const double angle : {0.0, 1e-5, 1e-3, 0.1, 1.5, 1.6, 3.0, pi - 1e-3, pi})
    axes.push_back(direction({std::sin(angle), 0, std::cos(angle)}));
  return combinations(
      {{direction({0, 0, 1})}, numbers({0, 1e-3, 1, 300, 1e6, 1e12}), axes, numbers({0, 2, 299, 1e5, 1e12})});
}

LibraryFile sg() {
  const auto product = [](Arguments& a) {
    const Vec3 axis = a.take3();
    const double sharpness = a.take();
    const Vec3 other = a.take3();
    const double other_sharpness = a.take();
    const SgProduct p = sg_product(axis, sharpness, other, other_sharpness);
    // The axis as far as the lobes agree on it.
    const double agreement = p.sharpness / std::max(sharpness + other_sharpness, 1e-30);
    return Values() << agreement * p.axis << p.sharpness << p.exponent;
  };
  return {"sg",
          sg_comp_spv,
          {{"sg_value",
            combinations({directions(), directions(), numbers({0, 1e-3, 1, 50})}),
            [](Arguments& a) {
              const Vec3 w = a.take3(), axis = a.take3();
              return sg_value(w, axis, a.take());
            },
            {2e-5, 1e-30}},
           {"sg_integral", sharpnesses(), [](Arguments& a) { return sg_integral(a.take()); }, {3e-7, 0}},
           {"sg_product", lobe_pairs(), product, {1e-6, 5e-6}},
           {"vmf_hemisphere",
            combinations({cosines(), sharpnesses()}),
            [](Arguments& a) {
              const double c = a.take();
              return vmf_hemisphere(c, a.take());
            },
            {0, 5e-5}},
           {"cosine_mean",
            combinations({long_cosines(), sharpnesses()}),
            [](Arguments& a) {
              const double c = a.take();
              return cosine_mean(c, a.take());
            },
            {0, 1e-5}},
           {"cosine_integral",
            combinations({cosines(), sharpnesses()}),
            [](Arguments& a) {
              const double c = a.take();
              return cosine_integral(c, a.take());
            },
            {0, 5e-5}}}};
}

std::vector<Row> encoded_lobes(double sharpest = 1e10) {
  std::vector<Row> rows;
  for (const double sharpness : {0.1, 1.0, 2.2925, 30.0, 1e4, 1e7, 1e10}) {
    if (sharpness > sharpest) break;
    const LobeMoments m = lobe_encode(normalise(Vec3{1, -2, 0.5}), sharpness);
    Row row;
    for (const double x : {m.mean.x, m.mean.y, m.mean.z, m.deficit}) row.push_back(static_cast<float>(x));
    rows.push_back(row);
  }
  rows.push_back({0, 0, 0, 1});                  // no direction
  rows.push_back({0, 0, 0, 0});                  // empty
  rows.push_back({0, 0.6f, 0.8f, 0});            // perfectly sharp
  rows.push_back({1e-3f, 1e-3f, 0, 0.999998f});  // almost none
  return rows;
}

LibraryFile lobe() {
  const auto encode = [](LobeMoments (*function)(Vec3, double)) {
    return [function](Arguments& a) {
      const Vec3 axis = a.take3();
      return values_of(function(axis, a.take()));
    };
  };
  const auto decode = [](SgLobe (*function)(const LobeMoments&)) {
    return [function](Arguments& a) {
      const Vec3 mean = a.take3();
      return values_of(function({mean, a.take()}));
    };
  };
  const auto encode_by = [](Arguments& a) {
    const std::uint32_t kind = a.take_word();
    const Vec3 axis = a.take3();
    return values_of(lobe_encode_by(kind, axis, a.take()));
  };
  const auto decode_by = [](Arguments& a) {
    const std::uint32_t kind = a.take_word();
    const Vec3 mean = a.take3();
    return values_of(lobe_decode_by(kind, {mean, a.take()}));
  };
  const std::vector<Row> lobes = combinations({{direction({1, 2, -2})}, sharpnesses()}),
                         broad =
                             combinations({{direction({1, 2, -2})}, numbers({0, 1e-3, 0.3, 2.2925, 12, 30})}),
                         kinds = words({interop::LOBE_BANERJEE, interop::LOBE_TOKSVIG,
                                        interop::LOBE_LAURIJSSEN, interop::LOBE_NONE});
  return {"lobe",
          lobe_comp_spv,
          {{"lobe_one_minus_length",
            sharpnesses(),
            [](Arguments& a) { return lobe_one_minus_length(a.take()); },
            {2e-7, 0}},
           {"lobe_encode", lobes, encode(lobe_encode), {4e-7, 1e-15}},
           {"lobe_sharpness",
            combinations({numbers({0, 1e-3, 0.5, 1}), numbers({0, 1e-12, 1e-3, 0.7, 1})}),
            [](Arguments& a) {
              const double r = a.take();
              return lobe_sharpness(r, a.take());
            },
            {4e-7, 0}},
           {"lobe_decode", encoded_lobes(), decode(lobe_decode), {1e-6, 1e-7}},
           {"toksvig_encode", lobes, encode(toksvig_encode), {4e-7, 1e-15}},
           {"toksvig_decode", encoded_lobes(), decode(toksvig_decode), {1e-6, 1e-7}},
           // Cancellation in float32 (see there), by the arc tangent's 4096 ulp that Vulkan allows: broad
           // lobes only, and all others finite.
           {"laurijssen_encode", broad, encode(laurijssen_encode), {2e-6, 1e-3}, lobes},
           {"laurijssen_decode", encoded_lobes(30), decode(laurijssen_decode), {2e-5, 1e-6}, encoded_lobes()},
           {"lobe_encode_by", combinations({kinds, broad}), encode_by, {2e-6, 1e-3}},
           {"lobe_decode_by", combinations({kinds, encoded_lobes(30)}), decode_by, {2e-5, 1e-6}}}};
}

}  // namespace

std::vector<LibraryFile> gaussian_files() {
  return {special(), sg(), lobe()};
}

}  // namespace vsgl::test
