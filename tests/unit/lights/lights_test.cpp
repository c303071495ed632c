#include "stages/lights/lights.h"

#include <gtest/gtest.h>

#include <cstring>

#include "../expect_error.h"
#include "../synthetic_room.h"

namespace vsgl {
namespace {

using interop::Light;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

// Of the method that most tests are about.
LightsParams filtered() {
  LightsParams params;
  params.method = "fis-2016";
  return params;
}

const Rsm& room() {
  static const Rsm rsm = test::room_rsm(128);
  return rsm;
}

Lights generate(const Rsm& rsm, const Pdf& pdf, const LightsParams& params) {
  Report report;
  return generate_lights(rsm, &pdf, params, &device(), report);
}

double emitted(const Lights& lights) {
  double sum = 0;
  for (const Light& l : lights.lights)
    sum += luminance(test::to_double(l.power_diffuse) + test::to_double(l.power_specular));
  return sum;
}

double power_ratio(const Rsm& rsm, const Pdf& pdf, const LightsParams& params) {
  return emitted(generate(rsm, pdf, params)) / test::reflected_power(rsm);
}

Pdf uniform_pdf(const Rsm& rsm) {
  const std::size_t texels = static_cast<std::size_t>(rsm.size) * static_cast<std::size_t>(rsm.size);
  return test::make_pdf(
      rsm, std::vector<std::vector<double>>(rsm.layers.size(), std::vector<double>(texels, 1.0)));
}

// Reflected power where the light of a small spot falls, none elsewhere.
Rsm sparse_room() {
  Rsm rsm = room();
  std::vector<DoubleMoments> level0;
  for (int k = 0; k < rsm.size * rsm.size; ++k) {
    interop::Surface& s = rsm.layers[0].surface[static_cast<std::size_t>(k)];
    const interop::Moments& m = rsm.layers[0].pyramid[static_cast<std::size_t>(k)];
    const bool lit = k % 97 == 0;
    if (!lit) s = test::nothing();
    level0.push_back(lit ? test::reflect(s, test::to_double(m.flux), {0, 1, 0}, m.spread) : DoubleMoments{});
  }
  rsm.layers[0].pyramid = test::moment_pyramid(std::move(level0), rsm.size);
  return rsm;
}

void expect_sound(const Lights& lights) {
  for (const Light& l : lights.lights) {
    const bool is_diffuse = luminance(test::to_double(l.power_diffuse)) > 0;
    EXPECT_NEAR(length(test::to_double(l.diffuse_axis)), is_diffuse ? 1 : 0, 1e-5);
    for (interop::vec3 axis : {l.normal, l.shading_normal, l.incident})
      EXPECT_NEAR(length(test::to_double(axis)), 1, 1e-5);
    EXPECT_GE(l.variance, 0);
    EXPECT_GE(l.level, 0);
    const float* values = reinterpret_cast<const float*>(&l);
    for (std::size_t k = 0; k < sizeof(Light) / sizeof(float); ++k)
      EXPECT_TRUE(std::isfinite(values[k])) << k;
  }
}

void expect_total_power(const Rsm& rsm, const Pdf& pdf) {
  for (const char* solver : {"newton", "bisection"})
    for (const double scale : {1.0, 4.0}) {
      LightsParams params = filtered();
      params.kernel_solver = solver;
      params.kernel_scale = scale;
      EXPECT_NEAR(power_ratio(rsm, pdf, params), 1, 1e-5) << solver << " " << scale;
      params.power = "paper";
      EXPECT_NEAR(power_ratio(rsm, pdf, params), 1, 0.005) << solver << " " << scale;
    }
}

TEST(Lights, TotalPowerIsThatOfTheRsm) {
  for (const Rsm& rsm : {room(), test::room_rsm(64, 2), test::room_rsm(64, 1, false)}) {
    expect_total_power(rsm, test::flux_pdf(rsm));
    expect_total_power(rsm, uniform_pdf(rsm));
  }
  expect_total_power(sparse_room(), test::flux_pdf(sparse_room()));
}

TEST(Lights, VplsAreUnbiased) {
  LightsParams params;
  params.method = "vpl";
  EXPECT_NEAR(power_ratio(room(), test::flux_pdf(room()), params), 1, 1e-4);
  EXPECT_NEAR(power_ratio(room(), uniform_pdf(room()), params), 1, 0.03);
}

TEST(Lights, EveryTexelOnceGivesTheRsmBack) {
  const Rsm rsm = test::room_rsm(16);
  LightsParams params;
  params.method = "vpl";
  params.count = 256;
  params.points = "lattice";
  const Lights lights = generate(rsm, uniform_pdf(rsm), params);
  std::vector<double> power(256);
  for (const Light& l : lights.lights) {
    power[l.texel] += luminance(test::to_double(l.power_diffuse) + test::to_double(l.power_specular));
    EXPECT_EQ(l.variance, 0);
  }
  for (std::size_t k = 0; k < 256; ++k) {
    const double shares = power[k] / static_cast<double>(rsm.layers[0].pyramid[k].weight);
    EXPECT_NEAR(shares, std::round(shares), 1e-5) << k;  // M w / (N p) = w a sample
    EXPECT_LE(shares, 3);
  }
}

TEST(Lights, AVplIsItsTexel) {
  LightsParams params;
  params.method = "vpl";
  params.count = 500;
  const Rsm& rsm = room();
  for (const Light& l : generate(rsm, test::flux_pdf(rsm), params).lights) {
    const interop::Surface& s = rsm.layers[0].surface[l.texel];
    const interop::Moments& m = rsm.layers[0].pyramid[l.texel];
    EXPECT_EQ(test::to_double(l.position), test::to_double(s.position));
    EXPECT_EQ(test::to_double(l.origin), test::to_double(s.position));
    EXPECT_NEAR(dot(test::to_double(l.normal), test::to_double(s.normal)), 1, 1e-6);
    EXPECT_EQ(l.ndf, s.ndf);
    EXPECT_EQ(l.alpha, s.alpha);
    EXPECT_EQ(l.level, 0);
    const double d = l.power_diffuse.x, expected = d / static_cast<double>(m.power_diffuse.x);
    EXPECT_NEAR(static_cast<double>(l.power_diffuse.z) / static_cast<double>(m.power_diffuse.z), expected,
                1e-4 * expected);
    const Vec3 to_lamp = normalise(rsm.layers[0].light.position - test::to_double(s.position));
    EXPECT_NEAR(length(test::to_double(l.incident) - to_lamp), 0, 1e-6);
    EXPECT_NEAR(l.diffuse_sharpness, interop::LAMBDA_DIFFUSE, 1e-3);
  }
}

TEST(Lights, OneLightHoldsEverything) {
  LightsParams params = filtered();
  params.count = 1;
  const Rsm rsm = test::room_rsm(64);
  const Lights lights = generate(rsm, test::flux_pdf(rsm), params);
  ASSERT_EQ(lights.lights.size(), 1u);
  const interop::Moments& top = rsm.layers[0].pyramid.back();
  EXPECT_EQ(lights.lights[0].level, 6);
  EXPECT_NEAR(emitted(lights) / test::reflected_power(rsm), 1, 1e-5);
  EXPECT_NEAR(lights.lights[0].variance / (0.5f * top.spread), 1, 1e-5);
  EXPECT_NEAR(length(test::to_double(lights.lights[0].position) - test::to_double(top.position)), 0, 1e-5);
}

TEST(Lights, MoreSamplesThanTexels) {
  const Rsm rsm = test::room_rsm(16, 2);
  for (const char* method : {"vpl", "fis-2014", "fis-2016"}) {
    LightsParams params;
    params.method = method;
    params.count = 20000;
    const Lights lights = generate(rsm, test::flux_pdf(rsm), params);
    EXPECT_EQ(lights.lights.size(), 20000u);
    EXPECT_NEAR(emitted(lights) / test::reflected_power(rsm), 1,
                std::string(method) == "fis-2014" ? 0.1 : 0.005)
        << method;
    expect_sound(lights);
  }
}

TEST(Lights, SparseRsm) {
  const Rsm rsm = sparse_room();
  for (const LightsMethod& method : lights_methods()) {
    if (method.source != LightsSource::rsm) continue;
    LightsParams params;
    params.method = method.name;
    const Lights lights = generate(rsm, test::flux_pdf(rsm), params);
    expect_sound(lights);
    for (const Light& l : lights.lights)
      EXPECT_NE(rsm.layers[l.layer].surface[l.texel].id, interop::NO_INSTANCE);
  }
}

TEST(Lights, NothingEmits) {
  Rsm rsm = test::room_rsm(16);
  rsm.layers[0].surface.assign(256, test::nothing());
  rsm.layers[0].pyramid = test::moment_pyramid(std::vector<DoubleMoments>(256), 16);
  const Pdf pdf = test::make_pdf(rsm, {std::vector<double>(256)});
  for (const LightsMethod& method : lights_methods()) {
    if (method.source != LightsSource::rsm) continue;
    LightsParams params;
    params.method = method.name;
    Report report;
    const Lights lights = generate_lights(rsm, &pdf, params, &device(), report);
    EXPECT_TRUE(lights.lights.empty());
    EXPECT_EQ(lights.requested, method.needs_pdf ? 1024 : 0);
    EXPECT_FALSE(report.to_json().at("skipped").empty());
    EXPECT_TRUE(describe(lights, rsm, params, true).at("power").at("ratio").is_null());
  }
}

TEST(Lights, SamplesWithoutPowerAreDroppedInOrder) {
  const Rsm rsm = sparse_room();
  LightsParams params;
  params.method = "vpl";
  params.count = 4096;
  Report report;
  const Pdf pdf = uniform_pdf(rsm);
  const Lights lights = generate_lights(rsm, &pdf, params, &device(), report);
  EXPECT_GT(lights.lights.size(), 10u);
  EXPECT_LT(lights.lights.size(), 100u);
  EXPECT_EQ(report.to_json().at("counts").at("dropped"), 4096 - lights.lights.size());
}

TEST(Lights, SameBytesTwice) {
  for (const LightsMethod& method : lights_methods()) {
    if (method.source != LightsSource::rsm) continue;
    LightsParams params;
    params.method = method.name;
    params.count = 5000;
    const Lights a = generate(room(), test::flux_pdf(room()), params),
                 b = generate(room(), test::flux_pdf(room()), params);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    EXPECT_EQ(std::memcmp(a.lights.data(), b.lights.data(), a.lights.size() * sizeof(Light)), 0)
        << method.name;
  }
}

// The sampled texels are diffuse, their kernels reach a specular one: its power must survive in the artifact.
TEST(Lights, SpecularPowerNeedsNoSpecularRepresentative) {
  Lights lights = generate(room(), test::flux_pdf(room()), filtered());
  std::erase_if(lights.lights,
                [](const Light& l) { return l.ndf != interop::NDF_NONE || l.power_specular.x <= 0; });
  ASSERT_FALSE(lights.lights.empty());
  EXPECT_TRUE(lights.has_specular());
}

TEST(Lights, DescribesItself) {
  const LightsParams params = filtered();
  const Lights lights = generate(room(), test::flux_pdf(room()), params);
  const auto json = describe(lights, room(), params, true);
  EXPECT_EQ(json.at("$schema"), "vsgltools/lights/1");
  EXPECT_NEAR(json.at("power").at("ratio").get<double>(), 1, 0.005);
  EXPECT_EQ(json.at("lights").size(), lights.lights.size());
  int kernels = 0;
  for (int n : json.at("level").at("histogram")) kernels += n;
  EXPECT_EQ(kernels, static_cast<int>(lights.lights.size()));
  EXPECT_FALSE(describe(lights, room(), params, false).contains("lights"));
}

TEST(Lights, RejectsWhatDoesNotBelongTogether) {
  const Pdf pdf = test::flux_pdf(room());
  const auto attempt = [&](const std::function<void(LightsParams&, Pdf&)>& change) {
    return [&, change] {
      LightsParams params = filtered();
      Pdf changed = pdf;
      change(params, changed);
      generate(room(), changed, params);
    };
  };
  using test::expect_error;
  expect_error(ErrorCode::bad_value, {"method", "fis-2016"},
               attempt([](auto& p, auto&) { p.method = "kmeans"; }));
  expect_error(ErrorCode::bad_value, {"points"}, attempt([](auto& p, auto&) { p.points = "sobol"; }));
  expect_error(ErrorCode::bad_value, {"kernel_solver"},
               attempt([](auto& p, auto&) { p.kernel_solver = "x"; }));
  expect_error(ErrorCode::bad_value, {"power"}, attempt([](auto& p, auto&) { p.power = "x"; }));
  expect_error(ErrorCode::out_of_range, {"count"}, attempt([](auto& p, auto&) { p.count = 0; }));
  expect_error(ErrorCode::out_of_range, {"kernel_scale"},
               attempt([](auto& p, auto&) { p.kernel_scale = 0; }));
  expect_error(ErrorCode::wrong_size, {"density"}, attempt([](auto&, auto& d) { d.size = 64; }));
  expect_error(ErrorCode::missing_part, {"density"},
               attempt([](auto&, auto& d) { d.layers[0].name = "sun"; }));
}

}  // namespace
}  // namespace vsgl
