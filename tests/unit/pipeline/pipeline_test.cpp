#include "pipeline/pipeline.h"

#include "../expect_error.h"
#include "base/atomic_file.h"

namespace vsgl {
namespace {

class PipelineJson : public testing::Test {
 protected:
  Pipeline read(const std::string& members) {
    write_text(folder_ / "p.json", "{\"$schema\": \"vsgltools/pipeline/1\"" + members + "}");
    return read_pipeline(folder_ / "p.json");
  }

  test::TemporaryFolder folder_;
};

TEST_F(PipelineJson, AbsentStagesHaveTheirDefaults) {
  const Pipeline read_one = read(""), made;
  EXPECT_EQ(read_one.rsm_bake.rsm.width, made.rsm_bake.rsm.width);
  EXPECT_FALSE(read_one.rsm_bake.resolution);
  EXPECT_EQ(read_one.pdf_build.method, made.pdf_build.method);
  EXPECT_EQ(read_one.vsgl_gen.count, made.vsgl_gen.count);
  ASSERT_TRUE(read_one.ismap);
  EXPECT_EQ(read_one.ismap->tile, made.ismap->tile);
  EXPECT_EQ(read_one.shade.cbr, made.shade.cbr);
}

TEST(Pipelines, CommittedOnesAreRead) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VSGL_SOURCE_DIR "/configs/pipelines")) {
    EXPECT_NO_THROW(read_pipeline(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 5u);
}

// What a paper's pipeline is does not depend on the tools' defaults.
TEST(Pipelines, PapersNameTheirMethods) {
  const Pipeline vsgl = read_pipeline(VSGL_SOURCE_DIR "/configs/pipelines/vsgl.json");
  EXPECT_EQ(vsgl.vsgl_gen.method, "fis-2016");
  EXPECT_EQ(vsgl.ismap->method, "ism");
  EXPECT_EQ(vsgl.shade.light_model, "vsgl");
}

TEST_F(PipelineJson, EveryKindOfOptionArrives) {
  const Pipeline p =
      read(R"(, "rsm_bake": {"rsm_size": "64x32", "resolution": "80x45", "rsm_normals": "paper"},
      "pdf_build": {"method": "flux"}, "vsgl_gen": {"count": 7, "kernel_scale": 2},
      "ismap": {"no_pull_push": true}, "shade": {"cbr": 0.25, "specular_lobe": "asg"})");
  EXPECT_EQ(p.rsm_bake.rsm.width, 64);
  EXPECT_EQ(p.rsm_bake.rsm.height, 32);
  EXPECT_EQ(p.rsm_bake.rsm.normals, NormalConvention::paper);
  EXPECT_EQ(p.rsm_bake.resolution->width, 80);
  EXPECT_EQ(p.rsm_bake.resolution->height, 45);
  EXPECT_EQ(p.pdf_build.method, "flux");
  EXPECT_EQ(p.vsgl_gen.count, 7);
  EXPECT_EQ(p.vsgl_gen.kernel_scale, 2);
  EXPECT_FALSE(p.ismap->pull_push);
  EXPECT_EQ(p.shade.cbr, 0.25);
  EXPECT_EQ(p.shade.specular_lobe, "asg");
}

TEST_F(PipelineJson, FalseLeavesAFlagOff) {
  EXPECT_TRUE(read(R"(, "ismap": {"no_pull_push": false})").ismap->pull_push);
}

TEST_F(PipelineJson, NullTakesShadowsAway) {
  EXPECT_FALSE(read(R"(, "ismap": null)").ismap);
}

TEST_F(PipelineJson, TheErrorOfACutIsThatOfIsmapOrWithoutItOfShade) {
  Pipeline p = read(R"(, "ismap": {"error": 0.5, "exact": true}, "shade": {"error": 0.25})");
  EXPECT_EQ(p.ismap->error, 0.5);
  EXPECT_TRUE(p.ismap->exact);
  EXPECT_EQ(p.light_cut.error, 0.25);
  p.set_error(0.001);
  EXPECT_EQ(p.ismap->error, 0.001);
  EXPECT_EQ(p.light_cut.error, 0.001);
  Pipeline without = read(R"(, "ismap": null)");
  without.set_error(0.125);
  EXPECT_EQ(without.light_cut.error, 0.125);
}

TEST_F(PipelineJson, SeedAndSkipReachEveryStage) {
  Pipeline p;
  p.set_seed(5);
  p.set_skip(false);
  EXPECT_EQ(p.pdf_build.seed, 5u);
  EXPECT_EQ(p.vsgl_gen.seed, 5u);
  EXPECT_EQ(p.ismap->seed, 5u);
  EXPECT_FALSE(p.pdf_build.skip);
  EXPECT_FALSE(p.ismap->skip_powerless);
  EXPECT_FALSE(p.shade.skip);
}

TEST_F(PipelineJson, ErrorsNameFilePlaceAndTheNearestKey) {
  test::expect_error(ErrorCode::unknown_option, {"p.json: /shade/cbrr", "\"cbr\""},
                     [&] { read(R"(, "shade": {"cbrr": 1})"); });
  test::expect_error(ErrorCode::bad_value, {"p.json: /shade/cbr: expected a finite number"},
                     [&] { read(R"(, "shade": {"cbr": "x"})"); });
  test::expect_error(ErrorCode::out_of_range, {"p.json: /shade/cbr: 1.5 is out of range"},
                     [&] { read(R"(, "shade": {"cbr": 1.5})"); });
  test::expect_error(ErrorCode::json_unknown_key, {"p.json: /shdae", "\"shade\""},
                     [&] { read(R"(, "shdae": {})"); });
}

}  // namespace
}  // namespace vsgl
