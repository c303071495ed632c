// Which schedules fit which lights, and interleaved sampling.

#include <cmath>
#include <cstring>
#include <numbers>

#include "../expect_error.h"
#include "run.h"

namespace vsgl {
namespace {

using test::BoxOptions;

constexpr const char* kModels[] = {"fvpl", "vpl", "vsgl", "vsgl-2014"};

// A floor that ends at a step halfway, under a raster of equal lights on the ceiling.
struct Plane {
  GBuffer gbuffer;
  Lights lights;

  explicit Plane(double step, std::uint32_t ndf = interop::NDF_NONE) {
    gbuffer.width = 40;
    gbuffer.height = 24;
    gbuffer.scene_radius = 10;
    gbuffer.camera = {0, 0, 3};
    for (int y = 0; y < gbuffer.height; ++y)
      for (int x = 0; x < gbuffer.width; ++x) {
        interop::Surface s;
        s.position = {0.01f * static_cast<float>(x - 20), 0.01f * static_cast<float>(y - 12),
                      x < 20 ? 0.0f : static_cast<float>(step)};
        s.normal = s.shading_normal = {0, 0, 1};
        s.id = 0;
        s.diffuse = {x % 2 ? 0.9f : 0.3f, 0.5f, 0.5f};
        s.depth = 3;
        s.ndf = ndf;
        s.alpha = ndf == interop::NDF_NONE ? 1.0f : 0.5f;
        if (ndf != interop::NDF_NONE) s.specular = {0.4f, 0.4f, 0.4f};
        gbuffer.pixels.push_back(s);
      }
    lights = test::box_lights({.lights = 32 * 32});
    for (std::size_t i = 0; i < lights.lights.size(); ++i) {
      interop::Light& light = lights.lights[i];
      light.position =
          light.origin = {static_cast<float>(i % 32) - 15.5f, static_cast<float>(i / 32) - 15.5f, 6};
      light.normal = light.shading_normal = light.diffuse_axis = light.incident = {0, 0, -1};
      light.variance = 0.01f;
    }
  }
  Indirect shaded(const char* model, const char* schedule, int side = 4) const {
    return test::shade_box(gbuffer, lights, {.light_model = model, .schedule = schedule, .interleave = side});
  }
};

double largest_difference(const std::vector<interop::vec3>& a, const std::vector<interop::vec3>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 x = test::to_double(a[i]), y = test::to_double(b[i]);
    worst = std::max(worst, length(x - y) / length(y));
  }
  return worst;
}

TEST(Interleave, EqualsAllLightsOnAPlane) {
  for (const char* model : kModels)
    for (const std::uint32_t ndf : {interop::NDF_NONE, interop::NDF_GGX}) {
      SCOPED_TRACE(testing::Message() << model << " " << ndf);
      const Plane plane(0, ndf);
      const Indirect some = plane.shaded(model, "interleave"), all = plane.shaded(model, "flat");
      EXPECT_LT(largest_difference(some.diffuse, all.diffuse), 1e-3);
      ASSERT_EQ(some.specular.size(), all.specular.size());
      EXPECT_LT(largest_difference(some.specular, all.specular), 3e-3);
    }
}

// The wider the pattern, the more of the light's curvature is lost.
TEST(Interleave, EqualsAllLightsOnAPlaneForEveryPattern) {
  const Plane plane(0);
  const Indirect all = plane.shaded("fvpl", "flat");
  EXPECT_LT(largest_difference(plane.shaded("fvpl", "interleave", 2).diffuse, all.diffuse), 5e-4);
  EXPECT_LT(largest_difference(plane.shaded("fvpl", "interleave", 8).diffuse, all.diffuse), 1e-3);
}

TEST(Interleave, OfOnePixelIsFlatToTheBit) {
  const Plane plane(2, interop::NDF_GGX);
  const Indirect some = plane.shaded("fvpl", "interleave", 1), all = plane.shaded("fvpl", "flat");
  ASSERT_EQ(some.diffuse.size(), all.diffuse.size());
  EXPECT_EQ(0,
            std::memcmp(some.diffuse.data(), all.diffuse.data(), all.diffuse.size() * sizeof(interop::vec3)));
  ASSERT_EQ(some.specular.size(), all.specular.size());
  EXPECT_EQ(
      0, std::memcmp(some.specular.data(), all.specular.data(), all.specular.size() * sizeof(interop::vec3)));
}

// A pixel like none around it sums what it lacks itself, whatever the pattern.
TEST(Interleave, FeaturesOfOnePixelAreExact) {
  Plane plane(0);
  std::vector<std::size_t> alone;
  for (std::size_t k = 0; k < 5; ++k) {
    alone.push_back(40 * (4 * k + 1) + 7 * k + 2);
    interop::Surface& s = plane.gbuffer.pixels[alone.back()];
    const double angle = 0.4 * std::numbers::pi * static_cast<double>(k);  // nor like one another
    s.normal = s.shading_normal = test::to_float(normalise(Vec3{std::cos(angle), std::sin(angle), 0.3}));
  }
  const Indirect all = plane.shaded("fvpl", "flat");
  for (const int side : {2, 4, 8}) {
    const Indirect some = plane.shaded("fvpl", "interleave", side);
    for (const std::size_t pixel : alone)
      EXPECT_LT(largest_difference({some.diffuse[pixel]}, {all.diffuse[pixel]}), 1e-6)
          << side << ' ' << pixel;
  }
}

// The light does not cross the step: beyond it there are other pixels on the same surface, and where there
// are not, the missing subsets are computed.
TEST(Interleave, StopsAtEdges) {
  Plane plane(2);
  const Indirect some = plane.shaded("fvpl", "interleave"), all = plane.shaded("fvpl", "flat");
  EXPECT_LT(largest_difference(some.diffuse, all.diffuse), 3e-3);

  for (int k = 0; k < 5; ++k) {  // pixels with surfaces of their own
    interop::Surface& s = plane.gbuffer.pixels[static_cast<std::size_t>(40 * (4 * k + 1) + 7 * k + 2)];
    s.normal = s.shading_normal = test::to_float(normalise(Vec3{1, 0.2 * k, 0.3}));
  }
  EXPECT_LT(
      largest_difference(plane.shaded("fvpl", "interleave").diffuse, plane.shaded("fvpl", "flat").diffuse),
      3e-3);
}

TEST(Interleave, EvaluatesItsShare) {
  const Plane plane(0);
  for (const int side : {1, 2, 4, 8}) {
    Report report;
    shade(plane.gbuffer, plane.lights, nullptr, {.schedule = "interleave", .interleave = side},
          test::shared_device(), report);
    const auto counts = report.to_json()["counts"];
    EXPECT_EQ(counts["evaluations"], 40 * 24 * 1024 / (side * side));
    if (side > 1) {
      EXPECT_EQ(counts["subsets_recomputed"], 0);
    }
  }
}

TEST(Interleave, SharpLobesTakeAllLights) {
  Plane plane(0, interop::NDF_GGX);
  for (interop::Surface& s : plane.gbuffer.pixels) s.alpha = 0.2f;
  const Indirect some = plane.shaded("fvpl", "interleave"), all = plane.shaded("fvpl", "flat");
  EXPECT_EQ(largest_difference(some.specular, all.specular), 0);
  EXPECT_EQ(largest_difference(some.diffuse, all.diffuse), 0);
}

TEST(Interleave, RespectsVisibility) {
  const Plane plane(0);
  const auto hidden = [&](std::size_t light) { return light % 3 == 0; };
  VisibilityBits bits;
  bits.width = plane.gbuffer.width;
  bits.height = plane.gbuffer.height;
  bits.lights = static_cast<int>(plane.lights.lights.size());
  bits.words.resize(static_cast<std::size_t>(bits.words_per_pixel()) * plane.gbuffer.pixels.size());
  for (std::size_t i = 0; i < plane.lights.lights.size(); ++i)
    for (std::size_t p = 0; p < plane.gbuffer.pixels.size(); ++p)
      if (!hidden(i)) bits.words[i / 32 * plane.gbuffer.pixels.size() + p] |= 1U << (i % 32);
  const Visibility visibility = bits;
  const auto image = [&](const char* schedule) {
    return test::shade_box(plane.gbuffer, plane.lights, {.schedule = schedule}, &visibility).diffuse;
  };
  EXPECT_LT(largest_difference(image("interleave"), image("flat")), 1e-3);
}

TEST(Schedule, FitsTheLights) {
  const GBuffer gbuffer = test::box_gbuffer({});
  const Lights list = test::box_lights({});
  Lights tree = list;
  tree.levels = {0, static_cast<std::uint32_t>(tree.lights.size())};
  EXPECT_EQ(resolve_schedule({}, list), "flat");
  EXPECT_EQ(resolve_schedule({}, tree), "cut");
  const auto run = [&](const Lights& lights, ShadingParams params, const Visibility* visibility = nullptr) {
    return [&lights, &gbuffer, params, visibility] { test::shade_box(gbuffer, lights, params, visibility); };
  };
  test::expect_error(ErrorCode::bad_value, {"schedule", "interleave"}, run(list, {.schedule = "all"}));
  test::expect_error(ErrorCode::bad_value, {"schedule", "--method tree"}, run(list, {.schedule = "cut"}));
  for (const char* schedule : {"flat", "interleave"})
    test::expect_error(ErrorCode::bad_value, {"schedule", "--level"}, run(tree, {.schedule = schedule}));
  test::expect_error(ErrorCode::bad_value, {"light_model", "fvpl"}, run(tree, {.light_model = "vsgl"}));
  test::expect_error(ErrorCode::bad_value, {"schedule", "ismap"}, run(tree, {}));
  test::expect_error(ErrorCode::out_of_range, {"diffuse_scale"}, run(list, {.diffuse_scale = 3}));
  for (const int side : {0, 3, 16})
    test::expect_error(ErrorCode::out_of_range, {"interleave", "none of"}, run(list, {.interleave = side}));
  Cut cut;
  cut.width = gbuffer.width;
  cut.height = gbuffer.height;
  cut.lights = static_cast<int>(list.lights.size());
  const Visibility visibility = cut;
  test::expect_error(ErrorCode::bad_value, {"visibility", "ismap"}, run(list, {}, &visibility));
}

}  // namespace
}  // namespace vsgl
