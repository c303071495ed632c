#include <algorithm>
#include <cmath>

#include "math/kernel_size.h"
#include "math/metropolis.h"
#include "math/sampling.h"
#include "math/subdivision.h"
#include "shader_library.h"
#include "spirv/test/library/hash.comp.glsl.h"
#include "spirv/test/library/kernel_size.comp.glsl.h"
#include "spirv/test/library/metropolis.comp.glsl.h"
#include "spirv/test/library/sampling.comp.glsl.h"
#include "spirv/test/library/subdivision.comp.glsl.h"
#include "spirv/test/library/taps.comp.glsl.h"

namespace vsgl::test {
namespace {

constexpr int size = 16, top = 4, layers = 2;  // of shaders/test/library/density.glsl
constexpr double texels = layers * size * size;

// Smooth and positive in layer 0; sparse, with a sharp peak, in layer 1.
const std::vector<std::vector<float>>& pyramids() {
  static const std::vector<std::vector<float>> both = [] {
    std::vector<float> smooth, sparse;
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        smooth.push_back(static_cast<float>(0.2 + std::pow(std::sin(0.3 * i + 0.1 * j), 2)));
        sparse.push_back(i == 5 && j == 9 ? 40.0f : (i + 2 * j) % 7 == 0 ? 1.5f : 0.0f);
      }
    return std::vector<std::vector<float>>{mean_pyramid(smooth, size), mean_pyramid(sparse, size)};
  }();
  return both;
}

DensityPyramid density(std::uint32_t layer) {
  return {size, pyramids()[layer]};
}

std::vector<float> appendix() {
  std::vector<float> all;
  for (const std::vector<float>& pyramid : pyramids()) all.insert(all.end(), pyramid.begin(), pyramid.end());
  return all;
}

std::vector<Row> positions() {
  return combinations({numbers({0, 0.03, 0.34, 0.61, 0.999}), numbers({0.01, 0.27, 0.58, 1})});
}

LibraryFile taps() {
  const auto corners = [](Arguments& a) {
    const double x = a.take(), y = a.take();
    const int side = static_cast<int>(a.take_word());
    Values values;
    for (int k = 0; k < 4; ++k) {
      const double tx = x * side - 0.5, ty = y * side - 0.5;
      const int i = static_cast<int>(std::floor(tx)) + k % 2, j = static_cast<int>(std::floor(ty)) + k / 2;
      const double fx = tx - std::floor(tx), fy = ty - std::floor(ty);
      values << 1.0 * std::clamp(i, 0, side - 1) << 1.0 * std::clamp(j, 0, side - 1)
             << (k % 2 == 0 ? 1 - fx : fx) * (k / 2 == 0 ? 1 - fy : fy);
    }
    return values;
  };
  const auto offset = [](Arguments& a) {
    const int side = static_cast<int>(a.take_word());
    return Values() << static_cast<std::uint32_t>(pyramid_offset(side, static_cast<int>(a.take_word())));
  };
  return {"taps",
          taps_comp_spv,
          {{"bilinear_taps", combinations({positions(), words({1, 16, 4096})}), corners, {0, 1e-3}},
           {"pyramid_offset", combinations({words({4096}), words({0, 1, 2, 5, 11, 12})}), offset, {}}}};
}

std::vector<Row> point_sets() {
  std::vector<Row> rows;
  for (const std::uint32_t kind :
       {interop::POINTS_LATTICE, interop::POINTS_FIBONACCI, interop::POINTS_RANDOM})
    for (const std::uint32_t count : {1u, 13u, 1024u, 1048576u}) {
      const interop::PointSet s = make_point_set(kind, count, 0x123456789abcull);
      Row set;
      for (const std::uint32_t x :
           {s.kind, s.count, s.generator, s.rotation.x, s.rotation.y, s.seed.x, s.seed.y})
        set.push_back(word(x));
      for (const std::uint32_t i : {0u, 1u, count / 3, count - 1}) {
        rows.push_back(set);
        rows.back().push_back(word(std::min(i, count - 1)));
      }
    }
  return rows;
}

interop::PointSet take_set(Arguments& a) {
  interop::PointSet s;
  for (std::uint32_t* x :
       {&s.kind, &s.count, &s.generator, &s.rotation.x, &s.rotation.y, &s.seed.x, &s.seed.y})
    *x = a.take_word();
  return s;
}

Values choose(Arguments& a) {
  const double first = a.take(), second = a.take(), u = a.take();
  const double share = first + second > 0 ? first / (first + second) : 0.5;
  const double rest = u < share ? u / share : (u - share) / (1 - share);
  return Values() << (u < share ? 0.0 : 1.0) << rest;
}

Values warped(Arguments& a) {
  const double x = a.take(), y = a.take();
  const std::vector<DensityPyramid> both{density(0), density(1)};
  const WarpedPoint p = warp(both, {x, y});
  return Values() << Vec3{1.0 * p.layer, 1.0 * p.i, 1.0 * p.j} << p.x * size - p.i << p.y * size - p.j;
}

LibraryFile hash() {
  const auto hashed = [](Arguments& a) {
    const std::uint32_t x = a.take_word(), y = a.take_word();
    const auto v = pcg3d({x, y, a.take_word()});
    const auto bits = r2_bits(v[2]);
    return Values() << v[0] << v[1] << v[2] << std::ldexp(v[0] >> 8, -24) << std::ldexp(v[1] >> 8, -24)
                    << bits[0] << bits[1];
  };
  return {"hash",
          hash_comp_spv,
          {{"pcg3d, point_of_bits, r2_bits",
            combinations({words({0, 1, 0xffffffff}), words({0, 77}), words({5, 0x80000000})}),
            hashed,
            {}}}};
}

LibraryFile sampling() {
  const auto fraction = [](Arguments& a) {
    const std::uint64_t numerator = a.take_word(), denominator = a.take_word();
    return Values() << static_cast<std::uint32_t>((numerator << 32) / denominator);
  };
  const auto product = [](Arguments& a) {
    const std::uint64_t x = a.take_word(), y = a.take_word(), n = a.take_word();
    return Values() << static_cast<std::uint32_t>(x * y % n);
  };
  const auto golden = [](Arguments& a) {  // upper word of the product's lower 64 bits
    return Values() << static_cast<std::uint32_t>(a.take_word() * 0x9E3779B97F4A7C15ull >> 32);
  };
  const auto point = [](Arguments& a) {
    const interop::PointSet s = take_set(a);
    const std::uint32_t i = a.take_word();
    const auto bits = point_bits(s, i);
    return Values() << bits[0] << bits[1];
  };
  return {"sampling",
          sampling_comp_spv,
          {{"fraction_bits",
            combinations({words({0, 1, 1000, 524286}), words({524287, 1048576, 2097152})}),
            fraction,
            {}},
           {"multiply_mod",
            combinations({words({0, 1, 77777, 900000}), words({3, 1023, 524287}), words({900001, 1048576})}),
            product,
            {}},
           {"golden_bits", words({0, 1, 2, 1000, 1048575}), golden, {}},
           {"point_bits", point_sets(), point, {}},
           {"warp_choose",
            combinations({numbers({0, 0.3, 2}), numbers({0.5, 7}), numbers({0.01, 0.2, 0.9})}),
            choose,
            {1e-5, 1e-6}},
           {"warp_texel",
            combinations({numbers({0.003, 0.21, 0.5003, 0.77, 0.9991}), numbers({0.0021, 0.333, 0.71, 0.9})}),
            warped,
            {0, 1e-3}}},
          appendix()};
}

LibraryFile subdivision() {
  const auto root = [](Arguments& a) { return Values() << integer_root(a.take_word()); };
  const auto point = [](Arguments& a) {
    const std::uint32_t k = a.take_word(), cell = a.take_word();
    const double x = a.take();
    return Values() << subdivision_point(k, cell, {x, a.take()});
  };
  // Just below, at and above squares.
  std::vector<Row> squares = words({0, 1, 2, 3, 0xffffffff});
  for (const std::uint32_t r : {2u, 1000u, 4097u, 65535u})
    for (const std::uint32_t x : {r * r - 1, r * r, r * r + 1}) squares.push_back({word(x)});
  return {"subdivision",
          subdivision_comp_spv,
          {{"integer_root", squares, root, {}},
           {"subdivision_point",
            combinations({words({2048}), words({0, 1, 2, 3, 8, 4194303, 1047551}), numbers({0, 0.3}),
                          numbers({0, 0.4})}),
            point,
            {1e-6, 1e-6}}}};
}

LibraryFile kernel_size() {
  const std::vector<Row> centres = combinations({words({0, 1}), positions()});
  const auto bilinear = [](Arguments& a) {
    const std::uint32_t layer = a.take_word();
    const int level = static_cast<int>(a.take_word());
    const double x = a.take();
    return density_bilinear(density(layer), level, x, a.take());
  };
  const auto trilinear = [](Arguments& a) {
    const std::uint32_t layer = a.take_word();
    const double level = a.take(), x = a.take();
    return density_trilinear(density(layer), level, x, a.take());
  };
  const auto fraction = [](Arguments& a) {  // by bisection
    const double p = a.take(), q = a.take(), c = a.take();
    double lower = 0, upper = 1;
    for (int i = 0; i < 60; ++i) {
      const double s = 0.5 * (lower + upper);
      (std::pow(4, s) * (p + (q - p) * s) < c ? lower : upper) = s;
    }
    return lower;
  };
  const auto newton = [](Arguments& a) {
    const std::uint32_t layer = a.take_word();
    const double x = a.take(), y = a.take();
    return kernel_level_newton(density(layer), x, y, texels, a.take());
  };
  const auto bisection = [](Arguments& a) {
    const std::uint32_t layer = a.take_word();
    const double x = a.take(), y = a.take();
    return kernel_level_bisection(density(layer), x, y, texels, a.take(), 12);
  };
  const auto from_density = [](Arguments& a) {
    const double p = a.take();
    return kernel_level_density(p, top, texels, a.take());
  };
  // c between F(0) = a and F(1) = 4 b.
  const std::vector<Row> brackets{{1, 1, 2},      {1, 1, 3.9f},    {0, 1, 1},
                                  {0.01f, 5, 12}, {3, 0.9f, 3.3f}, {1, 2, 1.001f}};
  const std::vector<Row> shares = numbers({1e-4, 0.004, 0.03, 0.2, 4});
  return {"kernel_size",
          kernel_size_comp_spv,
          {{"density_bilinear",
            combinations({words({0, 1}), words({0, 1, 3, 4}), positions()}),
            bilinear,
            {1e-5, 1e-5}},
           {"density_trilinear",
            combinations({words({0, 1}), numbers({0, 0.3, 2, 3.7, 4}), positions()}),
            trilinear,
            {1e-5, 1e-5}},
           {"kernel_fraction", brackets, fraction, {0, 1e-3}},
           {"kernel_level_newton", combinations({centres, shares}), newton, {0, 1e-3}},
           {"kernel_level_bisection", combinations({centres, shares}), bisection, {0, 1.1e-3}},
           {"kernel_level_density",
            combinations({numbers({1e-3, 0.3, 1, 40}), shares}),
            from_density,
            {0, 1e-5}}},
          appendix()};
}

interop::Chain take_chain(Arguments& a) {
  const std::uint32_t x = a.take_word(), y = a.take_word();
  return {x, y, a.take_word()};
}
Values values_of(const interop::Chain& chain) {
  return Values() << chain.x << chain.y << chain.layer;
}

LibraryFile metropolis() {
  const auto propose = [](Arguments& a) {
    const interop::Chain chain = take_chain(a);
    const std::uint32_t index = a.take_word(), step = a.take_word(), low = a.take_word();
    const std::uint64_t seed = low | std::uint64_t{a.take_word()} << 32;
    const float large_step = a.take_float();
    const std::uint32_t layers_there = a.take_word();
    const Proposal next =
        chain_propose(chain, index, step, seed, large_step, layers_there, static_cast<int>(a.take_word()));
    return values_of(next.chain) << static_cast<double>(next.threshold);
  };
  const auto accepts = [](Arguments& a) {
    const float p = a.take_float(), proposed = a.take_float();
    return Values() << (chain_accepts(p, proposed, a.take_float()) ? 1u : 0u);
  };
  const auto place = [](Arguments& a) {
    const interop::Chain chain = take_chain(a);
    const int level = static_cast<int>(a.take_word());
    const auto texel = chain_texel(chain, level);
    const auto at = chain_point(chain, level);
    const interop::Chain again = chain_at(chain.layer, texel, at, level);
    return Values() << texel[0] << texel[1] << at[0] << at[1] << again.x << again.y << again.layer;
  };
  const std::vector<Row> chains = combinations(
                             {words({0, 0x12345678, 0xffffffff}), words({7, 0x80000000}), words({0, 5})}),
                         tops = words({0, 3, 9, 12});
  return {"metropolis",
          metropolis_comp_spv,
          {{"chain_propose",
            combinations({chains, words({0, 1023}), words({0, 77}), words({3}), words({0, 9}),
                          numbers({0, 0.3, 1}), words({1, 6}), tops}),
            propose,
            {}},
           {"chain_accepts",
            combinations({numbers({0, 0.5, 3}), numbers({0, 0.5, 3}), numbers({0, 0.1, 0.999})}),
            accepts,
            {}},
           {"chain_texel", combinations({chains, tops}), place, {}}}};
}

}  // namespace

std::vector<LibraryFile> sampling_files() {
  return {taps(), hash(), sampling(), kernel_size(), subdivision(), metropolis()};
}

}  // namespace vsgl::test
