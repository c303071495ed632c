// Each way in which an artifact can be broken has its own number and names the place.

#include <gtest/gtest.h>

#include <functional>

#include "artifact_samples.h"

namespace vsgl {
namespace {

using namespace test;

// One artifact kind: a valid file and its reader. `part` holds float channel `channel`.
struct Kind {
  const char* name;
  std::function<void(const std::filesystem::path&)> write_valid, read;
  const char* channel;  // some required float channel of the first part
  const char* bounded;  // some channel of the first part that must not be negative ...
  const char* bounds;   // ... and what its message says of that
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"gbuffer", [](const auto& p) { write(p, sample_gbuffer(true), sample_provenance()); },
       [](const auto& p) { read_gbuffer(p); }, "shading_normal.Y", "depth.Z", "at least 0"},
      {"rsm", [](const auto& p) { write(p, sample_rsm(true), sample_provenance()); },
       [](const auto& p) { read_rsm(p); }, "lobe_diffuse.Q", "spread.V", "at least 0"},
      {"pdf", [](const auto& p) { write(p, sample_pdf(), sample_provenance()); },
       [](const auto& p) { read_pdf(p); }, "pdf.V", "pdf.V", "at least 0"},
      {"lights", [](const auto& p) { write(p, sample_lights(9, true), sample_provenance()); },
       [](const auto& p) { read_lights(p); }, "axis_specular.X", "variance.V", "at least 0"},
      {"ism", [](const auto& p) { write(p, sample_shadow_maps(5), sample_provenance()); },
       [](const auto& p) { read_shadow_maps(p); }, "inverse_distance.V", "inverse_distance.V", "at least 0"},
      {"indirect", [](const auto& p) { write(p, sample_indirect(true, true, true), sample_provenance()); },
       [](const auto& p) { read_indirect(p); }, "indirect.G", "cancellation.V", "0..1"},
      {"reference", [](const auto& p) { write(p, sample_reference(true), sample_provenance()); },
       [](const auto& p) { read_reference(p); }, "variance.G", "variance.G", "at least 0"},
  };
  return all;
}

class ReaderErrors : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    GetParam().write_valid(valid_);
    ASSERT_NO_THROW(GetParam().read(valid_));
  }
  void expect(ErrorCode code, std::vector<std::string> fragments,
              const std::function<void(ExrFile&)>& change) {
    rewrite(valid_, broken_, change);
    fragments.push_back("broken.exr");
    expect_error(code, fragments, [&] { GetParam().read(broken_); });
  }

  TemporaryFolder folder_;
  std::filesystem::path valid_ = folder_ / "valid.exr", broken_ = folder_ / "broken.exr";
};

// Without this the other tests would prove nothing.
TEST_P(ReaderErrors, UnchangedRewriteIsRead) {
  rewrite(valid_, broken_, [](ExrFile&) {});
  EXPECT_NO_THROW(GetParam().read(broken_));
}

TEST_P(ReaderErrors, MissingChannel) {
  const std::string channel = GetParam().channel;
  expect(ErrorCode::missing_channel, {"'" + channel + "' is missing"}, [&](ExrFile& file) {
    for (ExrLevel& level : file.parts[0].levels) {
      level.channels["other.V"] = level.channels.at(channel);
      level.channels.erase(channel);
    }
  });
}

TEST_P(ReaderErrors, WrongChannelType) {
  const std::string channel = GetParam().channel;
  expect(ErrorCode::wrong_channel_type, {channel, "is UINT but must be FLOAT"}, [&](ExrFile& file) {
    for (ExrLevel& level : file.parts[0].levels)
      level.channels[channel] = std::vector<std::uint32_t>(static_cast<std::size_t>(level.width) *
                                                           static_cast<std::size_t>(level.height));
  });
}

TEST_P(ReaderErrors, NotANumber) {
  const std::string channel = GetParam().channel;
  const float marker = 0.7129834f;
  rewrite(valid_, broken_, [&](ExrFile& file) { pixel(file, 0, 0, channel, 3) = marker; });
  poison(broken_, marker);
  const ExrFile file = read_exr(valid_);
  const std::string place = file.parts[0].width() == 1 ? "(0,3)" : "(3,0)";
  expect_error(ErrorCode::non_finite, {"broken.exr", channel, "nan", place},
               [&] { GetParam().read(broken_); });
}

