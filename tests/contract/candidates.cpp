#include "candidates.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../unit/synthetic_room.h"
#include "../unit/synthetic_scene.h"
#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"
#include "stages/shading/shading.h"
#include "stages/visibility/shadow_lookup.h"
#include "stages/visibility/visibility.h"

namespace vsgl::test {
namespace {

const Rsm& rsm() {
  static const Rsm room = room_rsm(64, 2);
  return room;
}

const GBuffer& gbuffer() {
  static const GBuffer room = room_gbuffer(32, 24);
  return room;
}

// The room of `rsm()` as triangles.
const scene::Scene& room_scene() {
  static const scene::Scene room = [] {
    scene::Scene scene;
    scene.radius = rsm().scene_radius;
    add_box(scene, {-2, 0, -2}, {2, 3, 2});
    add_sphere(scene, {0.5, 0.5, -0.3}, 0.5);
    return scene;
  }();
  return room;
}

double luminance_of(interop::vec3 colour) {
  return luminance(to_double(colour));
}

double emitted_power(const Lights& lights) {
  double sum = 0;
  for (const auto& light : lights.lights)
    if (light.children == 0)  // inner nodes of a tree repeat what is below them
      sum += luminance_of(light.power_diffuse) + luminance_of(light.power_specular);
  return sum;
}

// ---- pdf

Pdf build_density(gpu::Device& device, const std::string& method) {
  Report report;
  return build_pdf(rsm(), &gbuffer(), {.method = method, .gbuffer_lights = 128, .view_samples = 32}, device,
                   report);
}

Pdf build_density_by(gpu::Device& device, const std::string& generation) {
  Report report;
  return build_pdf(rsm(), &gbuffer(), {.gbuffer_lights = 128, .gbuffer_generation = generation}, device,
                   report);
}

// Mean 1 over all layers, and positive wherever light is reflected: or else sampling would be biased.
void check_pdf(gpu::Device&, const std::filesystem::path& path) {
  const Pdf pdf = read_pdf(path);
  ASSERT_EQ(pdf.layers.size(), rsm().layers.size());
  double mean = 0;
  for (std::size_t layer = 0; layer < pdf.layers.size(); ++layer) {
    const auto& density = pdf.layers[layer].pyramid;
    mean += static_cast<double>(density.back()) / static_cast<double>(pdf.layers.size());
    for (int texel = 0; texel < rsm().size * rsm().size; ++texel)
      EXPECT_TRUE(density[texel] > 0 || rsm().layers[layer].pyramid[texel].weight == 0) << texel;
  }
  EXPECT_NEAR(mean, 1, 1e-4);
}

// ---- lights

// Whose radiance adds up to the power that the RSM reflects.
scene::Environment even_environment() {
  const double radiance = reflected_power(rsm()) / (4 * std::numbers::pi);
  return {32, 16, std::vector<Vec3>(32 * 16, Vec3{1, 1, 1} * radiance), {}};
}

// Spheres whose power adds up to that which the RSM reflects.
scene::Scene scene_of_spheres() {
  constexpr int count = 128;
  constexpr double radius = 0.1;
  const double sphere_area = 4 * std::numbers::pi * radius * radius;
  const Vec3 radiance = Vec3{1, 1, 1} * (reflected_power(rsm()) / (count * std::numbers::pi * sphere_area));
  scene::Scene scene;
  for (int i = 0; i < count; ++i) scene.sphere_lights.push_back({"", {0.01 * i, 1, 0}, radius, radiance});
  return scene;
}

Lights sample_lights(gpu::Device& device, const std::string& method) {
  Report report;
  const LightsSource source = lights_method(method).source;
  if (source == LightsSource::environment)
    return generate_environment_lights(even_environment(), {.method = method, .count = 128}, device, report);
  if (source == LightsSource::sphere_lights)
    return generate_sphere_lights(scene_of_spheres(), {.method = method}, report);
  static const Pdf pdf = flux_pdf(rsm());
  return generate_lights(rsm(), &pdf, {.method = method, .count = 128}, &device, report);
}

void check_lights(gpu::Device&, const std::filesystem::path& path) {
  const Lights lights = read_lights(path);
  EXPECT_GT(lights.lights.size(), lights.method == "two-vsgl" ? 1u : 100u);
  EXPECT_NEAR(emitted_power(lights) / reflected_power(rsm()), 1, 0.1);
}

// ---- visibility

Visibility find_visibility(gpu::Device& device, const Lights& lights, const std::string& method) {
  Report report;
  return build_visibility({room_scene(), lights, &gbuffer()}, {.method = method}, &device, report);
}

// Share of a light that arrives at a pixel.
double visibility_of(const ShadowMaps& maps, std::size_t light, std::size_t pixel) {
  const auto& receiver = gbuffer().pixels[pixel];
  return shadow_visibility(maps, light, to_double(receiver.position), to_double(receiver.normal));
}
double visibility_of(const VisibilityBits& bits, std::size_t light, std::size_t pixel) {
  return bits.visible(light, pixel) ? 1 : 0;
}

double visibility_of(const Unshadowed&, std::size_t, std::size_t) {
  return 1;
}

std::size_t light_count(const ShadowMaps& maps) {
  return maps.views.size();
}
std::size_t light_count(const VisibilityBits& bits) {
  return static_cast<std::size_t>(bits.lights);
}
std::size_t light_count(const Unshadowed& unshadowed) {
  return static_cast<std::size_t>(unshadowed.lights);
}

// Against rays, weighted by the cosines at both ends.
struct Agreement {
  double error = 0, weight = 0, hidden = 0;

