#include <gtest/gtest.h>

#include <cstring>

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

const Rsm& room() {
  static const Rsm rsm = test::room_rsm(64, 2);
  return rsm;
}

struct Frame {
  Lights lights;
  nlohmann::ordered_json counts;
};

Frame generate(const Pdf& pdf, int mutations = 1, const Chains* previous = nullptr) {
  LightsParams params;
  params.method = "metropolis";
  params.count = 400;
  params.mutations = mutations;
  params.previous = previous;
  Report report;
  Lights lights = generate_lights(room(), &pdf, params, &device(), report);
  return {std::move(lights), report.to_json().at("counts")};
}

bool same_lights(const Lights& a, const Lights& b) {
  return a.lights.size() == b.lights.size() &&
         std::memcmp(a.lights.data(), b.lights.data(), a.lights.size() * sizeof(Light)) == 0;
}

TEST(MetropolisLights, WithoutMutationsAFrameIsTheOneBefore) {
  const Pdf pdf = test::flux_pdf(room());
  const Frame first = generate(pdf), second = generate(pdf, 0, &first.lights.chains);
  EXPECT_TRUE(same_lights(first.lights, second.lights));
  EXPECT_EQ(second.lights.chains.steps, 64);
  EXPECT_FALSE(second.counts.contains("acceptance_rate"));
}

TEST(MetropolisLights, MostChainsStayFromFrameToFrame) {
  const Pdf pdf = test::flux_pdf(room());
  const Frame first = generate(pdf), second = generate(pdf, 1, &first.lights.chains);
  EXPECT_EQ(first.lights.chains.steps, 64);
  EXPECT_EQ(second.lights.chains.steps, 65);
  int stayed = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const interop::Chain &a = first.lights.chains.states[i], &b = second.lights.chains.states[i];
    stayed += a.x == b.x && a.y == b.y && a.layer == b.layer;
  }
  EXPECT_EQ(second.counts.at("acceptance_rate").get<double>(), (400 - stayed) / 400.0);
  EXPECT_GT(stayed, 20);
  EXPECT_LT(stayed, 390);
  const Frame third = generate(pdf, 1, &second.lights.chains);  // other random numbers
  EXPECT_FALSE(same_lights(second.lights, third.lights));
}

TEST(MetropolisLights, CarryThePowerOfTheRsm) {
  const Pdf pdf = test::flux_pdf(room());
  double sum = 0;
  for (const Light& l : generate(pdf).lights.lights)
    sum += luminance(test::to_double(l.power_diffuse) + test::to_double(l.power_specular));
  EXPECT_NEAR(sum / test::reflected_power(room()), 1, 1e-5);
}

// The light has gone from under most chains: they give no light, and find it again in time.
TEST(MetropolisLights, ChainsWithoutDensityGiveNoLight) {
  const Pdf before = test::flux_pdf(room());
  std::vector<std::vector<double>> corner(2, std::vector<double>(64 * 64));
  for (int k = 0; k < 64 * 64; ++k)
    corner[0][static_cast<std::size_t>(k)] = k % 64 < 32 && k / 64 < 32 ? 1 : 0;
  const Pdf after = test::make_pdf(room(), corner);
  Frame frame = generate(before);
  const Frame next = generate(after, 1, &frame.lights.chains);
  const int lost = next.counts.at("chains_without_density");
  EXPECT_GT(lost, 100);
  EXPECT_LE(next.lights.lights.size(), 400u - static_cast<std::size_t>(lost));
  frame = generate(after, 200, &next.lights.chains);
  EXPECT_EQ(frame.counts.at("chains_without_density"), 0);
}

TEST(MetropolisLights, RefusesChainsOfOtherLights) {
  const Pdf pdf = test::flux_pdf(room());
  Chains chains = generate(pdf).lights.chains;
  chains.states[7].layer = 2;
  test::expect_error(ErrorCode::invalid_data, {"previous", "layer"}, [&] { generate(pdf, 1, &chains); });
  chains.states.resize(399);
  test::expect_error(ErrorCode::wrong_size, {"previous", "399"}, [&] { generate(pdf, 1, &chains); });
  LightsParams params;
  params.method = "metropolis";
  Report report;
  const auto run = [&] { generate_lights(room(), &pdf, params, &device(), report); };
  params.mutations = -1;
  test::expect_error(ErrorCode::out_of_range, {"mutations"}, run);
  params.mutations = 1;
  params.large_step = 1.5;
  test::expect_error(ErrorCode::out_of_range, {"large_step"}, run);
}

TEST(MetropolisLights, DescribesItsChains) {
  const Pdf pdf = test::flux_pdf(room());
  const Lights lights = generate(pdf).lights;
  const auto json = describe(lights, room(), {.method = "metropolis"}, false);
  EXPECT_EQ(json.at("chains").at("count"), 400);
  EXPECT_EQ(json.at("chains").at("steps"), 64);
}

}  // namespace
}  // namespace vsgl