TEST_P(ReaderErrors, Negative) {
  const std::string channel = GetParam().bounded;
  expect(ErrorCode::invalid_data,
         {channel, std::string("-0.25 is not ") + GetParam().bounds, "write the file again"},
         [&](ExrFile& file) { pixel(file, 0, 0, channel, 1) = -0.25f; });
}

TEST_P(ReaderErrors, AnotherKind) {
  expect(ErrorCode::wrong_schema,
         {"is a 'sculpture' file", std::string("'") + GetParam().name + "' is needed"},
         [](ExrFile& file) { file.parts.back().attributes["vsgl.schema"] = std::string("sculpture"); });
}

TEST_P(ReaderErrors, NoSchema) {
  expect(ErrorCode::wrong_schema, {"no file of ours"},
         [](ExrFile& file) { file.parts[0].attributes.erase("vsgl.schema"); });
}

TEST_P(ReaderErrors, AnotherVersion) {
  expect(ErrorCode::wrong_schema, {"version 2", "reads version 1"},
         [](ExrFile& file) { file.parts[0].attributes["vsgl.version"] = 2; });
}

TEST_P(ReaderErrors, MissingAttribute) {
  expect(ErrorCode::missing_attribute, {"'vsgl.version'"},
         [](ExrFile& file) { file.parts[0].attributes.erase("vsgl.version"); });
}

