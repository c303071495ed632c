// Each method against sums in double precision.

#include <set>

#include "../expect_error.h"
#include "run.h"

namespace vsgl {
namespace {

using test::BoxOptions;
using test::OracleOptions;

constexpr std::uint32_t kNdfs[] = {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN,
                                   interop::NDF_PHONG};

BoxOptions box(std::uint32_t receiver, std::uint32_t emission) {
  BoxOptions options;
  options.receiver_ndf = receiver;
  options.emission_ndf = emission;
  return options;
}

TEST(Vpl, EqualsTheSumOfExactPaths) {
  for (std::uint32_t receiver : kNdfs)
    for (std::uint32_t emission : kNdfs) {
      SCOPED_TRACE(testing::Message() << "receiver " << receiver << " emission " << emission);
      BoxOptions options = box(receiver, emission);
      options.tilt = 0.2;
      const GBuffer gbuffer = test::box_gbuffer(options);
      const Lights lights = test::box_lights(options);
      ShadingParams params{.light_model = "vpl", .clamp = 0};
      test::expect_near_oracle(
          test::shade_box(gbuffer, lights, params),
          [&](std::size_t i) { return test::vpl_sum(gbuffer, i, lights); }, 2e-5);
    }
}

TEST(Vpl, FloorsTheDistanceAndReportsWhatItTakesAway) {
  BoxOptions options;
  const GBuffer gbuffer = test::box_gbuffer(options);
  const Lights lights = test::box_lights(options);
  ShadingParams params{.light_model = "vpl", .clamp = 0.5};
  Report report;
  const Indirect image = shade(gbuffer, lights, nullptr, params, test::shared_device(), report);
  const OracleOptions clamped{.clamp_distance = 0.5 * gbuffer.scene_radius};
  test::expect_near_oracle(
      image, [&](std::size_t i) { return test::vpl_sum(gbuffer, i, lights, clamped); }, 2e-5);
  double kept = 0, all = 0;
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    kept += luminance(test::vpl_sum(gbuffer, i, lights, clamped).diffuse);
    all += luminance(test::vpl_sum(gbuffer, i, lights).diffuse);
  }
  ASSERT_LT(kept, 0.99 * all);
  EXPECT_NEAR(report.to_json()["counts"]["clamped_fraction"].get<double>(), 1 - kept / all, 1e-4);
}

// The inner loop's faster forms stay within 2e-4 of the peak of the library's, within 1e-3 where the
// footprints are as large as the box.
TEST(Vsgl, EqualsTheLibrarysIntegrals) {
  for (const char* method : {"vsgl", "vsgl-2014"})
    for (std::uint32_t receiver : kNdfs)
      for (double sigma : {1e-3, 0.05, 0.5}) {
        SCOPED_TRACE(testing::Message() << method << " receiver " << receiver << " sigma " << sigma);
        BoxOptions options = box(receiver, interop::NDF_GGX);
        options.sigma = sigma;
        const GBuffer gbuffer = test::box_gbuffer(options);
        const Lights lights = test::box_lights(options);
        ShadingParams params{.light_model = method, .cbr = 0};
        const bool disk = params.light_model == "vsgl-2014";
        test::expect_near_oracle(
            test::shade_box(gbuffer, lights, params),
            [&](std::size_t i) { return test::vsgl_sum(gbuffer, i, lights, disk); },
            sigma < 0.1 ? 2e-4 : 1e-3);
      }
}

// Clusters of parallel and of spread normals. The faster forms err as above.
TEST(Fvpl, EqualsTheLibrarysIntegrals) {
  for (std::uint32_t receiver : kNdfs)
    for (std::uint32_t emission : kNdfs)
      for (double sigma : {1e-3, 0.05, 0.5}) {
        SCOPED_TRACE(testing::Message()
                     << "receiver " << receiver << " emission " << emission << " sigma " << sigma);
        BoxOptions options = box(receiver, emission);
        options.sigma = sigma;
        const GBuffer gbuffer = test::box_gbuffer(options);
        Lights lights = test::box_lights(options);
        for (std::size_t i = 0; i < lights.lights.size(); ++i) {
          lights.lights[i].normal_deficit = i % 3 == 0 ? 0.0f : 0.1f * static_cast<float>(i % 5);
          lights.lights[i].lobe_variance = 0.02f * static_cast<float>(i % 4);
          lights.lights[i].shading_deficit = 0.01f * static_cast<float>(i % 4);
        }
        test::expect_near_oracle(
            test::shade_box(gbuffer, lights, {}),
            [&](std::size_t i) { return test::fvpl_sum(gbuffer, i, lights); }, sigma < 0.1 ? 2e-4 : 1e-3);
      }
}

// Small footprints of bumped surfaces: the exact virtual point light.
TEST(Fvpl, IsAVplWhereItIsSmall) {
  for (std::uint32_t receiver : kNdfs)
    for (std::uint32_t emission : {receiver, interop::NDF_GGX}) {
      SCOPED_TRACE(testing::Message() << "receiver " << receiver << " emission " << emission);
      BoxOptions options = box(receiver, emission);
      options.sigma = 1e-5;
      options.tilt = 0.2;
      const GBuffer gbuffer = test::box_gbuffer(options);
      const Lights lights = test::box_lights(options);
      test::expect_near_oracle(
          test::shade_box(gbuffer, lights, {}),
          [&](std::size_t i) { return test::vpl_sum(gbuffer, i, lights); }, 1e-4);
    }
}

// Specular power whose representative point has no specular lobe is emitted by the broadest.
TEST(Fvpl, KeepsSpecularPowerWithoutALobe) {
  const GBuffer gbuffer = test::box_gbuffer({});
  Lights lights = test::box_lights(box(interop::NDF_NONE, interop::NDF_GGX));
  for (interop::Light& light : lights.lights) light.alpha = 1;
  const Indirect broadest = test::shade_box(gbuffer, lights, {});
  for (interop::Light& light : lights.lights) light.ndf = interop::NDF_NONE;
  const Indirect without = test::shade_box(gbuffer, lights, {});
  for (std::size_t i = 0; i < broadest.diffuse.size(); ++i)
    ASSERT_EQ(broadest.diffuse[i].x, without.diffuse[i].x);
}

TEST(SpecularLobes, EqualTheLibrarysIntegrals) {
  const std::set<std::string> fast{"auto", "mixture", "blend"};  // by polynomials
  for (const SpecularLobe& lobe : specular_lobes())
    for (std::uint32_t receiver : {interop::NDF_GGX, interop::NDF_BECKMANN, interop::NDF_PHONG})
      for (const char* method : {"fvpl", "vsgl", "vsgl-2014"}) {
        if (method != std::string("vsgl") && receiver != interop::NDF_BECKMANN) continue;
        SCOPED_TRACE(testing::Message() << lobe.name << " " << method << " receiver " << receiver);
        const BoxOptions options = box(receiver, interop::NDF_GGX);
        const GBuffer gbuffer = test::box_gbuffer(options);
        const Lights lights = test::box_lights(options);
        const std::string model = method;
        const OracleOptions oracle{.lobe = lobe.name};
        test::expect_near_oracle(
            test::shade_box(gbuffer, lights, {.light_model = model, .specular_lobe = lobe.name, .cbr = 0}),
            [&](std::size_t i) {
              return model == "fvpl" ? test::fvpl_sum(gbuffer, i, lights, oracle)
                                     : test::vsgl_sum(gbuffer, i, lights, model == "vsgl-2014", oracle);
            },
            fast.contains(lobe.name) ? 2e-4 : 1e-4);
      }
}

// Where the true BRDF is taken there is no lobe to choose, nor where a cut has forms of its own.
TEST(SpecularLobes, AreRefusedWhereTheyHaveNoEffect) {
  const GBuffer gbuffer = test::box_gbuffer({});
  const Lights lights = test::box_lights({});
  std::size_t refused = 0;
  for (const LightModel& model : light_models())
    for (const SpecularLobe& lobe : specular_lobes()) {
      const ShadingParams params{.light_model = model.name, .specular_lobe = lobe.name};
      const auto run = [&] { test::shade_box(gbuffer, lights, params); };
      if (model.has_lobe || lobe.name == "auto") {
        EXPECT_NO_THROW(run()) << model.name << " " << lobe.name;
      } else {
        test::expect_error(ErrorCode::bad_value, {"specular_lobe", lobe.name, model.name}, run);
        ++refused;
      }
    }
  EXPECT_GE(refused, specular_lobes().size() - 1);
  Lights tree = lights;
  tree.levels = {0, 1, static_cast<std::uint32_t>(tree.lights.size())};
  test::expect_error(ErrorCode::bad_value, {"specular_lobe", "cut"},
                     [&] { test::shade_box(gbuffer, tree, {.specular_lobe = "sg"}); });
}

// A light below the plane of a pixel whose shading normal leans towards it.
TEST(Shading, NothingArrivesFromBelowTheGeometricHorizon) {
  for (std::uint32_t ndf : kNdfs)
    for (const char* method : {"fvpl", "vpl", "vsl", "vsgl", "vsgl-2014"}) {
      SCOPED_TRACE(testing::Message() << method << " " << ndf);
      BoxOptions options = box(ndf, ndf);
      options.width = options.height = options.lights = 1;
      GBuffer gbuffer = test::box_gbuffer(options);
      Lights lights = test::box_lights(options);
      interop::Surface& s = gbuffer.pixels[0];
      s.position = {0, 0, 0};
      gbuffer.camera = {0, 0, 1};
      s.normal = {0, 0, 1};
      interop::Light& light = lights.lights[0];
      light.normal = light.diffuse_axis = light.shading_normal = light.incident =
          light.specular_axis = {-1, 0, 0};
      light.variance = 1e-4f;
      s.shading_normal = test::to_float(normalise(Vec3{1, 0, 1}));
      const auto arriving = [&](float height) {
        light.position = light.origin = {1, 0, height};
        const Indirect image = test::shade_box(gbuffer, lights, {.light_model = method, .cbr = 0});
        return luminance(test::to_double(image.diffuse[0]) + test::specular_of(image, 0));
      };
      const double above = arriving(0.1f);
      ASSERT_GT(above, 1e-3);
      EXPECT_EQ(arriving(-0.1f), 0);
      s.shading_normal = s.normal;
      EXPECT_LT(arriving(-0.1f), 1e-6 * above);  // the shading horizon alone
    }
}

TEST(Shading, RefusesParametersOutsideTheirRange) {
  const GBuffer gbuffer = test::box_gbuffer({});
  const Lights lights = test::box_lights({});
  const auto run = [&](ShadingParams params) { return [=] { test::shade_box(gbuffer, lights, params); }; };
  test::expect_error(ErrorCode::bad_value, {"light_model", "vsgl-2014"}, run({.light_model = "vsm"}));
  test::expect_error(ErrorCode::bad_value, {"specular_lobe", "asg"}, run({.specular_lobe = "ASG"}));
  test::expect_error(ErrorCode::out_of_range, {"cbr"}, run({.cbr = -0.1}));
  test::expect_error(ErrorCode::out_of_range, {"clamp"}, run({.clamp = 1.5}));
}

TEST(Shading, RefusesInputsOfDifferentScenes) {
  const GBuffer gbuffer = test::box_gbuffer({});
  Lights lights = test::box_lights({});
  lights.anchor = {1, 0, 0};
  test::expect_error(ErrorCode::invalid_data, {"lights", "anchor"},
                     [&] { test::shade_box(gbuffer, lights, {}); });
  lights.anchor = {};
  ShadowMaps maps;
  maps.columns = 1;
  maps.views.resize(1);
  const Visibility visibility = maps;
  test::expect_error(ErrorCode::wrong_size, {"shadow maps", "12 lights"},
                     [&] { test::shade_box(gbuffer, lights, {}, &visibility); });
}

}  // namespace
}  // namespace vsgl