  void add(const interop::Light& light, const interop::Surface& receiver, double visibility) {
    const Vec3 from = to_double(light.origin), to = to_double(receiver.position), u = normalise(to - from);
    const double w = luminance_of(light.power_diffuse) * std::max(dot(u, to_double(light.normal)), 0.0) *
                     std::max(-dot(u, to_double(receiver.normal)), 0.0);
    const bool visible = static_cast<double>(see(from + 1e-4 * u, u, false).depth) > 0.99 * length(to - from);
    error += w * std::abs(visibility - (visible ? 1 : 0));
    hidden += visible ? 0 : w;
    weight += w;
  }
  void add(const Agreement& other) {
    error += other.error;
    hidden += other.hidden;
    weight += other.weight;
  }
  // One pixel, of whose light no more is known than how much of it is visible, smoothed over its neighbours:
  // too much and too little may cancel.
  void judge_share(double share) { error = share * weight - (weight - hidden); }
};

// Of every third pixel with all lights.
template <class Kind>
Agreement agreement(const Kind& visibility, const Lights& lights) {
  EXPECT_EQ(light_count(visibility), lights.lights.size());
  Agreement sum;
  for (std::size_t light = 0; light < lights.lights.size(); ++light)
    for (std::size_t pixel = 0; pixel < gbuffer().pixels.size(); pixel += 3)
      sum.add(lights.lights[light], gbuffer().pixels[pixel], visibility_of(visibility, light, pixel));
  return sum;
}

// Of every pixel with the nodes below the start of its tile's cut: those in the cut are seen by what their
// masks say, and leaves whose whole branch is left out by nobody. A cut with shares is judged by these.
Agreement agreement(const Cut& cut, const Lights& lights) {
  EXPECT_EQ(static_cast<std::size_t>(cut.lights), lights.lights.size());
  Agreement sum;
  for (std::size_t pixel = 0; pixel < gbuffer().pixels.size(); pixel += 3) {
    const auto width = static_cast<std::size_t>(cut.width), x = pixel % width, y = pixel / width;
    const std::size_t bit = y % interop::TILE * interop::TILE + x % interop::TILE;
    const Cut::Tile& tile =
        cut.tiles[y / interop::TILE * static_cast<std::size_t>(cut.columns()) + x / interop::TILE];
    std::vector<bool> covered(lights.lights.size());
    Agreement own;
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      const std::uint32_t word = cut.mask_words[cut.masks[i] * interop::MASK_WORDS + bit / 32];
      own.add(lights.lights[cut.nodes[i]], gbuffer().pixels[pixel], word >> bit % 32 & 1U);
      covered[cut.nodes[i]] = true;
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
      const auto& light = lights.lights[i];
      for (std::uint32_t k = 0; k < 4 && light.children != 0 && covered[i]; ++k)
        covered[light.children + k] = true;
      if (light.children == 0 && !covered[i]) own.add(light, gbuffer().pixels[pixel], 0);
    }
    if (!cut.visibility.empty()) own.judge_share(static_cast<double>(cut.visibility[pixel]));
    sum.add(own);
  }
  return sum;
}

// A list of lights, or a tree where the method is for trees only.
Lights lights_for(gpu::Device& device, const std::string& method) {
  const auto& rows = visibility_methods();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& m) { return m.name == method; });
  return sample_lights(device, row != rows.end() && !row->for_lists ? "tree" : "vpl");
}