TEST_P(ReaderErrors, Truncated) {
  std::ifstream in(valid_, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  for (double fraction : {0.0, 0.01, 0.3, 0.6, 0.99}) {
    std::ofstream(broken_, std::ios::binary)
        << whole.substr(0, static_cast<std::size_t>(fraction * static_cast<double>(whole.size())));
    expect_error(ErrorCode::exr_unreadable, {"broken.exr"}, [&] { GetParam().read(broken_); });
  }
}

TEST_P(ReaderErrors, MissingFile) {
  expect_error(ErrorCode::file_not_found, {"absent.exr"}, [&] { GetParam().read(folder_ / "absent.exr"); });
}

INSTANTIATE_TEST_SUITE_P(Every, ReaderErrors, testing::ValuesIn(kinds()),
                         [](const auto& row) { return std::string(row.param.name); });

// What only one kind has.
template <typename Artifact>
class Broken {
 public:
  Broken(const Artifact& valid, std::function<void(const std::filesystem::path&)> read)
      : read_(std::move(read)) {
    write(folder_ / "valid.exr", valid, sample_provenance());
    read_(folder_ / "valid.exr");
  }
  void expect(ErrorCode code, const std::vector<std::string>& fragments,
              const std::function<void(ExrFile&)>& change) {
    rewrite(folder_ / "valid.exr", folder_ / "broken.exr", change);
    expect_error(code, fragments, [&] { read_(folder_ / "broken.exr"); });
  }

 private:
  TemporaryFolder folder_;
  std::function<void(const std::filesystem::path&)> read_;
};

std::uint32_t& id(ExrFile& file, std::size_t part, const std::string& channel, std::size_t index) {
  return std::get<1>(file.parts.at(part).levels.at(0).channels.at(channel)).at(index);
}

// Keeps the first side x side pixels' worth of each channel.
void shrink(ExrLevel& level, int side) {
  level.width = level.height = side;
  for (auto& [name, plane] : level.channels)
    std::visit([&](auto& values) { values.resize(static_cast<std::size_t>(side * side)); }, plane);
}

TEST(GBufferErrors, RangesOfItsChannels) {
  Broken<GBuffer> file(sample_gbuffer(true), [](const auto& p) { read_gbuffer(p); });
  file.expect(ErrorCode::invalid_data, {"'diffuse.G'", "1.5 is not 0..1", "(2,1)"},
              [](ExrFile& f) { pixel(f, 0, 0, "diffuse.G", 7) = 1.5f; });
  file.expect(ErrorCode::invalid_data, {"'ndf.I'", "4 is not 0..3"},
              [](ExrFile& f) { id(f, 0, "ndf.I", 2) = 4; });
  file.expect(ErrorCode::invalid_data, {"'alpha.V'", "is not 1e-3..1"},
              [](ExrFile& f) { pixel(f, 0, 0, "alpha.V", 2) = 1e-4f; });
  file.expect(ErrorCode::invalid_data, {"'normal'", "direction of length 3"}, [](ExrFile& f) {
    pixel(f, 0, 0, "normal.X", 1) = 0;
    pixel(f, 0, 0, "normal.Y", 1) = 3;
    pixel(f, 0, 0, "normal.Z", 1) = 0;
  });
  file.expect(ErrorCode::invalid_data, {"'shading_normal'", "length 0"}, [](ExrFile& f) {
    for (const char* c : {"shading_normal.X", "shading_normal.Y", "shading_normal.Z"})
      pixel(f, 0, 0, c, 14) = 0;
  });
  file.expect(ErrorCode::invalid_data, {"specular lobe where nothing is seen"},
              [](ExrFile& f) { id(f, 0, "ndf.I", 4) = 1; });
  file.expect(ErrorCode::invalid_data, {"'scene_radius' is -1"},
              [](ExrFile& f) { f.parts[0].attributes["scene_radius"] = -1.0; });
  file.expect(ErrorCode::missing_attribute, {"'camera'"},
              [](ExrFile& f) { f.parts[0].attributes.erase("camera"); });
}

TEST(RsmErrors, Structure) {
  Broken<Rsm> file(sample_rsm(true), [](const auto& p) { read_rsm(p); });
  file.expect(ErrorCode::missing_part, {"'key.surface' is missing"},
              [](ExrFile& f) { f.parts.erase(f.parts.begin() + 1); });
  file.expect(ErrorCode::missing_part, {"no layer"},
              [](ExrFile& f) { std::erase_if(f.parts, [](const ExrPart& part) { return part.mipmap; }); });
  file.expect(ErrorCode::missing_part, {"no mip level 1"}, [](ExrFile& f) {
    f.parts[0].mipmap = false;
    f.parts[0].levels.resize(1);
  });
  file.expect(ErrorCode::wrong_size, {"'key.surface'", "4x4", "8x8"},
              [](ExrFile& f) { shrink(f.parts[1].levels[0], 4); });
  file.expect(ErrorCode::wrong_size, {"'lamp.px'", "4x4"},
              [](ExrFile& f) { f.parts[2].levels.erase(f.parts[2].levels.begin()); });
  file.expect(ErrorCode::missing_channel, {"only one of"}, [](ExrFile& f) {
    for (const char* c : {"specular.R", "specular.G", "specular.B", "alpha.V", "ndf.I"})
      f.parts[1].levels[0].channels.erase(c);
  });
}

TEST(RsmErrors, NotAPowerOfTwo) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", sample_rsm(false), sample_provenance());
  rewrite(folder / "valid.exr", folder / "broken.exr", [](ExrFile& f) {
    for (ExrPart& part : f.parts) {
      part.mipmap = false;
      part.levels.resize(1);
      part.levels[0].height = 2;
      for (auto& [name, plane] : part.levels[0].channels) std::visit([](auto& v) { v.resize(16); }, plane);
    }
  });
  expect_error(ErrorCode::wrong_size, {"8x2", "power of two"}, [&] { read_rsm(folder / "broken.exr"); });
}

