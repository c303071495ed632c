#include <gtest/gtest.h>

#include <numbers>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "stages/lights/lights.h"

namespace vsgl {
namespace {

using interop::Light;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

Lights generate(const Rsm& rsm, const std::string& method, const std::string& lobe_filter = "banerjee") {
  LightsParams params;
  params.method = method;
  params.lobe_filter = lobe_filter;
  Report report;
  return generate_lights(rsm, nullptr, params, &device(), report);
}

constexpr int kSize = 64;

using Texel = std::function<DoubleMoments(double x, double y)>;  // of the layer's square, 0..1

// A layer of the room with other texels.
Rsm make_rsm(const Texel& texel) {
  Rsm rsm = test::room_rsm(kSize);
  std::vector<DoubleMoments> level0;
  for (int j = 0; j < kSize; ++j)
    for (int i = 0; i < kSize; ++i) level0.push_back(texel((i + 0.5) / kSize, (j + 0.5) / kSize));
  rsm.layers[0].pyramid = test::moment_pyramid(std::move(level0), kSize);
  return rsm;
}

interop::Surface surface(Vec3 position, Vec3 normal, double diffuse, double specular) {
  interop::Surface s{};
  s.position = test::to_float(position);
  s.normal = s.shading_normal = test::to_float(normal);
  s.diffuse = test::to_float(Vec3{diffuse, diffuse, diffuse});
  s.specular = test::to_float(Vec3{specular, specular, specular});
  s.alpha = 0.3f;
  s.ndf = specular > 0 ? interop::NDF_GGX : interop::NDF_NONE;
  return s;
}

double power(const Light& light) {
  return luminance(test::to_double(light.power_diffuse) + test::to_double(light.power_specular));
}

TEST(TwoVsgl, PowersAreThoseOfTheRsm) {
  for (const Rsm& rsm : {test::room_rsm(kSize, 2), test::room_rsm(16), test::room_rsm(4, 2)}) {
    Vec3 diffuse, specular;
    for (const RsmLayer& layer : rsm.layers)
      for (int k = 0; k < rsm.size * rsm.size; ++k) {
        diffuse += test::to_double(layer.pyramid[static_cast<std::size_t>(k)].power_diffuse);
        specular += test::to_double(layer.pyramid[static_cast<std::size_t>(k)].power_specular);
      }
    const Lights lights = generate(rsm, "two-vsgl");
    ASSERT_EQ(lights.lights.size(), 2u);
    EXPECT_NEAR(length(test::to_double(lights.lights[0].power_diffuse) - diffuse), 0, 1e-6 * length(diffuse));
    EXPECT_NEAR(length(test::to_double(lights.lights[1].power_specular) - specular), 0,
                1e-6 * length(specular));
    EXPECT_EQ(test::to_double(lights.lights[0].power_specular), Vec3{});
    EXPECT_EQ(test::to_double(lights.lights[1].power_diffuse), Vec3{});
  }
}

TEST(TwoVsgl, OneTexelIsThatTexel) {
  const auto lit = surface({0.4, 0.2, -0.7}, normalise(Vec3{0.3, 1, 0.2}), 0.5, 0.2);
  const Rsm rsm = make_rsm([&](double x, double y) {
    const bool here = static_cast<int>(x * kSize) == 13 && static_cast<int>(y * kSize) == 41;
    return here ? test::reflect(lit, {3, 4, 5}, normalise(Vec3{-0.5, 1, 0}), 0.02) : DoubleMoments{};
  });
  const Lights whole = generate(rsm, "texels"), lights = generate(rsm, "two-vsgl");
  ASSERT_EQ(whole.lights.size(), 1u);
  ASSERT_EQ(lights.lights.size(), 2u);
  const Light &texel = whole.lights[0], &diffuse = lights.lights[0], &specular = lights.lights[1];
  for (const Light& light : lights.lights) {
    EXPECT_EQ(light.texel, 41u * kSize + 13u);
    EXPECT_NEAR(length(test::to_double(light.position) - test::to_double(texel.position)), 0, 1e-6);
    EXPECT_NEAR(light.variance / texel.variance, 1, 1e-5);
    EXPECT_NEAR(length(test::to_double(light.normal) - test::to_double(texel.normal)), 0, 1e-6);
    EXPECT_EQ(test::to_double(light.origin), test::to_double(texel.origin));
  }
  EXPECT_NEAR(diffuse.diffuse_sharpness / texel.diffuse_sharpness, 1, 1e-5);
  EXPECT_NEAR(length(test::to_double(diffuse.diffuse_axis) - test::to_double(texel.diffuse_axis)), 0, 1e-6);
  EXPECT_NEAR(specular.specular_sharpness / texel.specular_sharpness, 1, 1e-4);
  EXPECT_NEAR(length(test::to_double(specular.specular_axis) - test::to_double(texel.specular_axis)), 0,
              1e-6);
  EXPECT_NEAR(power(diffuse) + power(specular), power(texel), 1e-6 * power(texel));
}

// A uniform disk of radius r has E|y - mean|^2 = r^2 / 2, and the light's variance is half of that.
TEST(TwoVsgl, DiskHasTheSecondMomentOfADisk) {
  const double radius = 0.8, texel = 2.0 / kSize;
  const Rsm rsm = make_rsm([&](double x, double y) {
    const Vec3 at{2 * x - 1, 2 * y - 1, 0};
    if (length(at) > radius) return DoubleMoments{};
    return test::reflect(surface(at, {0, 0, 1}, 0.5, 0), {1, 1, 1}, {0, 0, 1}, texel * texel / 6);
  });
  const Lights lights = generate(rsm, "two-vsgl");
  ASSERT_EQ(lights.lights.size(), 1u);  // nothing is specular
  EXPECT_NEAR(double(lights.lights[0].variance) / (radius * radius / 4), 1, 0.01);
  EXPECT_NEAR(length(test::to_double(lights.lights[0].position)), 0, 1e-6);
  EXPECT_NEAR(lights.lights[0].diffuse_sharpness, interop::LAMBDA_DIFFUSE, 1e-4);
}

// Where only one component reflects, the weights are those of the moment pyramid.
TEST(TwoVsgl, OneComponentIsThePyramidsTop) {
  for (const bool specular : {false, true}) {
    const Rsm rsm = make_rsm([&](double x, double y) {
      const Vec3 at{x, 0.3 * std::sin(5 * x), y}, normal = normalise(Vec3{-std::cos(5 * x), 1, 0.2 * y});
      return test::reflect(surface(at, normal, specular ? 0 : 0.1 + 0.8 * y, specular ? 0.1 + 0.8 * x : 0),
                           {1, 2, 3}, {0, 1, 0}, 1e-4);
    });
    const Lights lights = generate(rsm, "two-vsgl");
    ASSERT_EQ(lights.lights.size(), 1u);
    const Light& light = lights.lights[0];
    const interop::Moments& top = rsm.layers[0].pyramid.back();
    const SgLobe lobe = specular ? lobe_decode({test::to_double(top.specular_mean), top.specular_deficit})
                                 : lobe_decode({test::to_double(top.diffuse_mean), top.diffuse_deficit});
    EXPECT_NEAR(length(test::to_double(light.position) - test::to_double(top.position)), 0, 1e-6);
    EXPECT_NEAR(light.variance / (0.5f * top.spread), 1, 1e-5);
    EXPECT_NEAR(double(specular ? light.specular_sharpness : light.diffuse_sharpness) / lobe.sharpness, 1,
                1e-4);
    EXPECT_NEAR(length(test::to_double(specular ? light.specular_axis : light.diffuse_axis) - lobe.axis), 0,
                1e-5);
    EXPECT_NEAR(light.normal_deficit, top.normal_deficit, 1e-5);
    EXPECT_EQ(light.level, 6);
  }
}

// Each component by its own power: the diffuse half of a wall is not where the specular half is.
TEST(TwoVsgl, ComponentsHaveFootprintsOfTheirOwn) {
  const Rsm rsm = make_rsm([&](double x, double y) {
    return test::reflect(surface({x, y, 0}, {0, 0, 1}, x < 0.5 ? 0.6 : 0, x < 0.5 ? 0 : 0.6), {1, 1, 1},
                         {0, 0, 1}, 0);
  });
  const Lights lights = generate(rsm, "two-vsgl");
  ASSERT_EQ(lights.lights.size(), 2u);
  EXPECT_NEAR(lights.lights[0].position.x, 0.25, 1e-6);
  EXPECT_NEAR(lights.lights[1].position.x, 0.75, 1e-6);
  for (const Light& light : lights.lights) EXPECT_NEAR(light.position.y, 0.5, 1e-6);
}

TEST(TwoVsgl, OppositeWallsAreNearlyIsotropic) {
  const Rsm rsm = make_rsm([&](double x, double y) {
    const bool left = x < 0.5;
    return test::reflect(surface({left ? -1.0 : 1.0, y, x}, {left ? 1.0 : -1.0, 0, 0}, 0.5, 0), {1, 1, 1},
                         {0, 1, 0}, 0);
  });
  const Light light = generate(rsm, "two-vsgl").lights.at(0);
  EXPECT_LT(light.diffuse_sharpness, 1e-3);
  EXPECT_NEAR(length(test::to_double(light.diffuse_axis)), 1, 1e-5);
  EXPECT_NEAR(length(test::to_double(light.normal)), 1, 1e-5);
  EXPECT_NEAR(light.normal_deficit, 1, 1e-5);
}

TEST(TwoVsgl, LobesAreMergedAsAskedFor) {
  const Rsm rsm = test::room_rsm(kSize);
  const auto sharpness = [&](const std::string& filter) {
    return generate(rsm, "two-vsgl", filter).lights.at(0).diffuse_sharpness;
  };
  EXPECT_LT(sharpness("toksvig"), 0.9f * sharpness("banerjee"));
  EXPECT_NEAR(sharpness("laurijssen") / sharpness("banerjee"), 1, 1e-3);
  test::expect_error(ErrorCode::bad_value, {"lobe_filter", "two-vsgl"},
                     [&] { generate(rsm, "two-vsgl", "none"); });
}

}  // namespace
}  // namespace vsgl
