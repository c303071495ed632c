#include "base/error.h"
#include "base/find_method.h"
#include "interop/sampling.h"
#include "math/sampling.h"
#include "stages/pdf/methods.h"
#include "stages/pdf/pdf.h"

namespace vsgl {
namespace {

constexpr double anchor_tolerance = 1e-6;  // of the scene's radius

void check_count(const char* name, int value) {
  if (value < 1 || value > static_cast<int>(interop::MAX_POINTS))
    throw Error(ErrorCode::out_of_range,
                std::string(name) + ": " + std::to_string(value) + " is outside 1..1048576");
}

void check_params(const PdfParams& params) {
  check_count("gbuffer_lights", params.gbuffer_lights);
  check_count("view_samples", params.view_samples);
  if (!(params.defensive >= 0 && params.defensive <= 1))
    throw Error(ErrorCode::out_of_range,
                "defensive: " + std::to_string(params.defensive) + " is outside 0..1");
  gbuffer_generation(params.gbuffer_generation);
}

void check_gbuffer(const PdfMethod& method, const Rsm& rsm, const GBuffer* gbuffer) {
  if (!method.needs_gbuffer) return;
  if (!gbuffer)
    throw Error(ErrorCode::missing_option,
                "method " + method.name + " needs a G-buffer; give one, or choose uniform or flux");
  if (length(gbuffer->anchor - rsm.anchor) > anchor_tolerance * rsm.scene_radius)
    throw Error(ErrorCode::invalid_data,
                "G-buffer: anchor differs from the RSM's; bake both from the same scene");
}

double mean(const TexelValues& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& layer : values) {
    for (double v : layer) sum += v;
    count += layer.size();
  }
  return sum / static_cast<double>(count);
}

// (1 - share) values / mean(values) + share flux / mean(flux): no texel's power over density exceeds the mean
// power by more than 1 / share, and none with power is out of reach. Where no value is positive the flux
// alone remains.
TexelValues mix_defensively(TexelValues values, const TexelValues& flux, double share, Report& report) {
  const double mean_value = mean(values), mean_flux = mean(flux);
  if (mean_value <= 0) {
    report.skipped("bidirectional importance",
                   "no light that a texel reflects reaches the image; the density is that of the flux");
    return flux;
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t i = 0; i < values[k].size(); ++i)
      values[k][i] = (1 - share) * values[k][i] / mean_value + share * flux[k][i] / mean_flux;
  return values;
}

Pdf normalise(const Rsm& rsm, const TexelValues& values, const std::string& method) {
  Pdf pdf;
  pdf.size = rsm.size;
  pdf.method = method;
  const double m = mean(values), scale = m > 0 ? 1 / m : 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<float> level0;
    level0.reserve(values[k].size());
    for (double v : values[k]) level0.push_back(static_cast<float>(v * scale));
    pdf.layers.push_back({rsm.layers[k].name, mean_pyramid(level0, rsm.size)});
  }
  return pdf;
}

}  // namespace

const std::vector<PdfMethod>& pdf_methods() {
  static const std::vector<PdfMethod> methods = {
      {"uniform", "every texel that reflects light alike", false, uniform_values},
      {"flux", "in proportion to the reflected power", false, flux_values},
      {"brsm-vpl", "contribution to the image, tried on random pixels", true, brsm_vpl_values},
      {"brsm-vsgl", "contribution to the image, by virtual spherical Gaussian lights on the G-buffer", true,
       brsm_vsgl_values},
  };
  return methods;
}

Pdf build_pdf(const Rsm& rsm, const GBuffer* gbuffer, const PdfParams& params, gpu::Device& device,
              Report& report) {
  const PdfMethod& method = find_method(pdf_methods(), params.method);
  check_params(params);
  check_gbuffer(method, rsm, gbuffer);
  const TexelValues flux = flux_values(rsm, gbuffer, params, device, report);
  if (mean(flux) <= 0) {
    report.skipped("density", "no texel reflects light; the density is 0 everywhere");
    return normalise(rsm, flux, method.name);
  }
  TexelValues values = method.run(rsm, gbuffer, params, device, report);
  if (method.needs_gbuffer) values = mix_defensively(std::move(values), flux, params.defensive, report);
  return normalise(rsm, values, method.name);
}

}  // namespace vsgl