TEST(RsmErrors, Ranges) {
  Broken<Rsm> file(sample_rsm(true), [](const auto& p) { read_rsm(p); });
  file.expect(ErrorCode::invalid_data, {"'key'", "level 2", "'lobe_specular.Q'", "1.25 is not 0..1"},
              [](ExrFile& f) { pixel(f, 0, 2, "lobe_specular.Q", 3) = 1.25f; });
  file.expect(ErrorCode::invalid_data, {"'weight.V'"},
              [](ExrFile& f) { pixel(f, 2, 1, "weight.V", 3) = -1e-6f; });
  file.expect(ErrorCode::invalid_data, {"'rsm_width' is 9, must be 1..8"},
              [](ExrFile& f) { f.parts[0].attributes["rsm_width"] = 9; });
  file.expect(ErrorCode::invalid_data, {"'light.type' is 'sun'"},
              [](ExrFile& f) { f.parts[0].attributes["light.type"] = std::string("sun"); });
  file.expect(ErrorCode::invalid_data, {"'light.cos_outer'"},
              [](ExrFile& f) { f.parts[0].attributes["light.cos_outer"] = 1.5; });
  file.expect(ErrorCode::invalid_data, {"'light.up'", "no unit vector"}, [](ExrFile& f) {
    f.parts[2].attributes["light.up"] = std::array<double, 3>{0, 0, 2};
  });
}

TEST(PdfErrors, MeanMustBeOne) {
  Broken<Pdf> file(sample_pdf(), [](const auto& p) { read_pdf(p); });
  file.expect(ErrorCode::invalid_data, {"mean is 1.0312", "instead of 1"},
              [](ExrFile& f) { pixel(f, 1, 0, "pdf.V", 4) = 1.5f; });
  file.expect(ErrorCode::missing_attribute, {"'pdf.method'"},
              [](ExrFile& f) { f.parts[0].attributes.erase("pdf.method"); });
}

TEST(LightsErrors, CountsAndRanges) {
  Broken<Lights> file(sample_lights(9, true), [](const auto& p) { read_lights(p); });
  file.expect(ErrorCode::wrong_size, {"9x1 pixels instead of 8x1"},
              [](ExrFile& f) { f.parts[0].attributes["lights.count"] = 8; });
  file.expect(ErrorCode::invalid_data, {"'lights.count' is -1"},
              [](ExrFile& f) { f.parts[0].attributes["lights.count"] = -1; });
  file.expect(ErrorCode::invalid_data, {"'sharpness_diffuse.V'", "is not 0..2^41"},
              [](ExrFile& f) { pixel(f, 0, 0, "sharpness_diffuse.V", 2) = 0x1p42f; });
  file.expect(ErrorCode::invalid_data, {"'alpha.V'", "is not 1e-3..1"},
              [](ExrFile& f) { pixel(f, 0, 0, "alpha.V", 2) = 0; });
  for (const char* layer : {"axis_diffuse", "axis_specular", "normal", "shading_normal", "incident"})
    file.expect(ErrorCode::invalid_data, {layer, "direction of length", "(5,0)"},
                [&](ExrFile& f) { pixel(f, 0, 0, std::string(layer) + ".X", 5) = 2; });
  file.expect(ErrorCode::missing_part, {"2 parts instead of one"}, [](ExrFile& f) {
    f.parts.push_back(f.parts[0]);
    f.parts[0].name = "a";
    f.parts[1].name = "b";
  });
}

TEST(LightsErrors, Chains) {
  Lights lights = sample_lights(9, true);
  lights.chains.states = {{1, 2, 0}, {3, 4, 1}};
  Broken<Lights> file(lights, [](const auto& p) { read_lights(p); });
  file.expect(ErrorCode::invalid_data, {"'chains.count' is 0"},
              [](ExrFile& f) { f.parts[1].attributes["chains.count"] = 0; });
  file.expect(ErrorCode::wrong_size, {"'chains'", "2x1 pixels instead of 3x1"},
              [](ExrFile& f) { f.parts[1].attributes["chains.count"] = 3; });
  file.expect(ErrorCode::invalid_data, {"'chains.steps' is -1"},
              [](ExrFile& f) { f.parts[1].attributes["chains.steps"] = -1; });
  file.expect(ErrorCode::missing_part, {"'lights' is missing"}, [](ExrFile& f) { f.parts[0].name = "tree"; });
}

