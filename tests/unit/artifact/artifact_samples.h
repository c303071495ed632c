#pragma once

// Small valid artifacts with a different value in every member, so that a swapped or dropped channel shows.

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>

#include "../expect_error.h"
#include "artifact/artifact.h"
#include "image/exr.h"

namespace vsgl::test {

inline Provenance sample_provenance() {
  return {"rsm-bake", "0.1.0", "rsm-bake --seed 7", 7, {{"scene.json", "abc123"}}};
}

// Counts up: every number a sample takes is a new one, within 0..1.
class Counter {
 public:
  float next() { return static_cast<float>(++value_ % 997) / 1000; }
  interop::vec3 vec3() {
    const float x = next(), y = next(), z = next();
    return {x, y, z};
  }
  // Unit, and different each time.
  interop::vec3 unit() {
    const interop::vec3 v = vec3();
    const float length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / length, v.y / length, v.z / length};
  }

 private:
  int value_ = 0;
};

inline interop::Surface sample_surface(Counter& c, bool specular) {
  interop::Surface s{};
  s.position = c.vec3();
  s.normal = c.unit();
  s.shading_normal = c.unit();
  s.diffuse = c.vec3();
  s.depth = c.next();
  s.id = static_cast<std::uint32_t>(c.next() * 1000);
  s.alpha = 1;
  if (!specular) return s;
  s.specular = c.vec3();
  s.alpha = c.next();
  s.ndf = interop::NDF_BECKMANN;
  return s;
}
inline interop::Surface nothing_seen() {
  interop::Surface s{};
  s.id = interop::NO_INSTANCE;
  return s;
}

inline GBuffer sample_gbuffer(bool specular) {
  Counter c;
  GBuffer g{5, 3, {1, 2, 3e6}, {0.25, -1, 7}, 12.5, {}};
  for (int i = 0; i < 15; ++i) g.pixels.push_back(sample_surface(c, specular && i % 2 == 0));
  g.pixels[4] = nothing_seen();
  return g;
}

inline interop::Moments sample_moments(Counter& c, bool specular) {
  interop::Moments m{};
  m.flux = c.vec3();
  m.power_diffuse = c.vec3();
  m.weight = c.next();
  m.position = c.vec3();
  m.spread = c.next();
  m.diffuse_mean = c.vec3();
  m.diffuse_deficit = c.next();
  m.normal_mean = c.vec3();
  m.normal_deficit = c.next();
  if (!specular) return m;
  m.power_specular = c.vec3();
  m.specular_mean = c.vec3();
  m.specular_deficit = c.next();
  return m;
}

inline Rsm sample_rsm(bool specular) {
  Counter c;
  Rsm rsm{8, 7, 5, {1, 2, 3}, 4.5, {}};
  for (const char* name : {"key", "lamp.px"}) {
    RsmLayer layer;
    layer.name = name;
    layer.light = {"key", LightType::point, {1, 2, 3}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 0.5,
                   0.75,  {10, 20, 30},     0.9,       0.8};
    for (int i = 0; i < 64; ++i) layer.surface.push_back(sample_surface(c, specular));
    layer.surface[63] = nothing_seen();
    for (std::size_t i = 0; i < pyramid_texels(8); ++i) layer.pyramid.push_back(sample_moments(c, specular));
    rsm.layers.push_back(std::move(layer));
  }
  return rsm;
}

inline Pdf sample_pdf() {
  Pdf pdf{4, "brsm-vsgl", {{"key", {}}, {"fill", {}}}};
  for (Pdf::Layer& layer : pdf.layers)
    for (std::size_t i = 0; i < pyramid_texels(4); ++i) layer.pyramid.push_back(i % 2 == 0 ? 0.5f : 1.5f);
  return pdf;
}