auto check_visibility(const std::string& method) {
  return [method](gpu::Device& device, const std::filesystem::path& path) {
    const Lights lights = lights_for(device, method);
    const Agreement sum =
        std::visit([&](const auto& kind) { return agreement(kind, lights); }, read_visibility(path));
    EXPECT_GT(sum.hidden / sum.weight, 0.01);
    if (method == "none")
      EXPECT_EQ(sum.error, sum.hidden);
    else
      EXPECT_LT(std::abs(sum.error), 0.5 * sum.hidden);
  };
}

// ---- shading

std::vector<double> pixel_luminances(const Indirect& image) {
  std::vector<double> out;
  for (std::size_t i = 0; i < image.diffuse.size(); ++i)
    out.push_back(luminance_of(image.diffuse[i]) +
                  (image.specular.empty() ? 0 : luminance_of(image.specular[i])));
  return out;
}

Indirect make_image(gpu::Device& device, const Lights& lights, const Visibility* visibility,
                    const std::string& method) {
  Report report;
  return shade(gbuffer(), lights, visibility, {.light_model = method}, device, report);
}

// The power spread evenly over the room's surface and reflected by the mean albedo gives a mean radiance that
// the image must be near.
double expected_radiance() {
  double albedo = 0;
  for (const auto& pixel : gbuffer().pixels)
    albedo += luminance_of(pixel.diffuse) + luminance_of(pixel.specular);
  albedo /= static_cast<double>(gbuffer().pixels.size());
  const double area = 2 * 16 + 4 * 12;
  return reflected_power(rsm()) / area * albedo / std::numbers::pi;
}

void check_image(gpu::Device&, const std::filesystem::path& path) {
  const auto image = pixel_luminances(read_indirect(path));
  ASSERT_EQ(image.size(), gbuffer().pixels.size());
  double mean = 0;
  for (const double pixel : image) mean += pixel / static_cast<double>(image.size());
  EXPECT_GT(mean, expected_radiance() / 3);
  EXPECT_LT(mean, expected_radiance() * 3);
}

template <class Methods, class Make, class Check>
void append(std::vector<Candidate>& list, const std::string& stage, const std::string& tool,
            const Methods& methods, Make make, Check check, bool is_listed = true) {
  for (const auto& method : methods)
    list.push_back({stage, method.name, tool,
                    [=, name = method.name](gpu::Device& device, const std::filesystem::path& path) {
                      write(path, make(device, name), Provenance{});
                    },
                    check, is_listed});
}

Indirect make_shadowed_image(gpu::Device& device, const std::string& method) {
  const Lights lights = sample_lights(device, "fis-2016");
  const Visibility maps = find_visibility(device, lights, "ism");
  return make_image(device, lights, &maps, method);
}

Visibility some_visibility(gpu::Device& device, const std::string& method) {
  return find_visibility(device, lights_for(device, method), method);
}

}  // namespace

const std::vector<Candidate>& candidates() {
  static const std::vector<Candidate> list = [] {
    std::vector<Candidate> out;
    append(out, "pdf", "pdf-build", pdf_methods(), build_density, check_pdf);
    append(out, "gbuffer-lights", "pdf-build", gbuffer_generations(), build_density_by, check_pdf, false);
    append(out, "lights", "vsgl-gen", lights_methods(), sample_lights, check_lights);
    for (const auto& method : visibility_methods())
      append(out, "visibility", "ismap", std::vector{method}, some_visibility, check_visibility(method.name));
    append(out, "shading", "shade", light_models(), make_shadowed_image, check_image);
    return out;
  }();
  return list;
}

const std::vector<Stage>& stages() {
  static const std::vector<Stage> list = {
      {"pdf", [](gpu::Device& device, const std::string& method) { build_density(device, method); }},
      {"gbuffer-lights",
       [](gpu::Device& device, const std::string& method) { build_density_by(device, method); }},
      {"lights", [](gpu::Device& device, const std::string& method) { sample_lights(device, method); }},
      {"visibility", [](gpu::Device& device, const std::string& method) { some_visibility(device, method); }},
      {"shading",
       [](gpu::Device& device, const std::string& method) { make_shadowed_image(device, method); }},
  };
  return list;
}

}  // namespace vsgl::test
