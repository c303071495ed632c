// Virtual spherical lights against closed forms and quadrature in double precision.

#include "math/vsl.h"

#include "../expect_error.h"
#include "math/frame.h"
#include "run.h"

namespace vsgl {
namespace {

using std::numbers::pi;
using test::BoxOptions;

constexpr std::uint32_t kNdfs[] = {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN,
                                   interop::NDF_PHONG};

// One light at the origin that emits upwards by Lambert's law.
Lights lambert_light(double radius) {
  BoxOptions options;
  options.lights = 1;
  Lights lights = test::box_lights(options);
  interop::Light& light = lights.lights[0];
  light.position = light.origin = {0, 0, 0};
  light.normal = light.diffuse_axis = light.shading_normal = light.incident = {0, 0, 1};
  light.power_diffuse = {1, 1, 1};
  light.variance = static_cast<float>(radius * radius / 4);
  return lights;
}

// Pixels that face the origin.
GBuffer facing_origin(const std::vector<Vec3>& positions) {
  BoxOptions options;
  options.width = static_cast<int>(positions.size());
  options.height = 1;
  GBuffer gbuffer = test::box_gbuffer(options);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    gbuffer.pixels[i].position = test::to_float(positions[i]);
    gbuffer.pixels[i].normal = gbuffer.pixels[i].shading_normal = test::to_float(-normalise(positions[i]));
    gbuffer.pixels[i].diffuse = {1, 1, 1};
  }
  return gbuffer;
}

// The integral of cos^2 over the cone is 2 pi (1 - cos^3) / 3.
TEST(Vsl, FacingLambertPatchesHaveAClosedForm) {
  for (const bool sphere : {false, true})
    for (const double radius : {1e-3, 0.1, 0.6, 0.99}) {
      SCOPED_TRACE(testing::Message() << "sphere " << sphere << " radius " << radius);
      const GBuffer gbuffer = facing_origin({{0, 0, 1}});
      const Indirect image = test::shade_box(
          gbuffer, lambert_light(radius),
          {.light_model = "vsl", .vsl_samples = 4096, .vsl_cone = sphere ? "sphere" : "disk"});
      const double cosine = sphere ? std::sqrt(1 - radius * radius) : 1 / std::sqrt(1 + radius * radius);
      const double integral = 2 * pi * (1 - std::pow(cosine, 3)) / 3;
      const double expected = integral / (pi * radius * radius) / (pi * pi);
      EXPECT_NEAR(static_cast<double>(image.diffuse[0].x) / expected, 1, 1e-3);
    }
}

TEST(Vsl, ALightReceivedOnAllSidesLosesNoPower) {
  std::vector<Vec3> positions;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {  // Fibonacci's spiral on the upper hemisphere
    const double z = (i + 0.5) / kCount, azimuth = i * pi * (3 - std::sqrt(5.0));
    positions.push_back(
        {std::sqrt(1 - z * z) * std::cos(azimuth), std::sqrt(1 - z * z) * std::sin(azimuth), z});
  }
  const Indirect image =
      test::shade_box(facing_origin(positions), lambert_light(0.05), {.light_model = "vsl"});
  double power = 0;
  for (const interop::vec3& radiance : image.diffuse)
    power += pi * static_cast<double>(radiance.x) * 2 * pi / kCount;
  EXPECT_NEAR(power, 1, 0.01);
}

TEST(Vsl, TendsToThePointLightAsItsRadiusShrinks) {
  for (const std::uint32_t receiver : kNdfs)
    for (const std::uint32_t emission : kNdfs) {
      SCOPED_TRACE(testing::Message() << "receiver " << receiver << " emission " << emission);
      BoxOptions options;
      options.receiver_ndf = receiver;
      options.emission_ndf = emission;
      options.tilt = 0.2;
      options.sigma = 1e-5;
      const GBuffer gbuffer = test::box_gbuffer(options);
      const Lights lights = test::box_lights(options);
      for (const char* cone : {"disk", "sphere"})
        test::expect_near_oracle(
            test::shade_box(gbuffer, lights, {.light_model = "vsl", .vsl_cone = cone}),
            [&](std::size_t i) { return test::vpl_sum(gbuffer, i, lights); }, 1e-3);
    }
}

// A light in the very place of a pixel.
TEST(Vsl, IsFiniteAtDistanceZero) {
  for (const char* cone : {"disk", "sphere"}) {
    GBuffer gbuffer = facing_origin({{0, 0, 1}});
    gbuffer.pixels[0].position = {0, 0, 0};
    const Indirect image = test::shade_box(gbuffer, lambert_light(0.5),
                                           {.light_model = "vsl", .vsl_samples = 4096, .vsl_cone = cone});
    // The cosines of the hemisphere between two facing planes: the closed form at a right angle.
    const double expected = 2 * pi / 3 / (pi * 0.25) / (pi * pi);
    EXPECT_NEAR(static_cast<double>(image.diffuse[0].x) / expected, 1, 2e-3) << cone;
  }
}

// Midpoint rule over the cone's height and azimuth.
test::Radiance quadrature(const GBuffer& gbuffer, std::size_t pixel, const Lights& lights, bool sphere) {
  constexpr int kHeights = 160, kAzimuths = 320;
  const test::OraclePixel p(gbuffer, pixel);
  test::Radiance sum;
  for (const interop::Light& light : lights.lights) {
    const Vec3 v = test::to_double(light.origin) - p.position;
    const double radius2 = 4 * static_cast<double>(light.variance);
    const double height = (sphere ? sphere_cone_height : disk_cone_height)(dot(v, v), radius2);
    const Frame frame = frame_about(normalise(v));
    const double weight = 2 * pi * height / (kHeights * kAzimuths) / (pi * radius2);
    for (int i = 0; i < kHeights; ++i)
      for (int j = 0; j < kAzimuths; ++j) {
        const double z = 1 - height * (i + 0.5) / kHeights, azimuth = 2 * pi * (j + 0.5) / kAzimuths;
        const double sine = std::sqrt(1 - z * z);
        const Vec3 w = frame.to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
        const test::Radiance part = test::exact_light(p, light, w, weight);
        sum.diffuse += part.diffuse;
        sum.specular += part.specular;
      }
  }
  return sum;
}

struct Estimates {
  std::vector<double> sum, squares;
  int runs = 0;

