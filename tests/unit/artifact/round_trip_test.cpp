#include <gtest/gtest.h>

#include "artifact_samples.h"

namespace vsgl {
namespace {

using namespace test;

TEST(RoundTrip, GBuffer) {
  const TemporaryFolder folder;
  for (bool specular : {false, true}) {
    const GBuffer a = sample_gbuffer(specular);
    write(folder / "g.exr", a, sample_provenance());
    const GBuffer b = read_gbuffer(folder / "g.exr");
    EXPECT_EQ(b.width, 5);
    EXPECT_EQ(b.height, 3);
    EXPECT_EQ(a.anchor, b.anchor);
    EXPECT_EQ(a.camera, b.camera);
    EXPECT_EQ(a.scene_radius, b.scene_radius);
    EXPECT_EQ(b.has_specular(), specular);
    EXPECT_TRUE(same_bytes(a.pixels, b.pixels));
    EXPECT_EQ(has_channel(read_exr(folder / "g.exr").parts[0], "alpha.V"), specular);
  }
}

TEST(RoundTrip, Rsm) {
  const TemporaryFolder folder;
  for (bool specular : {false, true}) {
    const Rsm a = sample_rsm(specular);
    write(folder / "r.exr", a, sample_provenance());
    const Rsm b = read_rsm(folder / "r.exr");
    EXPECT_EQ(b.size, 8);
    EXPECT_EQ(b.width, 7);
    EXPECT_EQ(b.height, 5);
    EXPECT_EQ(a.anchor, b.anchor);
    EXPECT_EQ(a.scene_radius, b.scene_radius);
    EXPECT_EQ(b.has_specular(), specular);
    ASSERT_EQ(b.layers.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(a.layers[i].name, b.layers[i].name);
      EXPECT_TRUE(same_bytes(a.layers[i].surface, b.layers[i].surface));
      EXPECT_TRUE(same_bytes(a.layers[i].pyramid, b.layers[i].pyramid));
      const LightSource &p = a.layers[i].light, &q = b.layers[i].light;
      EXPECT_EQ(p.name, q.name);
      EXPECT_EQ(p.type, q.type);
      EXPECT_EQ(p.position, q.position);
      EXPECT_EQ(p.right, q.right);
      EXPECT_EQ(p.up, q.up);
      EXPECT_EQ(p.forward, q.forward);
      EXPECT_EQ(p.extent_x, q.extent_x);
      EXPECT_EQ(p.extent_y, q.extent_y);
      EXPECT_EQ(p.intensity, q.intensity);
      EXPECT_EQ(p.cos_inner, q.cos_inner);
      EXPECT_EQ(p.cos_outer, q.cos_outer);
    }
    const ExrFile file = read_exr(folder / "r.exr");
    EXPECT_EQ(has_channel(file.part("key"), "lobe_specular.Q"), specular);
    EXPECT_EQ(has_channel(file.part("key.surface"), "ndf.I"), specular);
  }
}

TEST(RoundTrip, Pdf) {
  const TemporaryFolder folder;
  const Pdf a = sample_pdf();
  write(folder / "p.exr", a, sample_provenance());
  const Pdf b = read_pdf(folder / "p.exr");
  EXPECT_EQ(b.size, 4);
  EXPECT_EQ(b.method, "brsm-vsgl");
  ASSERT_EQ(b.layers.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.layers[i].name, b.layers[i].name);
    EXPECT_EQ(a.layers[i].pyramid, b.layers[i].pyramid);
  }
}

TEST(RoundTrip, PdfOfASceneThatEmitsNothing) {
  const TemporaryFolder folder;
  Pdf a = sample_pdf();
  for (Pdf::Layer& layer : a.layers) std::fill(layer.pyramid.begin(), layer.pyramid.end(), 0.0f);
  write(folder / "p.exr", a, sample_provenance());
  EXPECT_EQ(read_pdf(folder / "p.exr").layers[1].pyramid, a.layers[1].pyramid);
}

TEST(RoundTrip, Lights) {
  const TemporaryFolder folder;
  for (int count : {0, 1, 37, 1024, 1025, 3000})
    for (bool specular : {false, true}) {
      const Lights a = sample_lights(count, specular);
      write(folder / "l.exr", a, sample_provenance());
      const Lights b = read_lights(folder / "l.exr");
      EXPECT_EQ(b.method, "fis-2016");
      EXPECT_EQ(a.anchor, b.anchor);
      EXPECT_EQ(a.scene_radius, b.scene_radius);
      EXPECT_EQ(a.requested, b.requested);
      EXPECT_TRUE(same_bytes(a.lights, b.lights)) << count;
      const ExrFile file = read_exr(folder / "l.exr");
      EXPECT_FALSE(b.is_tree());
      EXPECT_EQ(file.parts[0].width(), std::clamp(count, 1, 1024));
      EXPECT_EQ(file.parts[0].height(), std::max(1, (count + 1023) / 1024));
      EXPECT_EQ(has_channel(file.parts[0], "sharpness_specular.V"), specular && count > 0);
    }
}

TEST(RoundTrip, Chains) {
  const TemporaryFolder folder;
  for (std::uint32_t count : {1u, 1024u, 1500u}) {
    Lights a = sample_lights(37, true);  // fewer than there are chains: some give no light
    for (std::uint32_t i = 0; i < count; ++i) a.chains.states.push_back({i, 0xffffffffu - i, i % 6});
    a.chains.steps = 65;
    write(folder / "l.exr", a, sample_provenance());
    const Lights b = read_lights(folder / "l.exr");
    EXPECT_TRUE(same_bytes(a.lights, b.lights)) << count;
    EXPECT_TRUE(same_bytes(a.chains.states, b.chains.states)) << count;
    EXPECT_EQ(b.chains.steps, 65);
  }
}

TEST(RoundTrip, LightTree) {
  const TemporaryFolder folder;
  for (const bool empty : {false, true}) {
    Lights a = sample_tree();
    if (empty) a.lights.clear(), a.levels = {0, 0};
    write(folder / "t.exr", a, sample_provenance());
    const Lights b = read_lights(folder / "t.exr");
    EXPECT_EQ(b.method, "tree");
    EXPECT_EQ(a.levels, b.levels);
    EXPECT_TRUE(same_bytes(a.lights, b.lights));
  }
}

TEST(RoundTrip, ShadowMaps) {
  const TemporaryFolder folder;
  for (int views : {0, 1, 5}) {
    const ShadowMaps a = sample_shadow_maps(views);
    write(folder / "i.exr", a, sample_provenance());
    const ShadowMaps b = read_shadow_maps(folder / "i.exr");
    EXPECT_EQ(a.tile, b.tile);
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.anchor, b.anchor);
    EXPECT_EQ(a.bias_disk_radius, b.bias_disk_radius);
    EXPECT_EQ(a.normal_offset, b.normal_offset);
    EXPECT_EQ(a.slope_bias, b.slope_bias);
    EXPECT_EQ(a.relative_bias, b.relative_bias);
    EXPECT_TRUE(same_bytes(a.views, b.views));
    EXPECT_EQ(a.inverse_distance, b.inverse_distance);
  }
}

