#include <bit>
#include <numbers>

#include "cluster/evaluate.h"
#include "math/interop_vec.h"
#include "math/specular_lobe.h"

namespace vsgl {
namespace {

void set(Lanes3& lanes, std::size_t i, Vec3 v) {
  lanes[0][i] = static_cast<float>(v.x);
  lanes[1][i] = static_cast<float>(v.y);
  lanes[2][i] = static_cast<float>(v.z);
}

void set(Lanes& lanes, std::size_t i, double value) {
  lanes[i] = static_cast<float>(value);
}

void set_specular(SampleReceivers& out, std::size_t i, const interop::Surface& s, Vec3 view) {
  const double alpha = static_cast<double>(s.alpha);
  const SpecularReceiver r = specular_receiver(s.ndf, alpha, to_double(s.shading_normal), view);
  const bool glossy = s.ndf != interop::NDF_NONE, gaussian = glossy && s.ndf != interop::NDF_GGX;
  set(out.tangent, i, r.tangent);
  set(out.bitangent, i, r.bitangent);
  set(out.sin_view, i, r.sin_view);
  set(out.cos_view, i, r.cos_view);
  set(out.alpha2, i, r.alpha2);
  set(out.across, i, glossy ? r.across : 0);
  set(out.mirror_tangent, i, r.mirror.x);
  set(out.mirror_normal, i, r.mirror.z);
  set(out.slope_view, i, ggx_slope_cosine(r.alpha2, r.cos_view));
  set(out.view_lambda, i, r.view_lambda);
  set(out.phong, i, s.ndf == interop::NDF_PHONG ? 1 : 0);
  set(out.gaussian, i, gaussian ? 1 : 0);
  out.has_specular = out.has_specular || glossy;
  out.has_gaussian = out.has_gaussian || gaussian;
}

}  // namespace

SampleReceivers sample_receivers(const GBuffer& gbuffer, const TileSamples& samples) {
  constexpr Vec3 kLuminance{0.2126, 0.7152, 0.0722};
  const auto first = static_cast<std::size_t>(std::countr_zero(samples.present));
  SampleReceivers out;
  for (std::size_t i = 0; i < kTileSamples; ++i) {
    const std::size_t k = samples.present >> i & 1U ? i : first;
    const interop::Surface& s = gbuffer.pixels[samples.pixel[k]];
    const Vec3 position = to_double(s.position);
    set(out.position, i, position);
    set(out.normal, i, to_double(s.shading_normal));
    set(out.diffuse, i, std::numbers::inv_pi * kLuminance * to_double(s.diffuse));
    set(out.specular, i, kLuminance * to_double(s.specular));
    set_specular(out, i, s, normalise(gbuffer.camera - position));
  }
  return out;
}

}  // namespace vsgl
