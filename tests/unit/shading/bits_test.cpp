// Visibility bits in the kernels.

#include <cstring>

#include "../expect_error.h"
#include "run.h"

namespace vsgl {
namespace {

// Diffuse and glossy pixels, some background, and more lights than one uniform block holds, of all classes.
struct Mixed {
  GBuffer gbuffer = test::box_gbuffer({.width = 12, .height = 7});
  Lights lights = test::box_lights({.lights = 1000, .emission_ndf = interop::NDF_GGX});

  Mixed() {
    const GBuffer glossy = test::box_gbuffer({.width = 12, .height = 7, .receiver_ndf = interop::NDF_GGX});
    for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
      if (i % 3 == 1) gbuffer.pixels[i] = glossy.pixels[i];
      if (i % 7 == 2) gbuffer.pixels[i] = test::background();
    }
    for (std::size_t i = 0; i < lights.lights.size(); i += 3) {
      lights.lights[i].ndf = interop::NDF_NONE;
      lights.lights[i].power_specular = {};
    }
  }

  // What `sees(light, pixel)` says.
  template <class Sees>
  Visibility bits(Sees sees) const {
    VisibilityBits out;
    out.width = gbuffer.width;
    out.height = gbuffer.height;
    out.lights = static_cast<int>(lights.lights.size());
    const std::size_t pixels = gbuffer.pixels.size();
    out.words.resize(pixels * static_cast<std::size_t>(out.words_per_pixel()));
    for (std::uint32_t light = 0; light < lights.lights.size(); ++light)
      for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
        out.words[light / 32 * pixels + pixel] |= (sees(light, pixel) ? 1U : 0U) << light % 32;
    return out;
  }
};

Lights without(Lights lights, bool (*dark)(std::uint32_t)) {
  for (std::uint32_t i = 0; i < lights.lights.size(); ++i)
    if (dark(i)) lights.lights[i].power_diffuse = lights.lights[i].power_specular = {};
  return lights;
}

bool same(const std::vector<interop::vec3>& a, const std::vector<interop::vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

class Bits : public testing::TestWithParam<const char*> {
 protected:
  const Mixed scene_;
  const ShadingParams params_{.light_model = GetParam()};
};

TEST_P(Bits, UnshadowedIsAsWithoutVisibilityBitForBit) {
  const Visibility unshadowed = Unshadowed{1000, {}};
  const Indirect none = test::shade_box(scene_.gbuffer, scene_.lights, params_);
  const Indirect given = test::shade_box(scene_.gbuffer, scene_.lights, params_, &unshadowed);
  EXPECT_TRUE(same(given.diffuse, none.diffuse));
  EXPECT_TRUE(same(given.specular, none.specular));
  const Visibility of_others = Unshadowed{999, {}};
  test::expect_error(ErrorCode::wrong_size, {"visibility", "999", "1000"},
                     [&] { test::shade_box(scene_.gbuffer, scene_.lights, params_, &of_others); });
}

TEST_P(Bits, AllVisibleIsAsWithoutVisibilityBitForBit) {
  const Visibility all = scene_.bits([](auto, auto) { return true; });
  for (const bool skip : {true, false}) {
    ShadingParams params = params_;
    params.skip = skip;
    const Indirect image = test::shade_box(scene_.gbuffer, scene_.lights, params, &all);
    const Indirect open = test::shade_box(scene_.gbuffer, scene_.lights, params);
    EXPECT_TRUE(same(image.diffuse, open.diffuse));
    EXPECT_TRUE(same(image.specular, open.specular));
    EXPECT_EQ(image.cancellation, open.cancellation);
  }
}

TEST_P(Bits, NothingVisibleIsBlack) {
  const Visibility none = scene_.bits([](auto, auto) { return false; });
  const Indirect image = test::shade_box(scene_.gbuffer, scene_.lights, params_, &none);
  for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
    EXPECT_EQ(length(test::to_double(image.diffuse[i])), 0);
    EXPECT_EQ(length(test::specular_of(image, i)), 0);
  }
}

bool chosen(std::uint32_t light) {
  return (light * 2654435761U >> 13 & 1) != 0;
}
bool others(std::uint32_t light) {
  return !chosen(light);
}

// Every other pixel sees the chosen lights, the rest see the others: as if those alone had power.
TEST_P(Bits, EachPixelSeesItsOwnLights) {
  const auto sees = [](std::uint32_t light, std::uint32_t pixel) {
    return chosen(light) == (pixel % 2 == 0);
  };
  const Visibility bits = scene_.bits(sees);
  const Indirect image = test::shade_box(scene_.gbuffer, scene_.lights, params_, &bits);
  const Indirect even = test::shade_box(scene_.gbuffer, without(scene_.lights, others), params_);
  const Indirect odd = test::shade_box(scene_.gbuffer, without(scene_.lights, chosen), params_);
  for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
    const Indirect& expected = i % 2 == 0 ? even : odd;
    const Vec3 diffuse = test::to_double(expected.diffuse[i]), specular = test::specular_of(expected, i);
    EXPECT_LE(length(test::to_double(image.diffuse[i]) - diffuse), 1e-5 * length(diffuse)) << i;
    EXPECT_LE(length(test::specular_of(image, i) - specular), 1e-5 * length(specular)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Bits, testing::Values("fvpl", "vpl", "vsgl", "vsgl-2014"),
                         [](const auto& entry) {
                           std::string name = entry.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Shading, RefusesBitsOfOtherInputs) {
  const Mixed scene;
  const auto expect = [&](ErrorCode code, std::vector<std::string> fragments, auto change) {
    Visibility bits = scene.bits([](auto, auto) { return true; });
    change(std::get<VisibilityBits>(bits));
    test::expect_error(code, fragments, [&] { test::shade_box(scene.gbuffer, scene.lights, {}, &bits); });
  };
  expect(ErrorCode::wrong_size, {"visibility bits", "999", "1000 lights"},
         [](auto& bits) { bits.lights = 999; });
  expect(ErrorCode::wrong_size, {"visibility bits", "7x12", "12x7"},
         [](auto& bits) { std::swap(bits.width, bits.height); });
  expect(ErrorCode::invalid_data, {"visibility bits", "anchor"}, [](auto& bits) { bits.anchor = {1, 0, 0}; });
}

}  // namespace
}  // namespace vsgl