inline Lights sample_lights(int count, bool specular) {
  Counter c;
  Lights out;
  out.method = "fis-2016";
  out.anchor = {1, 2, 3};
  out.scene_radius = 9;
  out.requested = count + 3;
  for (int i = 0; i < count; ++i) {
    interop::Light l{};
    l.position = c.vec3();
    l.variance = c.next();
    l.power_diffuse = c.vec3();
    l.diffuse_axis = c.unit();
    l.diffuse_sharpness = c.next() * 100;
    l.normal = c.unit();
    l.normal_deficit = c.next();
    l.shading_normal = c.unit();
    l.incident = c.unit();
    l.origin = c.vec3();
    l.level = c.next() * 5;
    l.texel = static_cast<std::uint32_t>(c.next() * 1000);
    l.layer = static_cast<std::uint32_t>(c.next() * 1000);
    l.alpha = 1;
    if (specular) {
      l.power_specular = c.vec3();
      l.specular_axis = c.unit();
      l.specular_sharpness = c.next() * 0x1p40f;
      l.alpha = c.next() + 0.001f;
      l.ndf = interop::NDF_PHONG;
      l.lobe_variance = c.next();
      l.shading_deficit = 0.5f * l.lobe_variance;
    }
    out.lights.push_back(l);
  }
  return out;
}

// A root, its four children, and those of the third of these.
inline Lights sample_tree() {
  Lights out = sample_lights(9, true);
  out.method = "tree";
  out.lights[0].children = 1;
  out.lights[3].children = 5;
  out.levels = {0, 1, 5, 9};
  return out;
}

inline ShadowMaps sample_shadow_maps(int views) {
  Counter c;
  ShadowMaps maps;
  maps.tile = 4;
  maps.columns = views == 0 ? 0 : 2;
  maps.anchor = {1, 2, 3};
  maps.bias_disk_radius = 0.125;
  maps.normal_offset = 1.5;
  maps.slope_bias = 0.25;
  maps.relative_bias = 0.03;
  for (int i = 0; i < views; ++i) maps.views.push_back({c.vec3(), c.unit()});
  for (int i = 0; i < maps.columns * maps.rows() * 16; ++i) maps.inverse_distance.push_back(c.next());
  return maps;
}

// With the layer of bias reduction, or with those of a cut.
inline Indirect sample_indirect(bool specular, bool direct, bool cancellation) {
  Counter c;
  Indirect out;
  out.width = 4;
  out.height = 2;
  for (int i = 0; i < 8; ++i) {
    out.diffuse.push_back(c.vec3());
    if (specular) out.specular.push_back(c.vec3());
    if (direct) out.direct.push_back(c.vec3());
    if (cancellation) out.cancellation.push_back(c.next());
    if (!cancellation) {
      out.cut_size.push_back(c.next());
      out.error_estimate.push_back(c.next());
    }
  }
  return out;
}

inline Reference sample_reference(bool specular) {
  Counter c;
  Reference out{sample_indirect(specular, true, false), {}, "mis", 1024, 16};
  for (int i = 0; i < 8; ++i) out.variance.push_back(c.vec3());
  return out;
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Rewrites `from` as `to` after `change`, as a broken or foreign tool might.
template <typename Change>
void rewrite(const std::filesystem::path& from, const std::filesystem::path& to, Change change) {
  ExrFile file = read_exr(from);
  for (ExrPart& part : file.parts) part.compression = ExrCompression::none;
  change(file);
  write_exr(to, file);
}

// Puts a NaN in place of the only float of that value. write_exr() refuses to write one.
inline void poison(const std::filesystem::path& path, float value) {
  std::string bytes;
  {
    std::ifstream in(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  std::string pattern(4, '\0');
  std::memcpy(pattern.data(), &value, 4);
  const std::size_t at = bytes.find(pattern);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(bytes.find(pattern, at + 1), std::string::npos);
  const float nan = std::nanf("");
  std::memcpy(bytes.data() + at, &nan, 4);
  std::ofstream(path, std::ios::binary) << bytes;
}

inline float& pixel(ExrFile& file, std::size_t part, std::size_t level, const std::string& channel,
                    std::size_t index) {
  return std::get<0>(file.parts.at(part).levels.at(level).channels.at(channel)).at(index);
}

}  // namespace vsgl::test
