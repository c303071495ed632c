#include "base/error.h"
#include "base/find_method.h"
#include "interop/shading.h"
#include "stages/shading/methods.h"

namespace vsgl {

const std::vector<SpecularLobe>& specular_lobes() {
  static const std::vector<SpecularLobe> lobes = {
      {"auto", "the most accurate form: mixture", interop::SPECULAR_LOBE_AUTO},
      {"mixture", "peak of the product, normal distribution as a mixture of Gaussians",
       interop::SPECULAR_LOBE_MIXTURE},
      {"blend", "normal distribution filtered by the light, blended into the BRDF",
       interop::SPECULAR_LOBE_BLEND},
      {"sg", "lobe and light as spherical Gaussians", interop::SPECULAR_LOBE_SG},
      {"asg", "lobe as an anisotropic spherical Gaussian, light as a round one", interop::SPECULAR_LOBE_ASG},
      {"asg-asg", "lobe and light as anisotropic spherical Gaussians", interop::SPECULAR_LOBE_ASG_ASG},
      {"ndf-filter", "normal distribution filtered by the light", interop::SPECULAR_LOBE_NDF_FILTER},
  };
  return lobes;
}

const SpecularLobe& find_specular_lobe(const ShadingParams& params) {
  return find_method(specular_lobes(), params.specular_lobe, "specular_lobe");
}

void require_specular_lobe(const LightModel& model, const std::string& schedule,
                           const ShadingParams& params) {
  if (find_specular_lobe(params).kind == interop::SPECULAR_LOBE_AUTO) return;
  const std::string what = "specular_lobe: \"" + params.specular_lobe + "\" does not fit ";
  if (!model.has_lobe)
    throw Error(ErrorCode::bad_value,
                what + "light model \"" + model.name + "\", which takes the true BRDF; choose auto, or vsgl");
  if (schedule == "cut")
    throw Error(ErrorCode::bad_value, what +
                                          "schedule \"cut\", which has forms of its own; choose auto, or "
                                          "make a list of lights with vsgl-gen --level");
}

}  // namespace vsgl
