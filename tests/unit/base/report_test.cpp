#include "base/report.h"

#include <gtest/gtest.h>

namespace vsgl {
namespace {

using nlohmann::ordered_json;

TEST(Report, StartsEmpty) {
  EXPECT_EQ(Report().to_json(),
            ordered_json::parse(R"({"phases": [], "counts": {}, "skipped": [], "warnings": []})"));
}

TEST(Report, AddsUpPhasesInTheOrderOfTheirFirstAppearance) {
  Report report;
  report.time("read", 1);
  report.device_time("shade", 0.25);
  report.time("read", 0.5);
  report.time("shade", 2);
  report.device_time("shade", 0.25);
  EXPECT_EQ(report.to_json()["phases"], ordered_json::parse(R"([{"name": "read", "host_s": 1.5},
                                                                {"name": "shade", "host_s": 2.0, "device_s": 0.5}])"));
}

TEST(Report, KeepsCountsOmissionsAndWarnings) {
  Report report;
  report.count("lights", 1);
  report.count("method", "vpl");
  report.count("lights", 2);
  report.skipped("specular lobes", "no specular texel");
  report.warn("blended material");
  EXPECT_EQ(report.to_json()["counts"].dump(), R"({"lights":2,"method":"vpl"})");
  EXPECT_EQ(report.to_json()["skipped"].dump(), R"([{"what":"specular lobes","why":"no specular texel"}])");
  EXPECT_EQ(report.to_json()["warnings"].dump(), R"(["blended material"])");
}

TEST(Report, PhaseTimerAddsItsScope) {
  Report report;
  { PhaseTimer timer(report, "scope"); }
  const auto phase = report.to_json()["phases"][0];
  EXPECT_EQ(phase["name"], "scope");
  EXPECT_GE(phase["host_s"], 0.0);
  EXPECT_LT(phase["host_s"], 60.0);
}

}  // namespace
}  // namespace vsgl
