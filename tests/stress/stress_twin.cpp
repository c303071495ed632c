// stress_twin --gbuffer gbuffer.exr --lights lights.exr [--cut ism.exr] --light-model vsgl -o twin.exr: what
// `shade` computes, in double precision, for the stress suite to compare with. Shading normals must be the
// geometric ones; visibility is that of a cut's masks, or none.

#include "base/tool.h"
#include "unit/shading/cut_scene.h"

namespace {

namespace fs = std::filesystem;
using namespace vsgl;

struct Arguments {
  fs::path gbuffer, lights, cut, output;
  std::string light_model = "fvpl";
  test::OracleOptions options;
};

void declare(Tool& tool, Arguments& a) {
  tool.input("--gbuffer", a.gbuffer, "pixels to shade")->required();
  tool.input("--lights", a.lights, "virtual lights")->required();
  tool.input("--cut", a.cut, "cut through a tree of lights");
  tool.output("-o,--output", a.output, "radiance to write")->required();
  tool.app().add_option("--light-model", a.light_model, "fvpl, vpl (no clamp), vsgl or vsgl-2014");
  tool.app().add_option("--specular-lobe", a.options.lobe, "as of shade");
  tool.app().add_option("--cbr", a.options.cbr, "as of shade");
}

// What the shading stage makes of a light before it shades: footprints have a least size, and specular power
// whose representative point has no specular lobe is emitted by the broadest one (docs/shading.md).
void prepare(Lights& lights) {
  const double deviation = 1e-6 * lights.scene_radius;
  for (interop::Light& light : lights.lights) {
    light.variance = std::max(light.variance, static_cast<float>(deviation * deviation));
    const interop::vec3 power = light.power_specular;
    if (light.ndf != interop::NDF_NONE || std::max({power.x, power.y, power.z}) <= 0) continue;
    light.ndf = interop::NDF_GGX;
    light.alpha = 1;
  }
}

test::Radiance pixel_sum(const GBuffer& gbuffer, std::size_t i, const Lights& lights, const Arguments& a) {
  if (gbuffer.pixels[i].id == interop::NO_INSTANCE) return {};
  if (a.light_model == "vpl") return test::vpl_sum(gbuffer, i, lights, a.options);
  if (a.light_model == "fvpl") return test::fvpl_sum(gbuffer, i, lights, a.options);
  if (a.light_model == "vsgl" || a.light_model == "vsgl-2014")
    return test::vsgl_sum(gbuffer, i, lights, a.light_model == "vsgl-2014", a.options);
  throw Error(ErrorCode::bad_value, "--light-model: " + a.light_model + " has no twin here");
}

Exit run(const Tool& tool, const Arguments& a, OutputSet& outputs) {
  const GBuffer gbuffer = read_gbuffer(a.gbuffer);
  Lights lights = read_lights(a.lights);
  prepare(lights);
  const auto clusters = pack_clusters(lights);
  Indirect image;
  image.width = gbuffer.width;
  image.height = gbuffer.height;
  Cut cut;
  std::vector<test::Box> boxes;
  if (!a.cut.empty()) {
    cut = read_cut(a.cut);
    boxes = test::block_boxes(gbuffer);
  }
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const test::Radiance sum =
        a.cut.empty() ? pixel_sum(gbuffer, i, lights, a) : test::cut_sum(gbuffer, i, clusters, cut, boxes[i]);
    image.diffuse.push_back(test::to_float(sum.diffuse));
    if (gbuffer.has_specular()) image.specular.push_back(test::to_float(sum.specular));
  }
  write(outputs.add(a.output), image, tool.provenance());
  return Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("stress_twin", "shades in double precision");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](Report&, OutputSet& outputs) { return run(tool, arguments, outputs); });
}
