#include "cut_scenes.h"

#include "math/interop_vec.h"
#include "stages/lights/lights.h"
#include "stages/rsm/rsm.h"
#include "stages/shading/shading.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

scene::Scene scene_of(const std::string& name, std::optional<double> alpha, int width, int height) {
  scene::GenerateOptions options;
  options.width = width;
  options.height = height;
  options.alpha = alpha;
  return test_scene(name, options);
}

// All lit leaves of the tree in every tile.
Cut cut_of_leaves(const GBuffer& gbuffer, const Lights& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < tree.lights.size(); ++i) {
    const interop::Light& light = tree.lights[i];
    if (light.children == 0 &&
        luminance(to_double(light.power_diffuse) + to_double(light.power_specular)) > 0)
      leaves.push_back(i);
  }
  Cut cut;
  cut.width = gbuffer.width;
  cut.height = gbuffer.height;
  cut.anchor = gbuffer.anchor;
  cut.lights = static_cast<int>(tree.lights.size());
  const auto count = static_cast<std::uint32_t>(leaves.size());
  for (int tile = 0; tile < cut.columns() * cut.rows(); ++tile) {
    cut.tiles.push_back({static_cast<std::uint32_t>(cut.nodes.size()), count, 0});
    cut.nodes.insert(cut.nodes.end(), leaves.begin(), leaves.end());
  }
  return cut;
}

}  // namespace

gpu::Device& shared_device() {
  static gpu::Device device({});
  return device;
}

TreeScene::TreeScene(const std::string& name, std::optional<double> alpha, int width, int height,
                     int rsm_size)
    : scene(scene_of(name, alpha, width, height)) {
  Report report;
  Baker baker(scene, shared_device(), report);
  gbuffer = baker.gbuffer();
  RsmParams params;
  params.width = params.height = rsm_size;
  rsm = baker.rsm(params);
  tree = generate_lights(rsm, nullptr, {.method = "tree"}, nullptr, report);
}

Indirect TreeScene::cut_image(double error, VisibilityParams visibility) const {
  Report report;
  visibility.error = error;
  return shade_cut(build_visibility({scene, tree, &gbuffer}, visibility, &shared_device(), report),
                   ShadingParams{}.diffuse_scale);
}

Indirect TreeScene::all_leaves() const {
  Report report;
  const Cut leaves = cut_of_leaves(gbuffer, tree);
  return shade_cut(
      build_visibility({scene, tree, &gbuffer, &leaves}, {.method = "rays", .exact = true}, nullptr, report),
      1);
}

Indirect TreeScene::shade_cut(const Visibility& cut, int diffuse_scale) const {
  Report report;
  ShadingParams params;
  params.diffuse_scale = diffuse_scale;
  return shade(gbuffer, tree, &cut, params, shared_device(), report);
}

double indirect_luminance(const Indirect& image, std::size_t pixel) {
  return luminance(to_double(image.diffuse[pixel]) +
                   (image.specular.empty() ? Vec3{} : to_double(image.specular[pixel])));
}

}  // namespace vsgl::test