TEST(RoundTrip, Indirect) {
  const TemporaryFolder folder;
  for (bool specular : {false, true})
    for (bool direct : {false, true}) {
      Indirect a = sample_indirect(specular, direct, !direct);
      a.passes = specular ? 64 : 1;
      write(folder / "i.exr", a, sample_provenance());
      const Indirect b = read_indirect(folder / "i.exr");
      EXPECT_EQ(b.width, 4);
      EXPECT_EQ(b.height, 2);
      EXPECT_TRUE(same_bytes(a.diffuse, b.diffuse));
      EXPECT_TRUE(same_bytes(a.specular, b.specular));
      EXPECT_TRUE(same_bytes(a.direct, b.direct));
      EXPECT_EQ(a.cancellation, b.cancellation);
      EXPECT_EQ(a.cut_size, b.cut_size);
      EXPECT_EQ(a.error_estimate, b.error_estimate);
      EXPECT_EQ(a.passes, b.passes);
      const ExrFile file = read_exr(folder / "i.exr");
      const float expected = a.diffuse[3].y + (specular ? a.specular[3].y : 0);
      EXPECT_EQ(float_channel(file, file.parts[0], 0, "indirect.G")[3], expected);
    }
}

TEST(RoundTrip, Reference) {
  const TemporaryFolder folder;
  for (bool specular : {false, true}) {
    const Reference a = sample_reference(specular);
    write(folder / "r.exr", a, sample_provenance());
    const Reference b = read_reference(folder / "r.exr");
    EXPECT_TRUE(same_bytes(a.radiance.diffuse, b.radiance.diffuse));
    EXPECT_TRUE(same_bytes(a.radiance.specular, b.radiance.specular));
    EXPECT_TRUE(same_bytes(a.radiance.direct, b.radiance.direct));
    EXPECT_TRUE(same_bytes(a.variance, b.variance));
    EXPECT_EQ(b.strategy, "mis");
    EXPECT_EQ(b.samples, 1024u);
    EXPECT_EQ(b.passes, 16);
    EXPECT_EQ(has_channel(read_exr(folder / "r.exr").parts[0], "specular.R"), specular);
  }
}

TEST(RoundTrip, DirectLightAlone) {
  const TemporaryFolder folder;
  Indirect a = sample_indirect(false, true, false);
  a.diffuse.clear();
  write(folder / "d.exr", a, sample_provenance());
  EXPECT_FALSE(has_channel(read_exr(folder / "d.exr").parts[0], "indirect.R"));
  EXPECT_TRUE(same_bytes(a.direct, read_indirect(folder / "d.exr").direct));
}

TEST(RoundTrip, EqualInputsGiveEqualBytes) {
  const TemporaryFolder folder;
  const auto bytes = [&](int threads) {
    set_exr_threads(threads);
    write(folder / "r.exr", sample_rsm(true), sample_provenance());
    write(folder / "l.exr", sample_lights(100, true), sample_provenance());
    std::string all;
    for (const char* name : {"r.exr", "l.exr"}) {
      std::ifstream in(folder / name, std::ios::binary);
      all += std::string{std::istreambuf_iterator<char>(in), {}};
    }
    set_exr_threads(0);
    return all;
  };
  EXPECT_TRUE(bytes(1) == bytes(2));
}

TEST(RoundTrip, ProvenanceIsInEveryPart) {
  const TemporaryFolder folder;
  write(folder / "r.exr", sample_rsm(false), sample_provenance());
  const ExrFile file = read_exr(folder / "r.exr");
  ASSERT_EQ(file.parts.size(), 4u);
  for (const ExrPart& part : file.parts) {
    EXPECT_EQ(string_attribute(file, part, "vsgl.schema"), "rsm");
    EXPECT_EQ(int_attribute(file, part, "vsgl.version"), 1);
    EXPECT_EQ(string_attribute(file, part, "vsgl.tool"), "rsm-bake");
    EXPECT_EQ(string_attribute(file, part, "vsgl.tool_version"), "0.1.0");
    EXPECT_EQ(string_attribute(file, part, "vsgl.command"), "rsm-bake --seed 7");
    EXPECT_EQ(string_attribute(file, part, "vsgl.seed"), "7");
    EXPECT_EQ(string_attribute(file, part, "vsgl.inputs"), R"({"scene.json":"abc123"})");
  }
}

}  // namespace
}  // namespace vsgl