// Levels follow from the children; what does not follow is refused.
TEST(LightsErrors, Trees) {
  Broken<Lights> file(sample_tree(), [](const auto& p) { read_lights(p); });
  const auto set_children = [](std::size_t light, std::uint32_t first) {
    return [=](ExrFile& f) { std::get<1>(f.parts[0].levels[0].channels.at("children.I")).at(light) = first; };
  };
  const std::string follow = "children do not follow one another at ";
  file.expect(ErrorCode::invalid_data, {"'children.I'", follow + "(0,0)"}, set_children(0, 5));
  file.expect(ErrorCode::invalid_data, {"'children.I'", follow + "(3,0)"}, set_children(3, 1));
  file.expect(ErrorCode::invalid_data, {"'children.I'", follow + "(8,0)"}, set_children(8, 9));
  file.expect(ErrorCode::invalid_data, {"'children.I'", "no light has this one among its children at (5,0)"},
              set_children(3, 0));
  file.expect(ErrorCode::invalid_data, {"'children.I'", "children in a list at (0,0)"},
              [](ExrFile& f) { f.parts[0].attributes["lights.tree"] = 0; });
  file.expect(ErrorCode::invalid_data, {"'lights.tree' is 2"},
              [](ExrFile& f) { f.parts[0].attributes["lights.tree"] = 2; });
}

TEST(ShadowMapErrors, Sizes) {
  Broken<ShadowMaps> file(sample_shadow_maps(5), [](const auto& p) { read_shadow_maps(p); });
  file.expect(ErrorCode::missing_part, {"'views' is missing"}, [](ExrFile& f) { f.parts.pop_back(); });
  file.expect(ErrorCode::wrong_size, {"'views'", "1x5 pixels instead of 1x4"},
              [](ExrFile& f) { f.parts[0].attributes["ism.count"] = 4; });
  file.expect(ErrorCode::wrong_size, {"'atlas'", "8x12 pixels instead of 12x8"},
              [](ExrFile& f) { f.parts[0].attributes["ism.columns"] = 3; });
  file.expect(ErrorCode::invalid_data, {"'ism.columns' is 0"},
              [](ExrFile& f) { f.parts[0].attributes["ism.columns"] = 0; });
  file.expect(ErrorCode::invalid_data, {"'ism.tile' is 0"},
              [](ExrFile& f) { f.parts[0].attributes["ism.tile"] = 0; });
  file.expect(ErrorCode::invalid_data, {"'axis'", "(0,2)"},
              [](ExrFile& f) { pixel(f, 1, 0, "axis.Z", 2) = 5; });
}

TEST(IndirectErrors, LayersBelongTogether) {
  Broken<Indirect> file(sample_indirect(true, true, true), [](const auto& p) { read_indirect(p); });
  file.expect(ErrorCode::missing_channel, {"'indirect.R' is missing"}, [](ExrFile& f) {
    for (const char* c : {"indirect.R", "indirect.G", "indirect.B"}) f.parts[0].levels[0].channels.erase(c);
  });
  file.expect(ErrorCode::missing_channel, {"'specular.B' is missing"},
              [](ExrFile& f) { f.parts[0].levels[0].channels.erase("specular.B"); });
  file.expect(ErrorCode::missing_channel, {"'diffuse.R' is missing"}, [](ExrFile& f) {
    std::erase_if(f.parts[0].levels[0].channels,
                  [](const auto& c) { return !c.first.starts_with("indirect"); });
  });
  file.expect(ErrorCode::invalid_data, {"'cancellation.V'", "2 is not 0..1"},
              [](ExrFile& f) { pixel(f, 0, 0, "cancellation.V", 2) = 2; });
}

TEST(ReferenceErrors, OnePassHasNoVariance) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", sample_reference(false), sample_provenance());
  rewrite(folder / "valid.exr", folder / "broken.exr",
          [](ExrFile& file) { file.parts[0].attributes["reference.passes"] = 1; });
  expect_error(ErrorCode::invalid_data, {"reference.passes"}, [&] { read_reference(folder / "broken.exr"); });
}

TEST(ReferenceErrors, Strategy) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", sample_reference(false), sample_provenance());
  rewrite(folder / "valid.exr", folder / "broken.exr",
          [](ExrFile& file) { file.parts[0].attributes["reference.strategy"] = std::string("guess"); });
  expect_error(ErrorCode::invalid_data, {"reference.strategy", "guess"},
               [&] { read_reference(folder / "broken.exr"); });
}

}  // namespace
}  // namespace vsgl
