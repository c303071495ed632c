// Threads, interruption, limits and errors of the reference.

#include "reference/reference.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstring>
#include <numbers>

#include "../../analytic/reference_scenes.h"
#include "../expect_error.h"

namespace vsgl::reference {
namespace {

using namespace test;

struct Room {
  scene::Scene scene;
  GBuffer gbuffer;
};

// A glossy floor and a matte wall; 24 points of each.
Room room() {
  Room out;
  add_parallelogram(out.scene, {0, -1, 0}, {2, 0, 0}, {0, 2, 0},
                    glossy({0.3, 0.4, 0.5}, {0.5, 0.4, 0.3}, 0.3));
  add_parallelogram(out.scene, {0, -1, 0}, {0, 2, 0}, {0, 0, 2}, matte({0.7, 0.5, 0.3}));
  out.scene.radius = 3;
  out.scene.lights = {point_light({1.1, -0.3, 1.3}, {2, 3, 4})};
  std::vector<interop::Surface> points;
  for (int i = 0; i < 24; ++i) {
    const double far = 0.1 + 0.07 * i, y = 0.5 * std::sin(i);
    points.push_back(visible_point({far, y, 0}, {0, 0, 1}, out.scene.materials[0]));
    points.push_back(visible_point({0, y, far}, {1, 0, 0}, out.scene.materials[1]));
  }
  out.gbuffer = row_of(out.scene, {2.5, 0.4, 1.5}, points);
  return out;
}

ReferenceParams params(int samples) {
  ReferenceParams out;
  out.samples = samples;
  out.checkpoint_interval_s = 0;
  return out;
}

Reference trace(const Room& r, const ReferenceParams& p) {
  Report report;
  return trace_reference(r.scene, r.gbuffer, p, report);
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same(const Reference& a, const Reference& b) {
  return same_bytes(a.radiance.diffuse, b.radiance.diffuse) &&
         same_bytes(a.radiance.specular, b.radiance.specular) &&
         same_bytes(a.radiance.direct, b.radiance.direct) && same_bytes(a.variance, b.variance) &&
         a.samples == b.samples;
}

TEST(Reference, SameBytesOnAnyNumberOfThreads) {
  const Room r = room();
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Reference one = trace(r, params(256));
  omp_set_num_threads(3);
  const Reference three = trace(r, params(256));
  omp_set_num_threads(before);
  EXPECT_TRUE(same(one, three));
  ReferenceParams other = params(256);
  other.seed = 1;
  EXPECT_FALSE(same(one, trace(r, other)));
}

struct Stop {};

TEST(Reference, SameBytesHoweverOftenInterrupted) {
  const Room r = room();
  const Reference whole = trace(r, params(512));
  const TemporaryFolder folder;
  ReferenceParams p = params(512);
  p.checkpoint = folder / "work.exr";
  for (const int passes : {3, 1, 4}) {
    Report report;
    int left = passes;
    const auto interrupt = [&](double) {
      if (left-- == 0) throw Stop{};  // during the pass after that
    };
    EXPECT_THROW(trace_reference(r.scene, r.gbuffer, p, report, interrupt), Stop);
  }
  Report report;
  const Reference resumed = trace_reference(r.scene, r.gbuffer, p, report);
  EXPECT_EQ(report.to_json()["counts"]["resumed_passes"], 8);
  EXPECT_TRUE(same(whole, resumed));
  // The finished work goes on when more is asked for.
  p.samples = 1024;
  EXPECT_TRUE(same(trace(r, params(1024)), trace(r, p)));
}

TEST(Reference, CheckpointOfOtherInputsIsRefused) {
  Room r = room();
  const TemporaryFolder folder;
  ReferenceParams p = params(256);
  p.checkpoint = folder / "work.exr";
  trace(r, p);
  const auto refused = [&](const Room& room, const ReferenceParams& with) {
    expect_error(ErrorCode::invalid_data, {"work.exr", "checkpoint of another"}, [&] { trace(room, with); });
  };
  for (const char* strategy : {"light", "brdf"}) {
    ReferenceParams other = p;
    other.strategy = strategy;
    refused(r, other);
  }
  ReferenceParams other = p;
  other.seed = 1;
  refused(r, other);
  Room brighter = room();
  brighter.scene.lights[0].intensity.x *= 1.01;
  refused(brighter, p);
  Room moved = room();
  moved.scene.instances[0].vertices[2].position[0] += 1e-3F;
  refused(moved, p);
  Room painted = room();
  painted.scene.materials[1].base_color.z = 0.31;
  refused(painted, p);
  Room seen = room();
  seen.gbuffer.pixels[0].position.x += 1e-3F;
  refused(seen, p);
  EXPECT_NO_THROW(trace(r, p));
}

TEST(Reference, DirectLightIsExact) {
  const Room r = room();
  const Reference image = trace(r, params(8));
  const std::size_t wall = kSpacing;
  const Vec3 x = to_double(r.gbuffer.pixels[wall].position), v = r.scene.lights[0].position - x;
  const double expected = 0.5 / std::numbers::pi * 3 * normalise(v).x / dot(v, v);
  EXPECT_NEAR(to_double(image.radiance.direct[wall]).y / expected, 1, 1e-6);
}

TEST(Reference, RoundsUpToWholePassesOfWhichThereAreEight) {
  const Room r = room();
  for (const auto& [asked, done] :
       {std::pair{1, 8u}, {8, 8u}, {20, 20u}, {64, 64u}, {100, 104u}, {257, 288u}})
    EXPECT_EQ(trace(r, params(asked)).samples, done) << asked;
}

TEST(Reference, StopsAtTheTargetError) {
  const Room r = room();
  ReferenceParams p = params(1 << 20);
  p.target_error = 0.02;
  Report report;
  const Reference image = trace_reference(r.scene, r.gbuffer, p, report);
  const double reached = report.to_json()["counts"]["relative_error"];
  EXPECT_LE(reached, 0.02);
  EXPECT_LT(image.samples, 1u << 18);
  EXPECT_TRUE(report.warnings().empty());
  p.samples = 256;
  p.target_error = 1e-9;
  trace_reference(r.scene, r.gbuffer, p, report);
  EXPECT_EQ(report.warnings().size(), 1u);
}

TEST(Reference, StopsWhenTheTimeIsOver) {
  const Room r = room();
  ReferenceParams p = params(1 << 24);
  p.time_budget_s = 1e-3;
  EXPECT_LT(trace(r, p).samples, 1u << 20);
}

TEST(Reference, ProgressRisesToOne) {
  const Room r = room();
  Report report;
  std::vector<double> shares;
  trace_reference(r.scene, r.gbuffer, params(256), report, [&](double share) { shares.push_back(share); });
  EXPECT_EQ(shares.size(), 8u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

TEST(Reference, SaysWhatIsWrong) {
  const Room r = room();
  const auto fails = [&](ErrorCode code, const char* text, auto change) {
    Room broken = r;
    ReferenceParams p = params(8);
    change(broken, p);
    expect_error(code, {text}, [&] { trace(broken, p); });
  };
  fails(ErrorCode::bad_value, "guess", [](Room&, ReferenceParams& p) { p.strategy = "guess"; });
  fails(ErrorCode::out_of_range, "samples", [](Room&, ReferenceParams& p) { p.samples = 0; });
  fails(ErrorCode::out_of_range, "target", [](Room&, ReferenceParams& p) { p.target_error = 0; });
  fails(ErrorCode::out_of_range, "budget", [](Room&, ReferenceParams& p) { p.time_budget_s = -1; });
  fails(ErrorCode::invalid_data, "anchor", [](Room& b, ReferenceParams&) { b.gbuffer.anchor.x += 1; });
  fails(ErrorCode::bad_light, "no light", [](Room& b, ReferenceParams&) { b.scene.lights.clear(); });
}

}  // namespace
}  // namespace vsgl::reference
