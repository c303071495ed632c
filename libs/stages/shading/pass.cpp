#include "stages/shading/pass.h"

#include <algorithm>
#include <array>

#include "stages/shading/device_pass.h"
#include "stages/shading/interleave.h"
#include "stages/shading/methods.h"

namespace vsgl {
namespace {

using interop::ShadingSums;

constexpr const char* kPhase = "shade";
constexpr std::array<const char*, interop::NDF_ANY + 1> kNdfNames = {"diffuse", "ggx", "beckmann", "phong",
                                                                     "general"};

void report_classes(const GBuffer& gbuffer, const std::vector<ReceiverList>& receivers,
                    const std::vector<LightList>& lights, const Visibility* visibility, bool skip,
                    Report& report) {
  std::size_t seen = 0;
  for (const ReceiverList& list : receivers) {
    report.count(std::string("pixels_") + kNdfNames[list.ndf], list.pixels.size());
    seen += list.pixels.size();
    if (!list.bumped)
      report.skipped("geometric horizon", std::string(kNdfNames[list.ndf]) + " pixels have no normal map");
  }
  for (const LightList& list : lights)
    report.count(std::string("lights_") + kNdfNames[list.ndf], list.lights.size());
  if (seen < gbuffer.pixels.size())
    report.skipped("background", std::to_string(gbuffer.pixels.size() - seen) + " pixels see nothing");
  if (!skip) return;
  const auto is_diffuse = [](const auto& list) { return list.ndf == interop::NDF_NONE; };
  if (std::all_of(receivers.begin(), receivers.end(), is_diffuse))
    report.skipped("specular reflection", "no pixel has a specular lobe");
  if (std::all_of(lights.begin(), lights.end(), is_diffuse))
    report.skipped("specular emission", "no light has a specular lobe");
  if (!visibility) report.skipped("visibility", "none given");
  if (visibility && std::holds_alternative<Unshadowed>(*visibility))
    report.skipped("visibility", "everything is seen");
}

interop::vec3 product(interop::vec3 a, interop::vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
double luminance(interop::vec3 c) {
  return vsgl::luminance(Vec3{c.x, c.y, c.z});
}

}  // namespace

std::vector<ShadingSums> run_shading(const GBuffer& gbuffer, const Visibility* visibility,
                                     const ShadingKernel& kernel, const ShadingParams& params,
                                     gpu::Device& device, Report& report) {
  const std::vector<ReceiverList> receivers = sort_receivers(gbuffer, params.skip);
  const std::vector<LightList> lights = sort_lights(kernel.lights, params.skip);
  report_classes(gbuffer, receivers, lights, visibility, params.skip, report);
  PhaseTimer timer(report, kPhase);
  DevicePass pass(gbuffer, visibility, kernel, device);
  if (params.schedule == "interleave" && params.interleave > 1)
    return run_interleaved(gbuffer, receivers, lights, params.interleave, pass, report);
  std::vector<ShadingSums> image(gbuffer.pixels.size());
  std::size_t pixels = 0;
  for (const ReceiverList& list : receivers) {
    add(pass.run(list, lights, report), list, image);
    pixels += list.pixels.size();
  }
  report.count("evaluations", pixels * kernel.lights.size());
  return image;
}

Indirect compose(const GBuffer& gbuffer, const std::vector<ShadingSums>& sums, bool all) {
  Indirect out;
  out.width = gbuffer.width;
  out.height = gbuffer.height;
  const bool specular = all || gbuffer.has_specular();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    out.diffuse.push_back(product(gbuffer.pixels[i].diffuse, sums[i].diffuse));
    if (specular) out.specular.push_back(product(gbuffer.pixels[i].specular, sums[i].specular));
  }
  return out;
}

double pixel_luminance(const Indirect& image, std::size_t pixel) {
  return luminance(image.diffuse[pixel]) + (image.specular.empty() ? 0 : luminance(image.specular[pixel]));
}

namespace {

// Share of each pixel's luminance that came from cancelled lights, 0..1.
std::vector<float> cancelled_share(const Indirect& indirect, const std::vector<ShadingSums>& sums) {
  std::vector<float> share(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double total = pixel_luminance(indirect, i);
    share[i] =
        total > 0 ? static_cast<float>(std::min(static_cast<double>(sums[i].aside) / total, 1.0)) : 0.0f;
  }
  return share;
}

}  // namespace

Indirect shade_sg(ShadingKernel kernel, const GBuffer& gbuffer, const Visibility* visibility,
                  const ShadingParams& params, gpu::Device& device, Report& report) {
  kernel.threshold = static_cast<float>(params.cbr);
  kernel.lobe = find_specular_lobe(params).kind;
  const auto sums = run_shading(gbuffer, visibility, kernel, params, device, report);
  Indirect out = compose(gbuffer, sums, !params.skip);
  if (params.cbr > 0) out.cancellation = cancelled_share(out, sums);
  return out;
}

}  // namespace vsgl