  void add(const Indirect& image) {
    std::vector<double> values;
    for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
      values.push_back(luminance(test::to_double(image.diffuse[i])));
      values.push_back(luminance(test::specular_of(image, i)));
    }
    sum.resize(values.size());
    squares.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      squares[i] += values[i] * values[i];
    }
    ++runs;
  }
  double mean(std::size_t i) const { return sum[i] / runs; }
  double deviation(std::size_t i) const {  // of the mean
    return std::sqrt(std::max(squares[i] / runs - mean(i) * mean(i), 0.0) / (runs - 1));
  }
};

// A few lights so wide that every technique has many directions inside and outside the cones.
BoxOptions wide_lights(std::uint32_t receiver, std::uint32_t emission, float alpha = 0.35f) {
  BoxOptions options;
  options.width = 4;
  options.height = 2;
  options.lights = 3;
  options.receiver_ndf = receiver;
  options.emission_ndf = emission;
  options.alpha = alpha;
  options.tilt = 0.2;
  return options;
}

Lights wide(const BoxOptions& options) {
  Lights lights = test::box_lights(options);
  for (interop::Light& light : lights.lights) light.variance = 0.12f;  // a radius of 0.7
  return lights;
}

TEST(Vsl, EveryTechniqueHasTheMeanOfTheQuadrature) {
  constexpr int kRuns = 64;
  for (const auto& [receiver, emission] : {std::pair{interop::NDF_GGX, interop::NDF_PHONG},
                                           {interop::NDF_BECKMANN, interop::NDF_GGX},
                                           {interop::NDF_PHONG, interop::NDF_BECKMANN},
                                           {interop::NDF_NONE, interop::NDF_NONE}}) {
    const BoxOptions options = wide_lights(receiver, emission);
    const GBuffer gbuffer = test::box_gbuffer(options);
    const Lights lights = wide(options);
    std::vector<double> truth;
    for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
      const test::Radiance exact = quadrature(gbuffer, i, lights, false);
      truth.push_back(luminance(exact.diffuse));
      truth.push_back(luminance(exact.specular));
    }
    for (const char* techniques : {"all", "cone", "receiver", "light"}) {
      Estimates estimates;
      for (std::uint64_t seed = 0; seed < kRuns; ++seed)
        estimates.add(test::shade_box(
            gbuffer, lights,
            {.light_model = "vsl", .vsl_samples = 32, .vsl_techniques = techniques, .seed = seed}));
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (truth[i] == 0) continue;
        // 256 values are compared: 4.5 standard deviations leave a false alarm in 600 changes of the seeds.
        EXPECT_NEAR(estimates.mean(i), truth[i], 4.5 * estimates.deviation(i) + 1e-4 * truth[i])
            << techniques << " receiver " << receiver << " emission " << emission << " value " << i;
      }
    }
  }
}

// Of specular radiance, summed over the pixels.
double variance(float alpha, const char* techniques) {
  const BoxOptions options = wide_lights(interop::NDF_GGX, interop::NDF_GGX, alpha);
  const GBuffer gbuffer = test::box_gbuffer(options);
  const Lights lights = wide(options);
  Estimates estimates;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    estimates.add(
        test::shade_box(gbuffer, lights, {.light_model = "vsl", .vsl_techniques = techniques, .seed = seed}));
  double sum = 0;
  for (std::size_t i = 1; i < estimates.sum.size(); i += 2) sum += std::pow(estimates.deviation(i), 2);
  return sum;
}

// The lights' cones are narrow here: the cone alone is best, and samples of lobes cost all together little
// (1.5 times its variance seen). Lobes alone miss the cone where they are broad.
TEST(Vsl, TheBalanceServesSharpAndBroadLobes) {
  EXPECT_LT(variance(0.05f, "all"), 3 * variance(0.05f, "cone"));
  EXPECT_LT(variance(0.5f, "all"), 0.5 * variance(0.5f, "receiver"));
  EXPECT_LT(variance(0.5f, "all"), 0.5 * variance(0.5f, "light"));
}

TEST(Vsl, RefusesParametersOutsideTheirRange) {
  const GBuffer gbuffer = test::box_gbuffer({});
  const Lights lights = test::box_lights({});
  const auto run = [&](ShadingParams params) {
    params.light_model = "vsl";
    return [=] { test::shade_box(gbuffer, lights, params); };
  };
  test::expect_error(ErrorCode::out_of_range, {"vsl_samples"}, run({.vsl_samples = 0}));
  test::expect_error(ErrorCode::bad_value, {"vsl_cone", "sphere"}, run({.vsl_cone = "Disk"}));
  test::expect_error(ErrorCode::bad_value, {"vsl_techniques", "receiver"}, run({.vsl_techniques = "mis"}));
}

}  // namespace
}  // namespace vsgl
